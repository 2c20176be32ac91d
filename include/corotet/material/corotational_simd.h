// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_corotational_simd_h
#define corotet_material_corotational_simd_h

#include <corotet/material/isotropic_law.h>
#include <corotet/material/rotation_derivative.h>

namespace corotet
{
  /// Y = X^T Z.
  COROTET_ALWAYS_INLINE void
  transposed_times(const Simd<double> (&X)[3][3],
                   const Simd<double> (&Z)[3][3],
                   Simd<double> (&Y)[3][3])
  {
    static_for<9>([&](auto ab) {
      constexpr int a = ab / 3, b = ab % 3;
      Y[a][b] = X[0][a] * Z[0][b] + X[1][a] * Z[1][b] + X[2][a] * Z[2][b];
    });
  }

  /// Y = X Z.
  COROTET_ALWAYS_INLINE void
  times(const Simd<double> (&X)[3][3],
        const Simd<double> (&Z)[3][3],
        Simd<double> (&Y)[3][3])
  {
    static_for<9>([&](auto ab) {
      constexpr int a = ab / 3, b = ab % 3;
      Y[a][b] = X[a][0] * Z[0][b] + X[a][1] * Z[1][b] + X[a][2] * Z[2][b];
    });
  }

  /// The stress sigma of the strain sym(A) - I.
  COROTET_ALWAYS_INLINE void
  stress_of_stretch(const Simd<double> lambda,
                    const Simd<double> mu,
                    const Simd<double> (&A)[3][3],
                    Simd<double> (&sigma)[3][3])
  {
    Simd<double> e[3][3];
    internal::copy(A, e);
    static_for<3>([&](auto a) { e[a][a] -= 1.; });
    isotropic_stress(lambda, mu, e, sigma);
  }

  /// e = R^T F - I from H = grad u, without the loss of digits that F has; its
  /// symmetric part is the strain.
  COROTET_ALWAYS_INLINE void
  corotational_strain(const Simd<double> (&R)[3][3],
                      const Simd<double> (&H)[3][3],
                      Simd<double> (&e)[3][3])
  {
    transposed_times(R, H, e);
    static_for<9>([&](auto ab) {
      constexpr int a = ab / 3, b = ab % 3;
      e[a][b] += R[b][a] - (a == b ? 1. : 0.);
    });
  }

  /// F = I + grad u.
  COROTET_ALWAYS_INLINE void
  add_identity(Simd<double> (&F)[3][3])
  {
    static_for<3>([&](auto a) { F[a][a] += 1.; });
  }

  /// S = sym(A).
  COROTET_ALWAYS_INLINE void
  symmetric_part(const Simd<double> (&A)[3][3], Simd<double> (&S)[6])
  {
    static_for<6>([&](auto s) {
      constexpr int a = internal::symmetric_pairs[s][0],
                    b = internal::symmetric_pairs[s][1];
      S[s]            = a == b ? A[a][a] : 0.5 * (A[a][b] + A[b][a]);
    });
  }

  /// S = sym(R^T F).
  COROTET_ALWAYS_INLINE void
  stretch(const Simd<double> (&R)[3][3],
          const Simd<double> (&F)[3][3],
          Simd<double> (&S)[6])
  {
    Simd<double> A[3][3];
    transposed_times(R, F, A);
    symmetric_part(A, S);
  }

  /**
   * First Piola-Kirchhoff stress P = R sigma(S - I) [Pa] for the rotation R of
   * F = R S: 2 mu (F - R) + lambda tr(S - I) R.
   */
  COROTET_ALWAYS_INLINE void
  corotational_stress(const Simd<double> (&R)[3][3],
                      const Simd<double> lambda,
                      const Simd<double> mu,
                      const Simd<double> (&F)[3][3],
                      Simd<double> (&P)[3][3])
  {
    Simd<double> trace{};
    static_for<9>([&](auto ab) {
      constexpr int a = ab / 3, b = ab % 3;
      P[a][b] = F[a][b] - R[a][b];
      trace += R[a][b] * P[a][b];
    });
    static_for<9>([&](auto ab) {
      constexpr int a = ab / 3, b = ab % 3;
      P[a][b] = 2. * mu * P[a][b] + lambda * trace * R[a][b];
    });
  }

  /**
   * The derivative of that stress with a varying rotation, in the direction dF
   * = R A, is
   *
   *   dP = R (sigma(A) + W(T a(A))),
   *   T  = mu I + (lambda tr(S - I) - 2 mu) G^{-1}:
   *
   * the sum of corotational_tangent() and a term with T. Computes T; returns
   * the lanes where G was clamped. T is symmetric, as P is the gradient of an
   * energy.
   */
  COROTET_ALWAYS_INLINE unsigned int
  rotation_stiffness(const Simd<double> lambda,
                     const Simd<double> mu,
                     const Simd<double> (&S)[6],
                     Simd<double> (&T)[6])
  {
    const unsigned int clamped = inverse_spin_tensor(S, T);
    const Simd<double> factor  = lambda * (S[0] + S[1] + S[2] - 3.) - 2. * mu;
    static_for<6>([&](auto s) {
      T[s] *= factor;
      if constexpr (s < 3)
        T[s] += mu;
    });
    return clamped;
  }

  /**
   * Derivative of the first Piola-Kirchhoff stress of corotational elasticity
   * [Pa] in the direction @p grad_v with the rotation @p R frozen, a cell per
   * lane: P = R (2 mu sym(A) + lambda tr(A) I) with A = R^T grad v.
   */
  COROTET_ALWAYS_INLINE void
  corotational_tangent(const Simd<double> (&R)[3][3],
                       const Simd<double> lambda,
                       const Simd<double> mu,
                       const Simd<double> (&grad_v)[3][3],
                       Simd<double> (&P)[3][3])
  {
    Simd<double> A[3][3], sigma[3][3];
    transposed_times(R, grad_v, A);
    isotropic_stress(lambda, mu, A, sigma);
    times(R, sigma, P);
  }
} // namespace corotet

#endif
