// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_polar_decomposition_h
#define corotet_material_polar_decomposition_h

#include <deal.II/base/tensor.h>

namespace corotet
{
  /**
   * State of a cell as its deformation gradient F tells it.
   */
  enum class PolarState
  {
    /// det F > 0.
    regular,
    /// det F < 0: turned inside out.
    inverted,
    /// Collapsed to a plane, a line or a point (or not finite): the smallest
    /// singular value is below 1e-12 of the largest.
    degenerate
  };

  struct PolarDecomposition
  {
    dealii::Tensor<2, 3> rotation;
    PolarState           state;
  };

  /**
   * The rotation R of F = R S [seed, 2.78 to 2.84].
   *
   * For every F, however bad, R is a rotation: R^T R = I and det R = +1 to
   * round-off. For det F > 0 it is the orthogonal polar factor. For det F < 0
   * the smallest singular value is negated; where F has rank 2, 1 or 0 the
   * orthonormal system is completed. R is the rotation nearest to F in the
   * Frobenius norm; it is unique where the two smallest singular values, the
   * smallest with the sign of det F, do not sum to zero. If F is not finite,
   * R = I.
   *
   * Ordinary F take Newton's iteration for the polar factor (Higham, Computing
   * the polar decomposition, 1986); all others take a Jacobi SVD of F itself
   * (F^T F would lose half of the digits).
   */
  PolarDecomposition
  polar_decomposition(const dealii::Tensor<2, 3> &F);
} // namespace corotet

#endif
