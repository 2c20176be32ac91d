// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/solvers/newton.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "residual_rate.h"

namespace corotet
{
  namespace
  {
    // Limit of full increments that raise the residual, before a line search.
    constexpr unsigned int patience = 5;
    // Limit of solves that begin with the definite tangent after failures.
    constexpr unsigned int longest_pause = 16;
    // Limit of trials of a line search: the last are some 1e-4 of the
    // increment.
    constexpr unsigned int max_trials = 10;
    // A residual may be round-off if a full increment leaves at least this part
    // of it, or after this many iterations.
    constexpr double       stalled = 0.5;
    constexpr unsigned int many    = 5;
    // The ratio of a residual to the best one that counts as divergence.
    constexpr double divergence = 1e8;
  } // namespace

  /**
   * The state of one solve.
   */
  class Newton::Iteration
  {
  public:
    Iteration(Newton &newton, NewtonProblem &problem, NewtonReport &report)
      : newton(newton)
      , parameters(newton.parameters)
      , problem(problem)
      , report(report)
      , r(newton.r)
      , dx(newton.dx)
      , best_dx(newton.best_dx)
    {}

    void
    run()
    {
      n_expected            = std::exchange(newton.n_last, 0);
      residual              = problem.improve_guess(r, problem.residual(r));
      report.first_residual = report.final_residual = residual.relative();
      if (!residual.is_finite())
        throw ComputationError("the forces are not finite in Newton iteration "
                               "0");
      if (residual.is_below(1e-3 * parameters.residual_tolerance))
        return;
      if (is_round_off())
        {
          report.round_off = round_off_limit();
          return;
        }
      if (parameters.linearly_implicit)
        {
          problem.use_definite_tangent(false);
          find_direction();
          record(problem.add(1., dx), 1.);
          return;
        }
      best = residual.value;
      while (report.iterations < parameters.max_iterations)
        {
          iterate();
          const bool converged = has_converged();
          if (converged && n_needed == 0)
            n_needed = report.iterations;
          // The last linear solve must have had the full tolerance.
          if (converged && (tolerance_of_solve == 0 || is_round_off()))
            {
              newton.n_last         = report.line_searches == 0 ? n_needed : 0;
              report.final_residual = residual.relative();
              report.round_off      = round_off_limit();
              return;
            }
          check_progress();
        }
      fail(fmt::format("did not converge in {} iterations",
                       parameters.max_iterations));
    }

  private:
    // A residual that may be round-off counts as such if a full increment has
    // not reduced it, or after many iterations.
    bool
    is_round_off() const
    {
      const bool was_tried = has_stalled || report.iterations >= many;
      return residual.value <= residual.round_off ||
             (was_tried && residual.value <= residual.most_round_off);
    }

    bool
    has_small_residual() const
    {
      return residual.is_below(parameters.residual_tolerance);
    }

    bool
    has_converged() const
    {
      return is_round_off() || increment_is_round_off ||
             (has_small_residual() &&
              (problem.is_linear() ||
               error <= parameters.increment_tolerance * size));
    }

    NewtonReport::RoundOff
    round_off_limit() const
    {
      using RoundOff = NewtonReport::RoundOff;
      if (has_small_residual())
        return RoundOff::none;
      return is_round_off() ? RoundOff::of_residual : RoundOff::of_increment;
    }

    [[noreturn]] void
    fail(const std::string &what) const
    {
      throw ComputationError(fmt::format(
        "Newton's method {}: the residual is {:.3g} of the forces (required: "
        "{:.3g}), the estimated error {:.3g} of the displacement (required: "
        "{:.3g}){}",
        what,
        residual.relative(),
        parameters.residual_tolerance,
        error / size,
        parameters.increment_tolerance,
        parameters.tangent == Tangent::consistent ?
          "" :
          "; Newton/Tangent = consistent may help"));
    }

    // The residual that a linear solve may leave, relative to r: a small part
    // of what quadratic convergence leaves after the iteration. That doubles
    // the digits in each iteration, and the last solve tells the number of
    // iterations to expect. The last one is solved fully. From the fifth on all
    // digits are reached; more than eight iterations are no quadratic
    // convergence.
    double
    linear_tolerance() const
    {
      constexpr double       share = 0.03, loosest = 0.01;
      constexpr unsigned int most = 5, too_many = 8;
      const auto             n = static_cast<int>(std::min(n_expected, most));
      const auto             k = static_cast<int>(report.iterations) + 1;
      if (problem.is_linear() || parameters.linearly_implicit || n_needed > 0 ||
          k >= n || n_expected > too_many || report.line_searches > 0)
        return 0;
      return std::min(share * std::pow(parameters.residual_tolerance,
                                       std::ldexp(1., k - n)),
                      loosest);
    }

    // Finds a direction from the present point, with the definite tangent if
    // the exact one fails.
    void
    find_direction()
    {
      try
        {
          tolerance_of_solve = linear_tolerance();
          linear_iterations =
            problem.solve_linearized(dx, r, tolerance_of_solve);
          if (report.iterations == 0 && !definite)
            newton.last_pause = 0;
          if (std::isfinite(norm(dx)))
            return;
        }
      catch (const ComputationError &)
        {
          if (definite || !use_definite_tangent())
            throw;
          if (report.iterations == 0)
            newton.n_without_exact = newton.last_pause =
              std::clamp(2 * newton.last_pause, 1u, longest_pause);
          linear_iterations =
            problem.solve_linearized(dx, r, tolerance_of_solve);
          return;
        }
      fail("met a direction that is not finite");
    }

