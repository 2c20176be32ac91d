// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/table_function.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace corotet
{
  namespace
  {
    // The slope nearest to @p slope with which the cubic function is monotone
    // next to a chord of slope @p chord.
    double
    limited(const double slope, const double chord)
    {
      return chord > 0 ? std::clamp(slope, 0., 3 * chord) :
                         std::clamp(slope, 3 * chord, 0.);
    }

    // The slope, at the first of three rows, of the parabola through them,
    // computed from the two distances and the slopes of the two chords.
    double
    end_slope(const double h0,
              const double h1,
              const double chord0,
              const double chord1)
    {
      return limited(chord0 + h0 * (chord0 - chord1) / (h0 + h1), chord0);
    }

    std::vector<double>
    monotone_slopes(const std::vector<double> &x, const std::vector<double> &f)
    {
      const std::size_t   n = x.size() - 1;
      std::vector<double> h(n), chords(n);
      for (std::size_t i = 0; i < n; ++i)
        {
          h[i]      = x[i + 1] - x[i];
          chords[i] = (f[i + 1] - f[i]) / h[i];
        }
      if (n == 1)
        return {chords[0], chords[0]};

      std::vector<double> slopes(n + 1);
      slopes[0] = end_slope(h[0], h[1], chords[0], chords[1]);
      slopes[n] = end_slope(h[n - 1], h[n - 2], chords[n - 1], chords[n - 2]);
      for (std::size_t i = 1; i < n; ++i)
        {
          const double parabola =
            (h[i] * chords[i - 1] + h[i - 1] * chords[i]) / (h[i - 1] + h[i]);
          slopes[i] = limited(limited(parabola, chords[i - 1]), chords[i]);
        }
      return slopes;
    }
  } // namespace

  TableFunction::TableFunction(const std::vector<double> &arguments,
                               const std::vector<double> &values,
                               const Interpolation        interpolation)
    : arguments(arguments)
    , values(values)
  {
    Assert(arguments.size() >= 2 && arguments.size() == values.size(),
           dealii::ExcMessage("A table has at least two rows."));
    Assert(std::adjacent_find(arguments.begin(),
                              arguments.end(),
                              std::greater_equal<>()) == arguments.end(),
           dealii::ExcMessage("The arguments of a table increase."));
    if (interpolation == Interpolation::cubic)
      slopes = monotone_slopes(arguments, values);
  }

  double
  TableFunction::value(const double argument) const
  {
    if (argument <= arguments.front())
      return values.front();
    if (argument >= arguments.back())
      return values.back();
    if (std::isnan(argument))
      return argument;

    const std::size_t i =
      std::upper_bound(arguments.begin(), arguments.end(), argument) -
      arguments.begin() - 1;
    return derivatives(i, argument)[0];
  }

  std::array<double, 3>
  TableFunction::derivatives(const std::size_t row, const double argument) const
  {
    const double h = arguments[row + 1] - arguments[row];
    const double d = values[row + 1] - values[row];
    const double s = (argument - arguments[row]) / h;
    // Values lie between those of the two rows in both interpolations.
    // Round-off could violate that where slopes are subnormal and rows are far
    // apart.
    const auto between = [&](const double value) {
      return std::clamp(value,
                        std::min(values[row], values[row + 1]),
                        std::max(values[row], values[row + 1]));
    };
    if (slopes.empty())
      return {{between(values[row] + s * d), d / h, 0.}};
    const double a  = h * slopes[row];
    const double b  = h * slopes[row + 1];
    const double c2 = 3 * d - 2 * a - b;
    const double c3 = a + b - 2 * d;
    return {{between(values[row] + s * (a + s * (c2 + s * c3))),
             (a + s * (2 * c2 + s * 3 * c3)) / h,
             (2 * c2 + 6 * s * c3) / (h * h)}};
  }
} // namespace corotet
