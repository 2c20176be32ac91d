// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_newton_report_h
#define corotet_solvers_newton_report_h

#include <string>
#include <vector>

namespace corotet
{
  /**
   * One iteration of Newton's method.
   */
  struct NewtonIteration
  {
    /// Residual after the iteration, relative to the forces.
    double residual;
    /// |dx| / |x|.
    double increment;
    /// Part of the increment that a line search took; 1 without a search.
    double length;
    /// Whether the definite tangent replaced the one asked for.
    bool         definite;
    unsigned int linear_iterations;
  };

  struct NewtonReport
  {
    /// What kept the residual from reaching its tolerance.
    enum class RoundOff
    {
      /// Nothing: it has reached the tolerance.
      none,
      /// The residual is round-off.
      of_residual,
      /// The last increment was no more than the round-off of x.
      of_increment
    };

    RoundOff round_off = RoundOff::none;
    /// The residual of the worst part in terms of its forces, if iterations
    /// could not reduce it as far as required; else 0.
    double unsolved_part = 0;
    /// Relative residual at the end.
    double                       final_residual    = 0;
    unsigned int                 iterations        = 0;
    unsigned int                 linear_iterations = 0;
    unsigned int                 line_searches     = 0;
    double                       first_residual    = 0;
    std::vector<NewtonIteration> history;

    /// log(e_k / e_k-1) / log(e_k-1 / e_k-2) with the last three increments e
    /// above round-off. NaN if there are fewer, or if they do not at least
    /// halve each time, or were shortened.
    double
    observed_order() const;

    /// The history as a line of text.
    std::string
    text() const;
  };
} // namespace corotet

#endif
