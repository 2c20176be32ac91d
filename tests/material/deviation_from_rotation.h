// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_material_deviation_from_rotation_h
#define corotet_tests_material_deviation_from_rotation_h

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>

namespace corotet::tests
{
  /// The largest deviation from R^T R = I and det R = 1; 1e300 if an entry is
  /// not a number.
  inline double
  deviation_from_rotation(const dealii::Tensor<2, 3> &R)
  {
    const dealii::Tensor<2, 3> C       = transpose(R) * R;
    double                     largest = std::abs(determinant(R) - 1);
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        largest = std::max(largest, std::abs(C[a][b] - (a == b ? 1 : 0)));
    return std::isfinite(largest) ? largest : 1e300;
  }
} // namespace corotet::tests

#endif
