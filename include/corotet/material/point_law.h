// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_point_law_h
#define corotet_material_point_law_h

#include <corotet/material/isotropic.h>

#include <deal.II/base/tensor.h>

namespace corotet
{
  /**
   * A law of elasticity as a program adds it: at a single point, in plain
   * numbers. What makes it a MaterialLaw is in the library, and calls it for
   * each quadrature point; the laws of the library itself are written as a Law,
   * for many points at once, and are faster.
   *
   * H is grad u, [component][direction]; F = I + H. @p material has Lamé's
   * parameters of the cell. At rest the law must be linear elasticity with
   * these, without stress: modes and the preconditioner rely on it, and runs
   * begin with check_at_rest(). Where it has no stress, it returns numbers that
   * are not finite; the step is then made in halves. Members must not change
   * the object.
   *
   * Where H is small, stress and energy should be as accurate as H itself: H +
   * H^T + H^T H has digits that F^T F - I has lost.
   */
  class PointLaw
  {
  public:
    virtual ~PointLaw() = default;

    /// First Piola-Kirchhoff stress [Pa].
    virtual dealii::Tensor<2, 3>
    stress(const IsotropicMaterial    &material,
           const dealii::Tensor<2, 3> &H) const = 0;

    /// Derivative of the stress in the direction @p dF [Pa].
    virtual dealii::Tensor<2, 3>
    stress_derivative(const IsotropicMaterial    &material,
                      const dealii::Tensor<2, 3> &H,
                      const dealii::Tensor<2, 3> &dF) const = 0;

    /// Elastic energy per volume at rest [J/m^3], whose derivative the stress
    /// is.
    virtual double
    energy_density(const IsotropicMaterial    &material,
                   const dealii::Tensor<2, 3> &H) const = 0;
  };

  /// Throws an InputError blamed on Material/Type unless the law at rest is
  /// that of linear elasticity with these parameters, to six digits.
  void
  check_at_rest(const PointLaw &law, const IsotropicMaterial &material);

  /// How far the members of a law contradict each other [-].
  struct LawErrors
  {
    /// Difference of the stress from the derivative of the energy, relative to
    /// the stress.
    double stress;
    /// Difference of the law's stress derivative from that by finite
    /// differences, relative to the latter.
    double stress_derivative;
  };

  /// The errors at the gradient @p H, which is not zero, by central
  /// differences: below 1e-6 for a law without mistakes. Runs warn of more than
  /// 1e-3.
  LawErrors
  law_errors(const PointLaw             &law,
             const IsotropicMaterial    &material,
             const dealii::Tensor<2, 3> &H);
} // namespace corotet

#endif
