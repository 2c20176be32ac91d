// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_rotated_frame_h
#define corotet_operators_rotated_frame_h

#include <corotet/material/corotational_simd.h>
#include <corotet/operators/sweep.h>

/**
 * With one rotation per cell, all quantities are rotated by it: B = F R^T
 * replaces R^T F, and R disappears from the formulas.
 */
namespace corotet
{
  /// Loads the gradients of the reference coordinates rotated by the cells'
  /// rotations: with these, grad u becomes grad u R^T.
  COROTET_ALWAYS_INLINE void
  load_rotated(const ElasticData &data,
               const unsigned int batch,
               Simd<double> (&g)[9])
  {
    const Simd<double> scale =
      load_aligned<batch_size>(data.constants[batch].scale);
    // Lanes without a cell have zeros throughout.
    const Simd<double> factor = 1. / (scale > 0. ? scale : broadcast(1.));
    static_for<9>([&](auto i) {
      g[i] = factor *
             load_aligned<batch_size>(data.coefficients[batch].gradients[i]);
    });
  }

  /// Loads the gradients of the reference coordinates at rest.
  COROTET_ALWAYS_INLINE void
  load_at_rest(const ElasticData &data,
               const unsigned int batch,
               Simd<double> (&g)[9])
  {
    if (data.has_rotations())
      static_for<9>(
        [&](auto i) { g[i] = lanes(data.at_rest[batch].inverse_jacobian[i]); });
    else
      load_rotated(data, batch, g);
  }

  /// B <- R^T + B: computes F R^T from grad u R^T.
  COROTET_ALWAYS_INLINE void
  add_transposed(const Simd<double> (&R)[3][3], Simd<double> (&B)[3][3])
  {
    static_for<9>([&](auto ab) { B[ab / 3][ab % 3] += R[ab % 3][ab / 3]; });
  }
} // namespace corotet

#endif
