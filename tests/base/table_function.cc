// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Interpolation in tables: which functions it reproduces, that it does not
// overshoot, its smoothness and its order.

#include <corotet/base/table_function.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

using namespace corotet;

namespace
{
  constexpr auto linear = TableFunction::Interpolation::linear;
  constexpr auto cubic  = TableFunction::Interpolation::cubic;

  const std::vector<double> uneven = {-1, -0.5, 0, 0.125, 1, 1.5, 4};

  std::vector<double>
  values(const std::vector<double>                   &arguments,
         const std::function<double(const double x)> &f)
  {
    std::vector<double> result(arguments.size());
    std::transform(arguments.begin(), arguments.end(), result.begin(), f);
    return result;
  }

  // Rows with flat parts, jumps, turns, and very different distances.
  const std::vector<double> rough_arguments =
    {0, 1, 2, 2.001, 3, 5, 6, 6.5, 7, 100, 101};
  const std::vector<double> rough_values =
    {0, 0, 0.1, 10, 10.1, 10.1, -5, -4.9, 20, 19, 18.999};
} // namespace

TEST(TableFunction, PassesThroughItsRows)
{
  for (const auto interpolation : {linear, cubic})
    {
      const TableFunction f(rough_arguments, rough_values, interpolation);
      for (unsigned int i = 0; i < rough_arguments.size(); ++i)
        EXPECT_EQ(f.value(rough_arguments[i]), rough_values[i]);
    }
}

TEST(TableFunction, IsConstantOutside)
{
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto interpolation : {linear, cubic})
    {
      const TableFunction f({1, 2, 4}, {5, 7, 6}, interpolation);
      for (const double x : {-infinity, -1., 0.999})
        EXPECT_EQ(f.value(x), 5);
      for (const double x : {4.001, 1e300, infinity})
        EXPECT_EQ(f.value(x), 6);
      EXPECT_TRUE(std::isnan(f.value(std::nan(""))));
    }
}

// A table of linear data, even of two rows only, gives the linear function, to
// the round-off of values up to 9.
TEST(TableFunction, ReproducesLinearFunctions)
{
  const auto line = [](const double x) { return 3 - 1.5 * x; };
  for (const auto interpolation : {linear, cubic})
    for (const std::vector<double> &rows :
         {uneven, std::vector<double>{-1., 4.}})
      {
        const TableFunction f(rows, values(rows, line), interpolation);
        for (double x = -1; x <= 4; x += 0.01)
          EXPECT_NEAR(f.value(x), line(x), 1e-14);
      }
}

// The parabola through three neighbours has the slopes of a quadratic, which
// stay below three times the chords': round-off of values up to 36.
TEST(TableFunction, CubicReproducesMonotoneQuadratics)
{
  const auto parabola = [](const double x) { return (x + 2) * (x + 2); };
  const TableFunction f(uneven, values(uneven, parabola), cubic);
  for (double x = -1; x <= 4; x += 0.01)
    EXPECT_NEAR(f.value(x), parabola(x), 1e-13);
}

// Between two rows values go from one to the other and never back, up to
// round-off of the largest value.
TEST(TableFunction, NeverOvershoots)
{
  for (const auto interpolation : {linear, cubic})
    {
      const TableFunction f(rough_arguments, rough_values, interpolation);
      for (unsigned int i = 0; i + 1 < rough_arguments.size(); ++i)
        {
          const double direction =
            rough_values[i + 1] > rough_values[i] ? 1 : -1;
          const unsigned int n    = 1000;
          double             last = rough_values[i];
          for (unsigned int k = 1; k <= n; ++k)
            {
              const double value =
                f.value(rough_arguments[i] +
                        k * (rough_arguments[i + 1] - rough_arguments[i]) / n);
              EXPECT_GE(direction * (value - last), -2e-14)
                << "row " << i << ", part " << k;
              last = value;
            }
          EXPECT_NEAR(last, rough_values[i + 1], 2e-14);
        }
    }
}

// Round-off does not lead out of the interval of two rows either: that of the
// slopes, which are subnormal numbers here, is multiplied by the distance of
// the rows.
TEST(TableFunction, NeverOvershootsByRoundOff)
{
  const std::vector<double> arguments = {0, 1, 2, 2000, 4000, 9000},
                            rows      = {3, 2, 64.9e-324, 0, 5e-323, 1};
  for (const auto interpolation : {linear, cubic})
    {
      const TableFunction f(arguments, rows, interpolation);
      for (unsigned int i = 0; i + 1 < rows.size(); ++i)
        for (double s = 0; s <= 1; s += 1 / 64.)
          {
            const double value =
              f.value(arguments[i] + s * (arguments[i + 1] - arguments[i]));
            EXPECT_GE(value, std::min(rows[i], rows[i + 1])) << i << ' ' << s;
            EXPECT_LE(value, std::max(rows[i], rows[i + 1])) << i << ' ' << s;
          }
    }
}

// The slopes on both sides of an inner row agree up to the step of the
// differences times the second derivative, which is below 60 for these rows.
// Those of linear interpolation differ by 1 and more.
TEST(TableFunction, CubicHasContinuousSlopes)
{
  const std::vector<double> x = {0, 1, 2, 4, 5, 6};
  const std::vector<double> y = {0, 1, 4, 4, 3, -3};
  const double              e = 1e-6;

  const auto largest_jump = [&](const TableFunction &f) {
    double largest = 0;
    for (unsigned int i = 1; i + 1 < x.size(); ++i)
      largest =
        std::max(largest,
                 std::abs(f.value(x[i] + e) - 2 * y[i] + f.value(x[i] - e)) /
                   e);
    return largest;
  };
  EXPECT_LE(largest_jump(TableFunction(x, y, cubic)), 60 * e);
  EXPECT_GE(largest_jump(TableFunction(x, y, linear)), 1);
}

// Error on a monotone function: second order for linear, third for cubic
// interpolation, whose slopes are of second order.
TEST(TableFunction, Orders)
{
  const auto error = [](const unsigned int n, const auto interpolation) {
    std::vector<double> rows(n + 1);
    for (unsigned int i = 0; i <= n; ++i)
      rows[i] = -1 + 2. * i / n;
    const TableFunction f(rows,
                          values(rows, [](double x) { return std::sin(x); }),
                          interpolation);
    double              largest = 0;
    for (double x = -1; x <= 1; x += 1e-4)
      largest = std::max(largest, std::abs(f.value(x) - std::sin(x)));
    return largest;
  };
  EXPECT_NEAR(std::log2(error(40, linear) / error(80, linear)), 2, 0.1);
  EXPECT_NEAR(std::log2(error(40, cubic) / error(80, cubic)), 3, 0.1);
}
