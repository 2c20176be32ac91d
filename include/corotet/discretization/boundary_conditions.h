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

    /// No parameter: boundaries, by id, that have the displacement of an exact
    /// solution, and that as a text of three components.
    std::set<unsigned int> boundaries_of_solution;
    std::string            displacement_of_solution;
  };

  /**
   * What happens on each boundary of the body. Each component of each boundary
   * has exactly one condition: a displacement, a traction, a pressure, or none
   * of them (free of force). So has each edge and corner that has a name, or
   * where such places meet: a displacement, or none.
   */
  class BoundaryConditions
  {
  public:
    /// Displacement in m, by component, of the nodes that all of these places
    /// have in common, each the union of some ids; a component without value is
    /// free.
    struct Displacement
    {
      std::set<Place>                          places;
      std::array<std::optional<Expression>, 3> components;
      /// The parameter that sets it.
      std::string entry;
    };

    /// Dead traction in Pa (force per area at rest), three components; or
    /// follower pressure in Pa, one component, positive into the body.
    struct SurfaceLoad
    {
      unsigned int boundary;
      Expression   value;
    };

    /// Throws InputError for unknown names, wrong expressions, and components
    /// with two conditions. @p tables are for the expressions; @p names must
    /// outlive this object.
    BoundaryConditions(const BoundaryConditionParameters &parameters,
                       const PlaceNames                  &names,
                       const TableFunctions              &tables = {});

    std::vector<Displacement> displacements;
    std::vector<SurfaceLoad>  tractions;
    std::vector<SurfaceLoad>  pressures;

    /// What "name & name" means, each place once. Throws InputError, blamed on
    /// @p entry, for unknown names.
    std::set<Place>
    find(const std::string &text, const std::string &entry) const;

    /// "name", or "name & name" for what places have in common.
    std::string
    name(const std::set<Place> &places) const;

    /// What a message calls these: "boundary", also where several meet, "edge",
    /// "corner" or "place".
    static std::string
    kind(const std::set<Place> &places);

  private:
    /// Prescribes the displacement that @p value has three components of on
    /// what @p name means, which are @p places.
    void
    prescribe(const std::set<Place> &places,
              const std::string     &name,
              const std::string     &value,
              const TableFunctions  &tables);

    /// Adds a load on each of the boundaries that a name means; @p what: "a
    /// traction", say.
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
    /// Entry that sets the condition of [places][component]: of one place, by
    /// its ids one by one.
    std::map<std::set<Place>, std::array<std::string, 3>> claims;
  };
} // namespace corotet

#endif
