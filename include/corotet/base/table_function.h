// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_table_function_h
#define corotet_base_table_function_h

#include <array>
#include <cstddef>
#include <vector>

namespace corotet
{
  /**
   * A function of one argument given by the rows (argument, value) of a table;
   * constant before the first and after the last row.
   *
   * Between rows it is linear, or cubic by Hermite's formula: continuously
   * differentiable, monotone where the rows are, so it never overshoots, and
   * of third order where they are smooth and monotone. Its slopes at rows are
   * those of the parabola through three neighbours, zero where values turn,
   * and at most three times those of the adjacent chords, which is sufficient
   * for monotonicity @cite fritsch1980. At local extrema between rows, whose
   * neighbours are flattened, it is of second order.
   */
  class TableFunction
  {
  public:
    enum class Interpolation
    {
      linear,
      cubic
    };

    /// There are as many arguments as values, two or more; arguments increase.
    TableFunction(const std::vector<double> &arguments,
                  const std::vector<double> &values,
                  const Interpolation        interpolation);

    double
    value(const double argument) const;

    /// Value, first and second derivative at @p argument of the polynomial
    /// between the rows @p row and @p row + 1.
    std::array<double, 3>
    derivatives(const std::size_t row, const double argument) const;

    /// The arguments of the rows.
    const std::vector<double> &
    rows() const
    {
      return arguments;
    }

    /// The values of the rows.
    const std::vector<double> &
    row_values() const
    {
      return values;
    }

    /// Whether the interpolation is cubic, and so smooth at the rows.
    bool
    is_cubic() const
    {
      return !slopes.empty();
    }

  private:
    std::vector<double> arguments;
    std::vector<double> values;
    /// The slopes at the rows; empty for linear interpolation.
    std::vector<double> slopes;
  };
} // namespace corotet

#endif
