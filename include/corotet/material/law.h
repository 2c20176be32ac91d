// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_law_h
#define corotet_material_law_h

#include <corotet/base/simd.h>

#include <concepts>

namespace corotet
{
  /// Lamé's parameters of the cells of a batch [Pa].
  struct LameLanes
  {
    Simd<double> lambda;
    Simd<double> mu;
  };

  /// A tensor of the cells of a batch, [row][column].
  using Tensor2Lanes = Simd<double>[3][3];

  /// n numbers of the cells of a batch; an array of one if n is zero.
  template <int n>
  using NumberLanes = Simd<double>[n > 0 ? n : 1];

  /**
   * A law of elasticity at a point, a cell per lane: the first Piola-Kirchhoff
   * stress P [Pa] as a function of H = grad u = F - I, and what else is needed
   * of it:
   *
   *   - stress(lame, H, P): P. Not finite where the law has none (det F <= 0,
   *     say): then a step fails, and is made in halves. It returns nothing, or
   *     what polar_decomposition() found.
   *   - energy_density(lame, H): elastic energy per volume at rest [J/m^3],
   *     whose derivative P must be.
   *   - linearize(lame, H, stored): what its derivative needs to know of H:
   *     n_stored numbers, kept for each quadrature point. Returns the lanes
   *     where the derivative had to be bounded, a bit each: 0 for most laws.
   *   - derivative(lame, stored, dF, dP): dP, the derivative of P in the
   *     direction dF.
   *
   * Round-off: where H is small, P and the energy should be as accurate as H
   * itself; F^T F - I is H + H^T + H^T H. At rest the derivative must be that
   * of linear elasticity with the same parameters: modes and the preconditioner
   * rely on it. Objects of the law hold its parameters, if it has any besides
   * Lamé's; they are copied.
   *
   * Optional:
   *   - spatial_stress(lame, H, sigma): the stress to be shown [Pa]. Without
   *     it, Cauchy's.
   *   - is_linear = true: P is linear in H, symmetric, without a rotation.
   *   - a frozen form, see LawWithFrozenForm.
   */
  template <typename L>
  concept Law = std::copyable<L> && requires(const L                   law,
                                             const LameLanes           lame,
                                             const Tensor2Lanes       &H,
                                             Tensor2Lanes             &P,
                                             NumberLanes<L::n_stored> &stored) {
    law.stress(lame, H, P);
    { law.energy_density(lame, H) } -> std::same_as<Simd<double>>;
    { law.linearize(lame, H, stored) } -> std::same_as<unsigned int>;
  };

  /**
   * A law with a symmetric and positive semi-definite part of its derivative at
   * each point, which Newton's method falls back on and damping uses: n_frozen
   * numbers from linearize_frozen(H, stored), applied by
   * frozen_derivative(lame, stored, dF, dP). Its derivative() has a further
   * argument after lame, the factor of that part: 1 gives the derivative. For
   * other laws that part is linear elasticity rotated with the cell.
   */
  template <typename L>
  concept LawWithFrozenForm =
    Law<L> && requires(const L                   law,
                       const Tensor2Lanes       &H,
                       NumberLanes<L::n_frozen> &stored) {
      law.linearize_frozen(H, stored);
    };

  /// Whether a law is linear.
  template <Law L>
  inline constexpr bool is_linear_law = [] {
    if constexpr (requires { L::is_linear; })
      return L::is_linear;
    else
      return false;
  }();
} // namespace corotet

#endif
