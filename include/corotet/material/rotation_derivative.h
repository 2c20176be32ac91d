// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_rotation_derivative_h
#define corotet_material_rotation_derivative_h

#include <corotet/material/polar_decomposition_simd.h>

#include <deal.II/base/symmetric_tensor.h>

namespace corotet
{
  /**
   * Derivative of the rotation R of F = R S, a cell per lane.
   *
   * With A = R^T dF the rotation changes by dR = R W(w), where W(w) is the skew
   * matrix of w (W(w) v = w x v) and
   *
   *   G w = a(A),  G = tr(S) I - S,
   *
   * with a(A) the axial vector of A - A^T. Symmetric tensors are six numbers:
   * xx, yy, zz, yz, xz, xy.
   */

  /// The smallest eigenvalue of G [-], to which smaller ones are clamped. They
  /// are sums of two principal stretches; where such a sum is zero, R jumps.
  inline constexpr double smallest_sum_of_stretches = 0.01;

  namespace internal
  {
    struct ClampedInverse
    {
      dealii::SymmetricTensor<2, 3> inverse;
      bool                          is_clamped;
    };

    /// G^{-1} with the eigenvalues of G clamped; zero if G is not finite.
    ClampedInverse
    clamped_inverse(const dealii::SymmetricTensor<2, 3> &G);

    inline constexpr int symmetric_pairs[6][2] =
      {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};

    /// clamped_inverse() for the lanes of @p lanes. Returns those clamped.
    inline __attribute__((noinline, cold)) unsigned int
    clamped_inverse_by_lane(const unsigned int lanes,
                            const Simd<double> (&G)[6],
                            Simd<double> (&inverse)[6])
    {
      unsigned int clamped = 0;
      for (int lane = 0; lane < n_lanes<double>; ++lane)
        if ((lanes >> lane & 1u) != 0)
          {
            dealii::SymmetricTensor<2, 3> G_of_lane;
            for (int s = 0; s < 6; ++s)
              G_of_lane[symmetric_pairs[s][0]][symmetric_pairs[s][1]] =
                G[s][lane];
            const ClampedInverse result = clamped_inverse(G_of_lane);
            for (int s = 0; s < 6; ++s)
              inverse[s][lane] =
                result.inverse[symmetric_pairs[s][0]][symmetric_pairs[s][1]];
            clamped |= (result.is_clamped ? 1u : 0u) << lane;
          }
      return clamped;
    }
  } // namespace internal

  /// Computes the axial vector a(A).
  COROTET_ALWAYS_INLINE void
  axial_vector(const Simd<double> (&A)[3][3], Simd<double> (&a)[3])
  {
    a[0] = A[2][1] - A[1][2];
    a[1] = A[0][2] - A[2][0];
    a[2] = A[1][0] - A[0][1];
  }

  /// X += W(w).
  COROTET_ALWAYS_INLINE void
  add_skew(const Simd<double> (&w)[3], Simd<double> (&X)[3][3])
  {
    X[2][1] += w[0];
    X[1][2] -= w[0];
    X[0][2] += w[1];
    X[2][0] -= w[1];
    X[1][0] += w[2];
    X[0][1] -= w[2];
  }

  /// result = W(w) X.
  COROTET_ALWAYS_INLINE void
  skew_times(const Simd<double> (&w)[3],
             const Simd<double> (&X)[3][3],
             Simd<double> (&result)[3][3])
  {
    static_for<3>([&](auto b) {
      result[0][b] = w[1] * X[2][b] - w[2] * X[1][b];
      result[1][b] = w[2] * X[0][b] - w[0] * X[2][b];
      result[2][b] = w[0] * X[1][b] - w[1] * X[0][b];
    });
  }

