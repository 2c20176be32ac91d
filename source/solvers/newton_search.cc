// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Searches along directions of Newton's method.

#include <algorithm>
#include <utility>

#include "newton_iteration.h"

namespace corotet
{
  void
  Newton::Iteration::search_from_best(const bool dx_is_known)
  {
    ++report.line_searches;
    increment_is_round_off = false;
    has_stalled            = false;
    problem.restore();
    evaluate();
    if (!dx_is_known)
      find_direction();
    else if (!is_from_best)
      dx = best_dx;
    const double value = residual.value;
    const double slope = r * dx;
    if (!problem.has_energy() || slope > 0)
      if (const double length = line_search(value, slope); length > 0)
        {
          // After a search that gained little, full increments would repeat
          // their earlier path.
          const bool could_rise =
            std::exchange(may_rise,
                          problem.has_energy() || length > 0.01 ||
                            residual.value < 0.95 * value);
          if (!could_rise && !may_rise)
            fail("gets no further along its directions");
          n_without_progress = 0;
          best               = residual.value;
          return;
        }
    if (definite || !use_definite_tangent())
      {
        problem.restore();
        evaluate();
        fail("found no descent along its direction");
      }
    search_from_best(false);
  }

  double
  Newton::Iteration::line_search(const double value, const double slope)
  {
    double length = 1;
    for (unsigned int trial = 0; trial < max_trials; ++trial)
      {
        problem.restore();
        const NewtonProblem::Norm increment = problem.add(length, dx);
        evaluate();
        double next = 0.1 * length;
        if (residual.is_finite())
          {
            const double here = r * dx;
            if (problem.has_energy() ?
                  here >= -0.5 * slope :
                  residual.value <= (1 - 1e-4 * length) * value)
              {
                error = increment.value;
                size  = increment.scale;
                record(increment, length);
                return length;
              }
            // Secant to the zero of r . dx; parabola to the minimum of |r|^2,
            // whose slope at the start is -2 |r|^2 for an exact tangent.
            const double ratio = residual.value / value;
            next               = length * (problem.has_energy() ?
                                             slope / (slope - here) :
                                             length / (ratio * ratio - 1 + 2 * length));
          }
        length = std::clamp(next, 0.1 * length, 0.5 * length);
      }
    return 0;
  }
} // namespace corotet
