// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/newton_report.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace corotet
{
  double
  NewtonReport::observed_order() const
  {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    // The last increments may be round-off only.
    std::size_t n = history.size();
    while (n > 0 && history[n - 1].increment < 1e-13)
      --n;
    if (n < 3)
      return none;
    double e[3];
    for (unsigned int k = 0; k < 3; ++k)
      {
        if (history[n - 3 + k].length != 1)
          return none;
        e[k] = std::log(history[n - 3 + k].increment);
      }
    // The order is that of convergence, so increments must already decrease.
    return e[1] < e[0] - 0.7 && e[2] < e[1] - 0.7 ?
             (e[2] - e[1]) / (e[1] - e[0]) :
             none;
  }

  std::string
  NewtonReport::text() const
  {
    std::string residuals = fmt::format("{:.1e}", first_residual);
    std::string increments;
    // Long histories show only their start and end.
    constexpr std::size_t shown = 8;
    for (std::size_t k = 0; k < history.size(); ++k)
      {
        const NewtonIteration &step = history[k];
        if (k == shown && history.size() > 2 * shown)
          {
            k = history.size() - shown - 1;
            residuals += " ..";
            increments += " ..";
            continue;
          }
        residuals += fmt::format(" {:.1e}", step.residual);
        increments += fmt::format("{}{:.1e}",
                                  increments.empty() ? "" : " ",
                                  step.increment);
        if (step.length != 1)
          increments += fmt::format(" (x {:.2g})", step.length);
        if (step.definite)
          increments += " (frozen)";
      }
    std::string text =
      fmt::format("Newton {} iterations, linear {}; residual {}; increment {}",
                  iterations,
                  linear_iterations,
                  residuals,
                  increments);
    const double order = observed_order();
    if (std::isfinite(order))
      text += fmt::format("; order {:.2f}", order);
    return text;
  }
} // namespace corotet