  /// result = X W(w).
  COROTET_ALWAYS_INLINE void
  times_skew(const Simd<double> (&X)[3][3],
             const Simd<double> (&w)[3],
             Simd<double> (&result)[3][3])
  {
    static_for<3>([&](auto a) {
      result[a][0] = X[a][1] * w[2] - X[a][2] * w[1];
      result[a][1] = X[a][2] * w[0] - X[a][0] * w[2];
      result[a][2] = X[a][0] * w[1] - X[a][1] * w[0];
    });
  }

  /// Adds to @p moment the m with w . m = -weight sigma : W(w) A for all w: the
  /// change of the energy when the rotation turns under the strain.
  COROTET_ALWAYS_INLINE void
  add_moment(const Simd<double> weight,
             const Simd<double> (&sigma)[3][3],
             const Simd<double> (&A)[3][3],
             Simd<double> (&moment)[3])
  {
    static_for<3>([&](auto c) {
      constexpr int i = (c + 1) % 3, j = (c + 2) % 3;
      Simd<double>  sum{};
      static_for<3>(
        [&](auto k) { sum += sigma[i][k] * A[j][k] - sigma[j][k] * A[i][k]; });
      moment[c] += weight * sum;
    });
  }

  /// result = T a with a symmetric T.
  COROTET_ALWAYS_INLINE void
  symmetric_times(const Simd<double> (&T)[6],
                  const Simd<double> (&a)[3],
                  Simd<double> (&result)[3])
  {
    result[0] = T[0] * a[0] + T[5] * a[1] + T[4] * a[2];
    result[1] = T[5] * a[0] + T[1] * a[1] + T[3] * a[2];
    result[2] = T[4] * a[0] + T[3] * a[1] + T[2] * a[2];
  }

  /// G = tr(S) I - S. Linear in S: also the derivative of G by that of S.
  COROTET_ALWAYS_INLINE void
  spin_tensor(const Simd<double> (&S)[6], Simd<double> (&G)[6])
  {
    G[0] = S[1] + S[2];
    G[1] = S[0] + S[2];
    G[2] = S[0] + S[1];
    static_for<3>([&](auto s) { G[s + 3] = -S[s + 3]; });
  }

  /// @p inverse = G^{-1} of the stretch @p S, clamped. S is that of a polar
  /// decomposition, so no two of its eigenvalues have a negative sum. Returns
  /// the lanes where clamping made a difference, a bit each.
  COROTET_ALWAYS_INLINE unsigned int
  inverse_spin_tensor(const Simd<double> (&S)[6], Simd<double> (&inverse)[6])
  {
    using V = Simd<double>;
    V G[6];
    spin_tensor(S, G);
    inverse[0]     = G[1] * G[2] - G[3] * G[3];
    inverse[1]     = G[0] * G[2] - G[4] * G[4];
    inverse[2]     = G[0] * G[1] - G[5] * G[5];
    inverse[3]     = G[4] * G[5] - G[0] * G[3];
    inverse[4]     = G[3] * G[5] - G[1] * G[4];
    inverse[5]     = G[3] * G[4] - G[2] * G[5];
    const V det    = G[0] * inverse[0] + G[5] * inverse[5] + G[4] * inverse[4];
    const V trace  = G[0] + G[1] + G[2];
    const V factor = 1. / det;
    static_for<6>([&](auto s) { inverse[s] *= factor; });
    // In these lanes no eigenvalue is small, as the other two have at most a
    // product of trace^2 / 4. NaN is not among them.
    const unsigned int ordinary = internal::lane_bits(
      (trace > 0.) & (det > 0.25 * smallest_sum_of_stretches * trace * trace));
    const unsigned int others  = ~ordinary & ((1u << n_lanes<double>)-1);
    unsigned int       clamped = 0;
    if (__builtin_expect(static_cast<long>(others != 0), 0))
      {
        V copy[6];
        static_for<6>([&](auto s) { copy[s] = inverse[s]; });
        clamped = internal::clamped_inverse_by_lane(others, G, copy);
        static_for<6>([&](auto s) { inverse[s] = copy[s]; });
      }
    return clamped;
  }
} // namespace corotet

#endif
