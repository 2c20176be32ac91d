// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_operators_lanes_h
#define corotet_tests_operators_lanes_h

#include <corotet/base/simd.h>

#include <gtest/gtest.h>

#include <cmath>

namespace corotet::tests
{
  /// Numbers of size one without a pattern, which differ between lanes and
  /// between values of @p i.
  inline Simd<double>
  some_numbers(const int i)
  {
    Simd<double> result;
    for (int lane = 0; lane < n_lanes<double>; ++lane)
      result[lane] = std::sin(1.7 * i + 0.3 * lane + 1);
    return result;
  }

  inline void
  expect_same(const Simd<double> &a,
              const Simd<double> &b,
              const double        tolerance)
  {
    for (int lane = 0; lane < n_lanes<double>; ++lane)
      EXPECT_NEAR(a[lane], b[lane], tolerance);
  }
} // namespace corotet::tests

#endif
