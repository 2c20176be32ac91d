// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_benchmarks_svd_rotation_h
#define corotet_benchmarks_svd_rotation_h

#include <Eigen/LU>
#include <Eigen/SVD>

namespace corotet::benchmarks
{
  /// The rotation nearest to F by singular value decomposition, as in most
  /// codes.
  inline Eigen::Matrix3d
  svd_rotation(const Eigen::Matrix3d &F)
  {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(F,
                                                Eigen::ComputeFullU |
                                                  Eigen::ComputeFullV);
    Eigen::Matrix3d                         U = svd.matrixU();
    if ((U * svd.matrixV().transpose()).determinant() < 0)
      U.col(2) *= -1;
    return U * svd.matrixV().transpose();
  }
} // namespace corotet::benchmarks

#endif
