// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/material/stress_measures.h>

#include <cmath>

#include <Eigen/Dense>

namespace corotet
{
  std::array<double, 3>
  principal_values(const dealii::SymmetricTensor<2, 3> &tensor)
  {
    const double size = tensor.norm();
    if (!std::isfinite(size))
      return {{size, size, size}};
    Eigen::Matrix3d matrix;
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        matrix(a, b) = tensor[a][b];
    // The solver iterates, as the closed formula loses half of the digits where
    // two values are equal, which they are in uniaxial stress.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      matrix, Eigen::EigenvaluesOnly);
    const Eigen::Vector3d &values = solver.eigenvalues();
    return {{values[2], values[1], values[0]}};
  }
} // namespace corotet
