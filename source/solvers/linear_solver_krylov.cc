// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The Krylov methods of LinearSolver, which ask the stop question from time to
// time.

#include <corotet/base/exceptions.h>
#include <corotet/solvers/conjugate_gradients.h>
#include <corotet/solvers/flexible_cg.h>
#include <corotet/solvers/linear_solver.h>

#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/solver_minres.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace corotet
{
  namespace
  {
    // Number of directions that flexible conjugate gradients keep. On bent
    // bodies more do not save iterations, as long as the solver is not slow.
    constexpr unsigned int n_directions = 2;

    // Iterations between two questions, where each takes an additional sum over
    // the ranks.
    constexpr unsigned int iterations_unasked = 8;

    // Number of iterations after which GMRES restarts; it stores two vectors
    // for each. With few of them it stagnates on ill-conditioned systems.
    unsigned int
    basis_size(const Vector &b)
    {
      constexpr double few = 30, many = 200, memory = 64 << 20;
      return static_cast<unsigned int>(
        std::clamp(memory / (2 * sizeof(double) * b.size()), few, many));
    }

    // The iterations of @p solve; if it does not converge, the exception counts
    // those that were @p done before, too.
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

  // The preconditioner as methods of deal.II use it.
  class LinearSolver::AskingPreconditioner
  {
  public:
    explicit AskingPreconditioner(const LinearSolver &solver)
      : solver(solver)
    {}

    void
    vmult(Vector &dst, const Vector &src) const
    {
      if (n_applications++ % iterations_unasked == 0)
        solver.stop_question.ask(src.get_mpi_communicator());
      solver.preconditioner->vmult(dst, src);
    }

  private:
    const LinearSolver  &solver;
    mutable unsigned int n_applications = 0;
  };

  template <typename Matrix>
  unsigned int
  LinearSolver::minimal_residuals(const Matrix      &A,
                                  const unsigned int limit,
                                  Vector            &x,
                                  const Vector      &b,
                                  const double       wanted) const
  {
    // MINRES measures residuals in the norm of the preconditioner, and single
    // precision makes that inaccurate: it restarts from the true residual until
    // that is small.
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
            minres.solve(A, dx, r, AskingPreconditioner(*this));
          }
        // NOLINTNEXTLINE(bugprone-empty-catch): how far it is, is seen below.
        catch (const dealii::SolverControl::NoConvergence &)
          {}
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
            FlexibleCG cg(control, stop_question, n_directions);
            const bool has_converged = cg.solve(A, x, b, *preconditioner);
            done                     = control.last_step();
            if (has_converged)
              return done;
          }
        dealii::SolverControl left(limit - done, control.tolerance());
        // The flexible variant is needed, as a preconditioner in single
        // precision is not quite linear.
        using GMRES = dealii::SolverFGMRES<Vector>;
        GMRES gmres(left, GMRES::AdditionalData(basis_size(b)));
        return done + after(done, [&] {
                 gmres.solve(A, x, b, AskingPreconditioner(*this));
                 return left.last_step();
               });
      }
    if (method == KrylovMethod::minres)
      return minimal_residuals(A, limit, x, b, wanted);
    // Exact tangents may be indefinite. If the user has chosen conjugate
    // gradients, that is ignored.
    const bool is_watched = method != KrylovMethod::conjugate_gradients &&
                            std::is_same_v<Matrix, TangentOperator>;
    ConjugateGradients cg(control, stop_question, is_watched);
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
} // namespace corotet
