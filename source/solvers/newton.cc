// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/solvers/newton.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "newton_iteration.h"
#include "residual_rate.h"

namespace corotet
{
  void
  Newton::Iteration::run()
  {
    n_expected            = std::exchange(newton.n_last, 0);
    residual              = problem.improve_guess(r, problem.residual(r));
    report.first_residual = report.final_residual = residual.relative();
    if (!residual.is_finite())
      throw ComputationError("the forces are not finite in Newton iteration "
                             "0");
    if (residual.is_below(1e-3 * parameters.residual_tolerance) &&
        have_parts_converged())
      return;
    if (is_round_off() && have_parts_converged())
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
        const bool has_failed = !try_to_iterate();
        const bool converged =
          has_failed || (has_converged() && have_parts_converged());
        if (converged && n_needed == 0)
          n_needed = report.iterations;
        // The last linear solve must have had the full tolerance.
        if (converged &&
            (tolerance_of_solve == 0 || has_failed || is_round_off()))
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

  bool
  Newton::Iteration::is_within_round_off() const
  {
    const bool was_tried = has_stalled || report.iterations >= many;
    return residual.value <= residual.round_off ||
           (was_tried && residual.value <= residual.most_round_off);
  }

  bool
  Newton::Iteration::is_round_off()
  {
    if (!is_within_round_off())
      return false;
    if (cannot_improve || report.iterations >= parameters.max_iterations ||
        have_settled())
      return true;
    if (!unexplained)
      unexplained = problem.unexplained_residual(r);
    return *unexplained == 0 ||
           (*unexplained <= parameters.residual_tolerance * residual.scale &&
            has_small_error());
  }

  bool
  Newton::Iteration::have_settled() const
  {
    if (report.iterations < 2)
      return false;
    const double q = last_increment / increment_before;
    return q > stalled ?
             report.iterations >= many :
             last_increment * q / (1 - q) <= small_error * first_increment;
  }

  bool
  Newton::Iteration::has_converged()
  {
    // The last question is the most expensive one.
    return increment_is_round_off ||
           (has_small_residual() && has_small_error()) || is_round_off();
  }

  bool
  Newton::Iteration::have_parts_converged()
  {
    if (!of_parts)
      of_parts = problem.residual_of_parts(r);
    const bool are_ready =
      *of_parts <= of_parts_over_whole * parameters.residual_tolerance;
    report.unsolved_part = are_ready ? 0. : *of_parts;
    if (are_ready)
      return true;
    whole_is_ready = report.iterations > 0;
    n_in_vain      = *of_parts < 0.5 * best_of_parts ? 0 : n_in_vain + 1;
    best_of_parts  = std::min(best_of_parts, *of_parts);
    return cannot_improve || n_in_vain >= most_in_vain ||
           report.iterations >= parameters.max_iterations;
  }

  double
  Newton::Iteration::contraction(const double previous, const double increment)
  {
    // Increments that do not become smaller belong to a part that has not
    // converged, whose forces are small beside others.
    if (report.iterations > 0 && increment > stalled * last_increment &&
        n_slow < most_slow)
      {
        ++n_slow;
        return 1;
      }
    return residual.value / previous;
  }

  NewtonReport::RoundOff
  Newton::Iteration::round_off_limit()
  {
    using RoundOff = NewtonReport::RoundOff;
    if (has_small_residual())
      return RoundOff::none;
    return is_round_off() ? RoundOff::of_residual : RoundOff::of_increment;
  }

  void
  Newton::Iteration::fail(const std::string &what) const
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

  double
  Newton::Iteration::linear_tolerance() const
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

  void
  Newton::Iteration::find_direction()
  {
    try
      {
        tolerance_of_solve = linear_tolerance();
        linear_iterations = problem.solve_linearized(dx, r, tolerance_of_solve);
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
        linear_iterations = problem.solve_linearized(dx, r, tolerance_of_solve);
        return;
      }
    fail("met a direction that is not finite");
  }

  bool
  Newton::Iteration::use_definite_tangent()
  {
    definite = problem.use_definite_tangent(true);
    return definite;
  }

  bool
  Newton::Iteration::try_to_iterate()
  {
    try
      {
        iterate();
        return true;
      }
    catch (const ComputationError &)
      {
        if (!whole_is_ready)
          throw;
        problem.restore();
        evaluate();
        return false;
      }
  }

  void
  Newton::Iteration::iterate()
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
    try
      {
        find_direction();
      }
    catch (const ComputationError &)
      {
        // Without a direction, a residual within round-off is good enough.
        cannot_improve = is_within_round_off();
        if (!cannot_improve)
          throw;
        return;
      }
    if (n_without_progress == 0)
      {
        // The present point is the best one so far.
        problem.keep();
        is_from_best = true;
      }
    const double              previous  = residual.value;
    const NewtonProblem::Norm increment = problem.add(1., dx);
    evaluate();
    increment_is_round_off = increment.value <= increment.round_off;
    has_stalled            = residual.value > stalled * previous;
    if (residual.is_finite() &&
        (residual.value < best || is_within_round_off() ||
         increment_is_round_off ||
         (may_rise && n_without_progress < patience &&
          residual.value < divergence * best)))
      {
        // If the residual falls after an increment has raised it, that is
        // progress, too.
        if (residual.value < best)
          n_without_progress = 0;
        else if (n_without_progress == 0 || residual.value >= previous)
          ++n_without_progress;
        const double theta = contraction(previous, increment.value);
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
  Newton::Iteration::record(const NewtonProblem::Norm &increment,
                            const double               length)
  {
    increment_before = std::exchange(last_increment, increment.value);
    if (report.iterations == 0)
      first_increment = increment.value;
    ++report.iterations;
    values.push_back(residual.value);
    report.linear_iterations += linear_iterations;
    report.history.push_back({residual.relative(),
                              increment.value / increment.scale,
                              length,
                              definite,
                              linear_iterations});
  }

  void
  Newton::Iteration::check_progress() const
  {
    if (problem.has_energy() || is_within_round_off())
      return;
    const double needed =
      iterations_needed(values, parameters.residual_tolerance * residual.scale);
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
