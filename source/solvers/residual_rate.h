// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_solvers_residual_rate_h
#define corotet_source_solvers_residual_rate_h

#include <cmath>
#include <vector>

namespace corotet
{
  /// Number of iterations from which the rate of the residual is estimated.
  inline constexpr unsigned int rate_window = 6;

  /// The number of further iterations that residuals need to fall to @p wanted
  /// at the rate of the last ones; zero if these are too few, or do not fall.
  inline double
  iterations_needed(const std::vector<double> &residuals, const double wanted)
  {
    const std::size_t n = residuals.size();
    if (n < 2 * rate_window || residuals[n - 1] <= wanted)
      return 0;
    const double ratio = residuals[n - 1] / residuals[n - 1 - rate_window];
    return ratio < 1 ? rate_window * std::log(wanted / residuals[n - 1]) /
                         std::log(ratio) :
                       0;
  }
} // namespace corotet

#endif
