// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/material/polar_decomposition.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

#include <Eigen/Dense>

namespace corotet
{
  namespace
  {
    using dealii::Tensor;

    // Matrix of cofactors: det(A) A^{-T}.
    Tensor<2, 3>
    cofactors(const Tensor<2, 3> &A)
    {
      Tensor<2, 3> C;
      for (unsigned int i = 0; i < 3; ++i)
        C[i] = cross_product_3d(A[(i + 1) % 3], A[(i + 2) % 3]);
      return C;
    }

    // Newton's iteration X <- (X + X^{-T}) / 2 for the orthogonal factor of A
    // with norm O(1) and det A well above zero. Returns whether it converged.
    bool
    newton_iteration(Tensor<2, 3> &X)
    {
      for (unsigned int k = 0; k < 12; ++k)
        {
          const Tensor<2, 3> C      = cofactors(X);
          const Tensor<2, 3> next   = 0.5 * (X + C / (X[0] * C[0]));
          const double       change = (next - X).norm_square();
          X                         = next;
          // Convergence is quadratic: the next change would be the square of
          // this one, below round-off.
          if (change < 1e-17)
            return true;
        }
      return false;
    }

    PolarDecomposition
    by_svd(const Tensor<2, 3> &A)
    {
      Eigen::Matrix3d matrix;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          matrix(i, j) = A[i][j];
      const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix,
                                                  Eigen::ComputeFullU |
                                                    Eigen::ComputeFullV);
      // Without a copy, GCC takes them for values that are never set.
      // NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
      const Eigen::Vector3d sigma = svd.singularValues();

      // U and V are orthonormal whatever the rank, as the SVD completes
      // collapsed directions. The column of the smallest singular value takes
      // the sign that makes U V^T a rotation.
      Eigen::Matrix3d U = svd.matrixU();
      const double    handedness =
        (U.determinant() < 0) == (svd.matrixV().determinant() < 0) ? 1. : -1.;
      U.col(2) *= handedness;
      const Eigen::Matrix3d R = U * svd.matrixV().transpose();

      PolarDecomposition result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          result.rotation[i][j] = R(i, j);
      result.state =
        handedness < 0 ? PolarState::inverted : PolarState::regular;
      if (sigma[2] <= 1e-12 * sigma[0])
        result.state = PolarState::degenerate;
      return result;
    }
  } // namespace

  PolarDecomposition
  polar_decomposition(const Tensor<2, 3> &F)
  {
    double largest = 0;
    bool   finite  = true;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          largest = std::max(largest, std::abs(F[i][j]));
          finite  = finite && std::isfinite(F[i][j]);
        }
    if (!finite || largest == 0)
      return {Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()),
              PolarState::degenerate};

    // Divide by a power of two: exact, and any scale is harmless afterwards.
    // In two steps, as 1/scale may overflow for the smallest numbers.
    const int    exponent = std::ilogb(largest);
    const int    half     = exponent / 2;
    Tensor<2, 3> A        = F * std::ldexp(1., -half);
    A *= std::ldexp(1., half - exponent);

    if (determinant(A) > 1e-2)
      {
        Tensor<2, 3> R = A;
        if (newton_iteration(R))
          return {R, PolarState::regular};
      }
    return by_svd(A);
  }
} // namespace corotet
