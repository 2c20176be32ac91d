// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_boundary_conditions_h
#define corotet_discretization_boundary_conditions_h

#include <corotet/base/expression.h>
#include <corotet/mesh/mesh.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The parameters of section Boundary conditions, as text.
   */
  struct BoundaryConditionParameters
  {
    void
    declare_parameters(dealii::ParameterHandler &prm);

    std::string fixed;
    std::string displacement;
    std::string traction;
    std::string pressure;

    /// Not parameters: the ids of boundaries that have the displacement of an
    /// exact solution, and this displacement as a text of three components.
    std::set<unsigned int> boundaries_of_solution;
    std::string            displacement_of_solution;
  };

  /**
   * The conditions on the boundaries of the body. Each component of each
   * boundary has exactly one condition: a displacement, a traction, a pressure,
   * or none of them (free of force). Each edge and corner that has a name, or
   * where such places meet, has a displacement or no condition.
   */
  class BoundaryConditions
  {
  public:
    /// The prescribed displacement in m, by component, of the nodes that all of
    /// these places have in common. Each place is the union of some ids. A
    /// component without value is free.
    struct Displacement
    {
      std::set<Place>                          places;
      std::array<std::optional<Expression>, 3> components;
      /// The parameter that sets it.
      std::string entry;
    };

    /// A dead traction in Pa (force per area at rest) with three components, or
    /// a follower pressure in Pa with one component, positive into the body.
    struct SurfaceLoad
    {
      unsigned int boundary;
      Expression   value;
    };

    /// Throws InputError for unknown names, wrong expressions, and components
    /// with two conditions. The expressions may use @p tables; @p names must
    /// outlive this object.
    BoundaryConditions(const BoundaryConditionParameters &parameters,
                       const PlaceNames                  &names,
                       const TableFunctions              &tables = {});

    std::vector<Displacement> displacements;
    std::vector<SurfaceLoad>  tractions;
    std::vector<SurfaceLoad>  pressures;

    /// The places that "name & name" means, each once. Throws InputError,
    /// blamed on @p entry, for unknown names.
    std::set<Place>
    find(const std::string &text, const std::string &entry) const;

    /// The text "name", or "name & name" for the common nodes of several
    /// places.
    std::string
    name(const std::set<Place> &places) const;

    /// The word for these places in a message: "boundary", also where several
    /// meet, "edge", "corner" or "place".
    static std::string
    kind(const std::set<Place> &places);

  private:
    /// Prescribes the three components of the displacement @p value on @p
    /// places, which the user has called @p name.
    void
    prescribe(const std::set<Place> &places,
              const std::string     &name,
              const std::string     &value,
              const TableFunctions  &tables);

    /// Adds a load on each of the boundaries that a name means; @p what is the
    /// kind of load in messages, such as "a traction".
    void
    add(std::vector<SurfaceLoad> &loads,
        const std::string        &what,
        const std::string        &name,
        const Expression         &value,
        const std::string        &entry) const;

    void
    claim(const std::set<Place> &places,
          const unsigned int     component,
          const std::string     &entry);

    const PlaceNames &names;
    /// The entry that sets the condition of [places][component]. Each place has
    /// a single id here.
    std::map<std::set<Place>, std::array<std::string, 3>> claims;
  };
} // namespace corotet

#endif
