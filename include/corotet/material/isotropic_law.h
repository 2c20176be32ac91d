// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_isotropic_law_h
#define corotet_material_isotropic_law_h

#include <corotet/base/simd.h>

namespace corotet
{
  /**
   * The isotropic law, sigma = 2 mu sym(A) + lambda tr(A) I, for numbers and
   * for registers of them: [a][b] gives a component of @p A and of @p sigma.
   */
  template <typename Number, typename Tensor2, typename Stress>
  COROTET_ALWAYS_INLINE void
  isotropic_stress(const Number   lambda,
                   const Number   mu,
                   const Tensor2 &A,
                   Stress        &sigma)
  {
    const Number pressure = lambda * (A[0][0] + A[1][1] + A[2][2]);
    static_for<9>([&](auto ab) {
      constexpr int a = ab / 3, b = ab % 3;
      sigma[a][b] = mu * (A[a][b] + A[b][a]);
      if constexpr (a == b)
        sigma[a][b] += pressure;
    });
  }

  /// Its energy per volume at rest, mu sym(A) : sym(A) + lambda / 2 tr(A)^2.
  template <typename Number, typename Tensor2>
  COROTET_ALWAYS_INLINE Number
  isotropic_energy(const Number lambda, const Number mu, const Tensor2 &A)
  {
    Number square{};
    static_for<3>([&](auto row) {
      constexpr int a = row, b = (a + 1) % 3;
      const Number  shear = A[a][b] + A[b][a];
      square += A[a][a] * A[a][a] + 0.5 * (shear * shear);
    });
    const Number trace = A[0][0] + A[1][1] + A[2][2];
    return mu * square + 0.5 * lambda * (trace * trace);
  }
} // namespace corotet

#endif
