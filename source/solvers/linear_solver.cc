// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/negligible.h>
#include <corotet/solvers/linear_solver.h>
#include <corotet/solvers/linear_solver_errors.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace corotet
{
  namespace
  {
    // Ratios of mass to stiffness are the same if they only differ by round-off
    // in the time step, for which this is the tolerance.
    constexpr double same_mass_ratio = 1e-6;
  } // namespace

  LinearSolver::LinearSolver(const LinearSolverParameters &parameters,
                             const double                  largest_tolerance)
    : parameters(parameters)
    , tolerance(std::min(parameters.tolerance, largest_tolerance))
    , preconditioner(parameters.preconditioner.make())
  {}

  unsigned int
  LinearSolver::largest_number(const bool             is_new,
                               const TangentOperator *J) const
  {
    constexpr double many = 1000, least = 100;
    double           most = parameters.max_iterations;
    // Far from a solution exact tangents may be nearly singular; Newton's
    // method has another tangent.
    if (J != nullptr && J->is_exact())
      most = std::min(most, std::max(many / preconditioner->cost(), least));
    // A solve shows earlier whether the preconditioner is outdated.
    if (!is_new)
      most = std::min(most, least + 2. * first_iterations);
    return most;
  }

  unsigned int
  LinearSolver::solve_patiently(const bool               is_new,
                                const EffectiveOperator &A,
                                const TangentOperator   *J,
                                Vector                  &x,
                                const Vector            &b,
                                const Vector            &displacement,
                                const double             wanted)
  {
    unsigned int done  = 0;
    done_before_change = 0;
    has_changed        = false;
    // If the operator is the one that the preconditioner was made of, the
    // latter counts as new.
    unsigned int most =
      largest_number(is_new || (J == nullptr && A.version() == built_version),
                     J);
    const auto change_it = [&](const double expected) {
      stop_question.ask(b.get_mpi_communicator());
      const bool is_other =
        preconditioner->change(A, J, displacement, done, expected);
      if (!is_other)
        return;
      done_before_change = done;
      has_changed        = true;
      most =
        std::min(parameters.max_iterations, done + largest_number(true, J));
      ++n_builds;
    };
    for (;;)
      {
        const unsigned int limit = std::min(
          most, preconditioner->patience(is_new || has_changed, J != nullptr));
        if (limit <= done && limit < most)
          {
            change_it(done);
            continue;
          }
        try
          {
            return done + solve_with(A, J, x, b, wanted, limit - done);
          }
        catch (const dealii::SolverControl::NoConvergence &failure)
          {
            done += failure.last_step;
            if (limit == most)
              throw dealii::SolverControl::NoConvergence(done,
                                                         failure.last_residual);
            // The forecast assumes that the residual goes on falling as before;
            // it may not have begun to fall.
            double digits = std::log(norm(b) / failure.last_residual) /
                            std::log(norm(b) / wanted);
            if (!std::isfinite(digits))
              {
                x      = 0;
                digits = 0;
              }
            change_it(done / std::clamp(digits, 0.1, 1.));
          }
      }
  }

  bool
  LinearSolver::is_round_off(const EffectiveOperator &A,
                             const TangentOperator   *J,
                             const Vector            &x,
                             const Vector            &b) const
  {
    Vector r(b);
    if (J != nullptr)
      J->vmult(r, x);
    else
      A.vmult(r, x);
    r -= b;
    // Round-off that is larger than b tells nothing: x has run away along a
    // motion that nothing resists.
    const double round_off = A.round_off(x);
    return norm(r) <= round_off && round_off < norm(b);
  }

  void
  LinearSolver::take_note(const unsigned int       iterations,
                          const bool               was_built,
                          const EffectiveOperator &A,
                          const TangentOperator   *J,
                          const double             loosest)
  {
    // Iterations are converted to those of a solve to the full tolerance.
    const double digits =
      loosest > tolerance ? std::log(loosest) / std::log(tolerance) : 1.;
    const auto with_this =
      static_cast<unsigned int>((iterations - done_before_change) / digits);
    if (was_built)
      {
        first_iterations = with_this;
        more_iterations  = 0;
      }
    // If the operator has not changed, a new preconditioner would be the same.
    else if (with_this > first_iterations &&
             (J != nullptr || A.version() != built_version))
      more_iterations += with_this - first_iterations;
    unsigned int acceptable =
      preconditioner->acceptable_iterations(first_iterations);
    // A new preconditioner is no better than at the first solve with it, as
    // most are made of the effective operator.
    if (J != nullptr)
      acceptable = std::max(acceptable, 3 * first_iterations / 2 + 3);
    is_built = with_this <= acceptable &&
               more_iterations <= preconditioner->build_cost() &&
               !preconditioner->is_worth_another(with_this);
    if (preconditioner->take_note(with_this, was_built))
      is_built = false;
  }

  unsigned int
  LinearSolver::solve(const EffectiveOperator &A,
                      Vector                  &x,
                      const Vector            &b,
                      const Vector            &displacement,
                      const TangentOperator   *J,
                      const double             limit,
                      const double             loosest)
  {
    const double b_norm = norm(b);
    const double wanted =
      std::min(std::max(tolerance, loosest) * b_norm, limit);
    x = 0;
    if (!std::isfinite(b_norm))
      throw ComputationError("the right side of a linear system is not finite");
    if (b_norm <= negligible)
      return 0;
    if (std::abs(A.mass_ratio() - built_mass_ratio) >
        same_mass_ratio * built_mass_ratio)
      is_built = false;
    if (A.surface_size() > 2 * built_surface ||
        built_surface > 2 * A.surface_size())
      is_built = false;
    const bool first_solve = !is_built;
    if (first_solve)
      {
        stop_question.ask(b.get_mpi_communicator());
        preconditioner->build_for(A, J, displacement);
        built_mass_ratio = A.mass_ratio();
        built_surface    = A.surface_size();
        built_version    = A.version();
        ++n_builds;
      }
    else if (A.version() != known_version)
      preconditioner->update(A);
    known_version = A.version();

    unsigned int iterations = 0;
    // The preconditioner counts as built again after the solve has succeeded.
    is_built = false;
    try
      {
        iterations =
          solve_patiently(first_solve, A, J, x, b, displacement, wanted);
      }
    catch (const dealii::SolverControl::NoConvergence &failure)
      {
        if (is_round_off(A, J, x, b))
          {
            is_built = !first_solve;
            return failure.last_step;
          }
        if (!first_solve)
          // Perhaps only the preconditioner was outdated.
          return solve(A, x, b, displacement, J, limit, loosest);
        throw LinearSolverError(fmt::format(
          "the linear solver stopped after {} iterations at a relative "
          "residual of {:.3g}; required is {:.3g} within {} iterations",
          failure.last_step,
          failure.last_residual / b_norm,
          wanted / b_norm,
          parameters.max_iterations));
      }

    take_note(iterations, first_solve || has_changed, A, J, loosest);
    return iterations;
  }
} // namespace corotet