    bool
    use_definite_tangent()
    {
      definite = problem.use_definite_tangent(true);
      return definite;
    }

    void
    iterate()
    {
      definite = false;
      problem.use_definite_tangent(false);
      if (report.iterations == 0 && newton.n_without_exact > 0)
        {
          --newton.n_without_exact;
          use_definite_tangent();
        }
      if (n_without_progress > 0 && std::exchange(is_from_best, false))
        best_dx = dx;
      find_direction();
      if (n_without_progress == 0)
        {
          // The present point is the best one so far.
          problem.keep();
          is_from_best = true;
        }
      const double              previous  = residual.value;
      const NewtonProblem::Norm increment = problem.add(1., dx);
      residual                            = problem.residual(r);
      increment_is_round_off = increment.value <= increment.round_off;
      has_stalled            = residual.value > stalled * previous;
      if (residual.is_finite() &&
          (residual.value < best || is_round_off() || increment_is_round_off ||
           (may_rise && n_without_progress < patience &&
            residual.value < divergence * best)))
        {
          // If the residual falls after an increment has raised it, that is
          // progress, too.
          if (residual.value < best)
            n_without_progress = 0;
          else if (n_without_progress == 0 || residual.value >= previous)
            ++n_without_progress;
          const double theta = residual.value / previous;
          error = increment.value * (theta < 0.5 ? theta / (1 - theta) : 1.);
          size  = increment.scale;
          record(increment, 1.);
          best = std::min(best, residual.value);
          return;
        }
      // Return to the best point, and search along the direction found there.
      search_from_best(true);
    }

    void
    search_from_best(const bool dx_is_known)
    {
      ++report.line_searches;
      increment_is_round_off = false;
      has_stalled            = false;
      problem.restore();
      residual = problem.residual(r);
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
          residual = problem.residual(r);
          fail("found no descent along its direction");
        }
      search_from_best(false);
    }

    // Moves x along dx; returns the part of dx that it took, or zero. Forces
    // that are not finite mean that x is too far.
    double
    line_search(const double value, const double slope)
    {
      double length = 1;
      for (unsigned int trial = 0; trial < max_trials; ++trial)
        {
          problem.restore();
          const NewtonProblem::Norm increment = problem.add(length, dx);
          residual                            = problem.residual(r);
          double next                         = 0.1 * length;
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

    void
    record(const NewtonProblem::Norm &increment, const double length)
    {
      ++report.iterations;
      values.push_back(residual.value);
      report.linear_iterations += linear_iterations;
      report.history.push_back({residual.relative(),
                                increment.value / increment.scale,
                                length,
                                definite,
                                linear_iterations});
    }

    // Throws if the residual has been falling far too slowly.
    void
    check_progress() const
    {
      if (problem.has_energy())
        return;
      const double needed =
        iterations_needed(values,
                          parameters.residual_tolerance * residual.scale);
      const unsigned int left = parameters.max_iterations - report.iterations;
      if (left > 0 && needed > 3. * left)
        fail(fmt::format("converges too slowly: at the rate of its last {} "
                         "iterations it needs {:.0f} more, and {} of {} are "
                         "left",
                         rate_window,
                         std::min(std::ceil(needed), 1e6),
                         left,
                         parameters.max_iterations));
    }

    Newton                 &newton;
    const NewtonParameters &parameters;
    NewtonProblem          &problem;
    NewtonReport           &report;
    Vector                 &r;
    Vector                 &dx;
    Vector                 &best_dx;

    NewtonProblem::Norm residual = {};
    double              error    = std::numeric_limits<double>::infinity();
    double              size     = 1;
    bool                definite = false;
    /// Whether dx is the direction at the best point; best_dx is it otherwise.
    bool is_from_best = false;
    /// Properties of the last full increment.
    bool         increment_is_round_off = false;
    bool         has_stalled            = false;
    unsigned int linear_iterations      = 0;
    double       tolerance_of_solve     = 0;
    /// Iterations of the last solve, if it has converged without a search, and
    /// those that this one needed.
    unsigned int n_expected         = 0;
    unsigned int n_needed           = 0;
    unsigned int n_without_progress = 0;
    /// Whether full increments may raise the residual.
    bool may_rise = true;
    /// Residual at the best point. A search for less energy may raise it.
    double best = 0;
    /// Residuals after each iteration.
    std::vector<double> values;
  };

  void
  Newton::solve(NewtonProblem &problem,
                const Vector  &prototype,
                NewtonReport  &report)
  {
    // Vectors of another problem may differ in size on other ranks only.
    if (r.get_partitioner() != prototype.get_partitioner())
      for (Vector *vector : {&r, &dx})
        vector->reinit(prototype);
    Iteration(*this, problem, report).run();
  }
} // namespace corotet
