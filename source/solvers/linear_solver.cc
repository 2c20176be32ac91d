// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/negligible.h>
#include <corotet/solvers/conjugate_gradients.h>
#include <corotet/solvers/flexible_cg.h>
#include <corotet/solvers/linear_solver.h>

#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/solver_minres.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace corotet
{
  namespace
  {
    // Ratios of mass to stiffness that differ by no more are the same but for
    // round-off in the time step.
    constexpr double same_mass_ratio = 1e-6;

    // Directions that flexible conjugate gradients keep. On bent bodies more do
    // not save iterations, as long as the solver is not slow.
    constexpr unsigned int n_directions = 2;

    // After how many iterations GMRES starts again, which stores two vectors
    // for each: few of them make it stagnate on ill-conditioned systems.
    unsigned int
    basis_size(const Vector &b)
    {
      constexpr double few = 30, many = 200, memory = 64 << 20;
      return static_cast<unsigned int>(
        std::clamp(memory / (2 * sizeof(double) * b.size()), few, many));
    }
  } // namespace

  namespace
  {
    // The iterations of @p solve; if it does not converge, those that were @p
    // done before are counted, too.
    template <typename Solve>
    unsigned int
    after(const unsigned int done, const Solve &solve)
    {
      try
        {
          return solve();
        }
      catch (const dealii::SolverControl::NoConvergence &failure)
        {
          throw dealii::SolverControl::NoConvergence(done + failure.last_step,
                                                     failure.last_residual);
        }
    }
  } // namespace

  LinearSolver::LinearSolver(const LinearSolverParameters &parameters,
                             const double                  largest_tolerance)
    : parameters(parameters)
    , tolerance(std::min(parameters.tolerance, largest_tolerance))
    , preconditioner(parameters.preconditioner.make())
  {}

  template <typename Matrix>
  unsigned int
  LinearSolver::minimal_residuals(const Matrix      &A,
                                  const unsigned int limit,
                                  Vector            &x,
                                  const Vector      &b,
                                  const double       wanted) const
  {
    // MINRES measures residuals in the norm of the preconditioner, and a
    // preconditioner in single precision blurs them: it starts again from the
    // residual proper until that is small.
    Vector       r(b), dx(b);
    unsigned int iterations = 0;
    for (unsigned int round = 0; round < 10; ++round)
      {
        A.vmult(r, x);
        r.sadd(-1., 1., b);
        const double missing = wanted / norm(r);
        if (!(missing < 1) || iterations >= limit)
          break;
        dx = 0;
        preconditioner->vmult(dx, r);
        const double start = std::sqrt(std::abs(dx * r));
        dx                 = 0;
        dealii::SolverControl        control(limit - iterations,
                                      0.3 * std::max(missing, 1e-6) * start);
        dealii::SolverMinRes<Vector> minres(control);
        try
          {
            minres.solve(A, dx, r, *preconditioner);
          }
        catch (const dealii::SolverControl::NoConvergence &)
          {
            // How far it has come is seen below.
          }
        iterations += std::min(control.last_step(), limit - iterations);
        x += dx;
      }
    A.vmult(r, x);
    r.sadd(-1., 1., b);
    if (!(norm(r) <= wanted))
      throw dealii::SolverControl::NoConvergence(iterations, norm(r));
    return iterations;
  }

  template <typename Matrix>
  unsigned int
  LinearSolver::iterate(const Matrix      &A,
                        const bool         symmetric,
                        Vector            &x,
                        const Vector      &b,
                        const double       wanted,
                        const unsigned int limit) const
  {
    const KrylovMethod    method = parameters.method;
    dealii::SolverControl control(limit, wanted);
    if (method == KrylovMethod::gmres || !symmetric)
      {
        unsigned int done = 0;
        if (method != KrylovMethod::gmres)
          {
            FlexibleCG cg(control, n_directions);
            const bool has_converged = cg.solve(A, x, b, *preconditioner);
            done                     = control.last_step();
            if (has_converged)
              return done;
          }
        dealii::SolverControl left(limit - done, control.tolerance());
        // The flexible variant: a preconditioner in single precision is not
        // quite linear, and the plain one trusts that it is.
        using GMRES = dealii::SolverFGMRES<Vector>;
        GMRES gmres(left, GMRES::AdditionalData(basis_size(b)));
        return done + after(done, [&] {
                 gmres.solve(A, x, b, *preconditioner);
                 return left.last_step();
               });
      }
    if (method == KrylovMethod::minres)
      return minimal_residuals(A, limit, x, b, wanted);
    // Exact tangents may be indefinite, which the user's own choice of method
    // overrides.
    const bool is_watched = method != KrylovMethod::conjugate_gradients &&
                            std::is_same_v<Matrix, TangentOperator>;
    ConjugateGradients cg(control, is_watched);
    const bool         has_converged = cg.solve(A, x, b, *preconditioner);
    const unsigned int done          = control.last_step();
    if (has_converged)
      return done;
    return done + after(done, [&] {
             return minimal_residuals(A, limit - done, x, b, wanted);
           });
  }

  unsigned int
  LinearSolver::solve_with(const EffectiveOperator &A,
                           const TangentOperator   *J,
                           Vector                  &x,
                           const Vector            &b,
                           const double             wanted,
                           const unsigned int       limit) const
  {
    if (J != nullptr)
      return iterate(*J, J->is_symmetric(), x, b, wanted, limit);
    if (parameters.is_assembled)
      return iterate(A.matrix(), true, x, b, wanted, limit);
    return iterate(A, true, x, b, wanted, limit);
  }

  unsigned int
  LinearSolver::largest_number(const bool             is_new,
                               const TangentOperator *J) const
  {
    constexpr double many = 1000, least = 100;
    double           most = parameters.max_iterations;
    // Far from a solution exact tangents may be next to singular: Newton's
    // method has others.
    if (J != nullptr && J->is_exact())
      most = std::min(most, std::max(many / preconditioner->cost(), least));
    // Whether the preconditioner is outdated shows earlier.
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
    // For the operator that the preconditioner was made of it is as a new one.
    unsigned int most =
      largest_number(is_new || (J == nullptr && A.version() == built_version),
                     J);
    const auto change_it = [&](const double expected) {
      // If that throws, there is none.
      const bool was_built = std::exchange(is_built, false);
      const bool is_other =
        preconditioner->change(A, J, displacement, done, expected);
      is_built = was_built;
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
            // As if the residual went on falling as it did; it may not have
            // begun to.
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
    // What is larger than b says nothing: x has run away along a motion that
    // nothing resists.
    const double round_off = A.round_off(x);
    return norm(r) <= round_off && round_off < norm(b);
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
    try
      {
        iterations =
          solve_patiently(first_solve, A, J, x, b, displacement, wanted);
      }
    catch (const dealii::SolverControl::NoConvergence &failure)
      {
        if (is_round_off(A, J, x, b))
          return failure.last_step;
        is_built = false;
        if (!first_solve)
          // Perhaps only the preconditioner was outdated.
          return solve(A, x, b, displacement, J, limit, loosest);
        throw ComputationError(fmt::format(
          "the linear solver stopped after {} iterations at a relative "
          "residual of {:.3g}; required is {:.3g} within {} iterations",
          failure.last_step,
          failure.last_residual / b_norm,
          wanted / b_norm,
          parameters.max_iterations));
      }

    const bool was_built = first_solve || has_changed;
    // In terms of solves to the tolerance.
    const double digits =
      loosest > tolerance ? std::log(loosest) / std::log(tolerance) : 1.;
    const auto with_this =
      static_cast<unsigned int>((iterations - done_before_change) / digits);
    if (was_built)
      {
        first_iterations = with_this;
        more_iterations  = 0;
      }
    // For the operator that it was made of, another one would be the same.
    else if (with_this > first_iterations &&
             (J != nullptr || A.version() != built_version))
      more_iterations += with_this - first_iterations;
    unsigned int acceptable =
      preconditioner->acceptable_iterations(first_iterations);
    // A new preconditioner is not better than the first solve with it, as most
    // are made of the effective operator.
    if (J != nullptr)
      acceptable = std::max(acceptable, 3 * first_iterations / 2 + 3);
    is_built = with_this <= acceptable &&
               more_iterations <= preconditioner->build_cost() &&
               !preconditioner->is_worth_another(with_this);
    if (preconditioner->take_note(with_this, was_built))
      is_built = false;
    return iterations;
  }
} // namespace corotet
