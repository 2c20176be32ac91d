// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_boundary_conditions_h
#define corotet_discretization_boundary_conditions_h

#include <corotet/base/expression.h>
#include <corotet/mesh/mesh.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <optional>
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
  };

  /**
   * What happens on each boundary of the body. Each component of each boundary
   * has exactly one condition: a displacement, a traction, a pressure, or none
   * of them (free of force).
   */
  class BoundaryConditions
  {
  public:
    /// Displacement in m by component; a component without value is free.
    struct Displacement
    {
      unsigned int                             boundary;
      std::array<std::optional<Expression>, 3> components;
    };

    /// Dead traction in Pa (force per area at rest), three components; or
    /// follower pressure in Pa, one component, positive into the body.
    struct SurfaceLoad
    {
      unsigned int boundary;
      Expression   value;
    };

    /// Throws InputError for unknown boundaries, wrong expressions, and
    /// components with two conditions. @p tables are for the expressions.
    BoundaryConditions(const BoundaryConditionParameters &parameters,
                       const MeshNames                   &boundaries,
                       const TableFunctions              &tables = {});

    std::vector<Displacement> displacements;
    std::vector<SurfaceLoad>  tractions;
    std::vector<SurfaceLoad>  pressures;

  private:
    void
    claim(const unsigned int boundary,
          const unsigned int component,
          const std::string &entry);

    const MeshNames &names;
    /// Entry that sets the condition of [boundary][component].
    std::map<unsigned int, std::array<std::string, 3>> claims;
  };
} // namespace corotet

#endif
