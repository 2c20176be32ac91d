// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_exact_solution_h
#define corotet_material_exact_solution_h

#include <corotet/base/expression.h>
#include <corotet/material/material_law.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace corotet
{
  /**
   * The parameters of section Exact solution.
   */
  struct ExactSolutionParameters
  {
    void
    declare_parameters(dealii::ParameterHandler &prm);

    /// The exact displacement; empty if there is none.
    std::string displacement;
    bool        manufacture           = true;
    std::string displacement_boundary = "all";
  };

  /**
   * A displacement u(x, t) in closed form, its derivatives, and the data of the
   * problem that it solves (method of manufactured solutions, Roache 2002,
   * @cite roache2002): with F = I + grad u,
   *
   *   b = rho u_tt - Div P(F),    t = P(F) n,
   *
   * with the law's stress at points, to which laws with the rotations of cells
   * converge, too.
   */
  class ExactSolution
  {
  public:
    /// @p text has three components in x, y, z, t. Throws InputError blamed on
    /// Exact solution/Displacement if it cannot be differentiated.
    explicit ExactSolution(const std::string &text);

    /// The displacement [m].
    dealii::Tensor<1, 3>
    displacement(const dealii::Point<3> &x, const double t) const
    {
      return u.vector_value(x, t);
    }

    /// Gradient of the displacement [-], [component][direction].
    dealii::Tensor<2, 3>
    gradient(const dealii::Point<3> &x, const double t) const;

    /// First Piola-Kirchhoff stress P [Pa].
    dealii::Tensor<2, 3>
    stress(const IsotropicMaterial &material,
           const MaterialLaw       &law,
           const dealii::Point<3>  &x,
           const double             t) const;

    /// Force per volume at rest [N/m^3], with or without inertia.
    dealii::Tensor<1, 3>
    body_force(const IsotropicMaterial &material,
               const MaterialLaw       &law,
               const bool               with_inertia,
               const dealii::Point<3>  &x,
               const double             t) const;

    /// The displacement u and the velocity du/dt as texts of three components.
    const std::string &
    displacement_text() const
    {
      return text;
    }

    std::string
    velocity_text() const;

    bool
    depends_on_time() const
    {
      return u.depends_on_time();
    }

  private:
    /// All derivatives by @p variables, each a list: three components of each
    /// list.
    static Expression
    derivatives(const std::string                           &text,
                const std::vector<std::vector<std::string>> &variables);

    std::string text;
    Expression  u;
    Expression  acceleration;
    /// First derivatives of u, [3 direction + component].
    Expression first;
    /// Second derivatives of u, [3 pair + component], for the pairs of
    /// directions xx, yy, zz, yz, xz, xy.
    Expression second;
  };
} // namespace corotet

#endif
