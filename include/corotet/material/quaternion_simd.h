// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_quaternion_simd_h
#define corotet_material_quaternion_simd_h

#include <corotet/material/polar_decomposition_simd.h>

/**
 * Rotations as unit quaternions (w, x, y, z), a cell per lane: four numbers to
 * keep instead of nine. They are kept times the square root of two, so that the
 * entries of the matrix are sums of products.
 */
namespace corotet
{
  /**
   * The quaternion @p q of a rotation @p R, exact to round-off for every angle.
   * Row i of the symmetric matrix 4 q (x) q, whose entries are sums of those of
   * R, is q times a number; the row of the largest component is taken
   * [shepperd1978], for which that number is at least 2.
   */
  COROTET_ALWAYS_INLINE void
  to_quaternion(const Simd<double> (&R)[3][3], Simd<double> (&q)[4])
  {
    using V = Simd<double>;
    const V skew[3]{R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]};
    const V symmetric[3]{R[2][1] + R[1][2],
                         R[0][2] + R[2][0],
                         R[1][0] + R[0][1]};
    V       largest = 1. + R[0][0] + R[1][1] + R[2][2];
    q[0]            = largest;
    static_for<3>([&](auto k) { q[k + 1] = skew[k]; });
    static_for<3>([&](auto a) {
      constexpr int b = (a + 1) % 3, c = (a + 2) % 3;
      const V       square    = 1. + R[a][a] - R[b][b] - R[c][c];
      const auto    is_larger = square > largest;
      q[0]                    = is_larger ? skew[a] : q[0];
      q[a + 1]                = is_larger ? square : q[a + 1];
      q[b + 1]                = is_larger ? symmetric[c] : q[b + 1];
      q[c + 1]                = is_larger ? symmetric[b] : q[c + 1];
      largest                 = is_larger ? square : largest;
    });
    // The factor is in [2, 8]: four steps leave only round-off.
    V factor = 0.5 * (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    internal::approximate_rsqrt<4>(factor);
    static_for<4>([&](auto i) { q[i] *= factor; });
  }

  /// The rotation @p R of a quaternion of to_quaternion().
  COROTET_ALWAYS_INLINE void
  to_rotation(const Simd<double> (&q)[4], Simd<double> (&R)[3][3])
  {
    using V = Simd<double>;
    static_for<3>([&](auto a) {
      constexpr int b = (a + 1) % 3, c = (a + 2) % 3;
      R[a][a]      = 1. - q[b + 1] * q[b + 1] - q[c + 1] * q[c + 1];
      const V same = q[a + 1] * q[b + 1];
      const V turn = q[0] * q[c + 1];
      R[a][b]      = same - turn;
      R[b][a]      = same + turn;
    });
  }
} // namespace corotet

#endif
