// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The largest eigenvalue of a tridiagonal matrix, whatever its scale is.

#include <corotet/solvers/largest_eigenvalue.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace corotet;

// n masses between n + 1 springs of the same stiffness k have K = k tridiag
// (-1, 2, -1), with the largest eigenvalue 2 k (1 - cos(n pi / (n + 1))) and
// the eigenvector sin(n j pi / (n + 1)), whose norm is sqrt((n + 1) / 2).
// LAPACK is asked for 1e-6 of the sum of all entries.
TEST(LargestEigenvalue, OfTridiagonal)
{
  for (const unsigned int n : {1u, 2u, 5u, 20u})
    for (const double k : {1., 1e-3, 1e-6, 1e-12, 1e-60, 1e12, 1e60})
      {
        const auto pair =
          largest_of_tridiagonal(std::vector<double>(n, 2 * k),
                                 std::vector<double>(n - 1, -k));
        const double angle = n * M_PI / (n + 1);
        EXPECT_NEAR(pair.first / k, 2 * (1 - std::cos(angle)), 4e-6 * n);
        EXPECT_NEAR(pair.second,
                    std::abs(std::sin(n * angle)) / std::sqrt((n + 1) / 2.),
                    1e-6)
          << n << ' ' << k;
      }
}
