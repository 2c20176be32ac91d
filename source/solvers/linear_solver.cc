// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/solvers/linear_solver.h>
#include <corotet/solvers/preconditioners.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <fmt/format.h>

#include <cmath>

namespace corotet
{
  LinearSolver::LinearSolver()
    : preconditioner(preconditioners(), "p-multigrid")
  {}

  void
  LinearSolver::declare_parameters(dealii::ParameterHandler &prm)
  {
    preconditioner.declare_parameters(
      prm,
      "Preconditioner: 'p-multigrid', over the degrees "
      "down to 1, matrix-free; 'amg', smoothed aggregation with rigid body "
      "modes, on the assembled matrix; 'jacobi', the diagonal; 'direct', a "
      "sparse factorisation of the assembled matrix.");
    prm.add_parameter("Method",
                      method,
                      "Krylov method. GMRES (flexible, restarted after 30 "
                      "iterations) also solves systems that are not "
                      "symmetric.",
                      dealii::Patterns::Selection("conjugate gradients|gmres"));
    prm.add_parameter("Operator",
                      operator_type,
                      "How the matrix is applied: cell by cell without "
                      "storing it, or assembled.",
                      dealii::Patterns::Selection("matrix-free|assembled"));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Residual at which iterations stop, relative to the "
                      "right hand side [-].",
                      dealii::Patterns::Double(1e-15, 0.1));
    prm.add_parameter("Maximum iterations",
                      max_iterations,
                      "A solve that needs more has failed [-].",
                      dealii::Patterns::Integer(1));
  }

  template <typename Matrix>
  void
  LinearSolver::iterate(dealii::SolverControl &control,
                        const Matrix          &A,
                        Vector                &x,
                        const Vector          &b) const
  {
    if (method == "conjugate gradients")
      {
        dealii::SolverCG<Vector> cg(control);
        cg.solve(A, x, b, preconditioner.selected());
        return;
      }
    // The flexible variant: a preconditioner in single precision is not quite
    // linear, and the plain one trusts that it is.
    dealii::SolverFGMRES<Vector> gmres(control);
    gmres.solve(A, x, b, preconditioner.selected());
  }

  unsigned int
  LinearSolver::solve(const EffectiveOperator &A,
                      Vector                  &x,
                      const Vector            &b,
                      const Vector            &positions)
  {
    const double b_norm = norm(b);
    x                   = 0;
    if (b_norm == 0)
      return 0;
    if (A.mass_ratio() != built_mass_ratio)
      is_built = false;
    const bool first_solve = !is_built;
    if (first_solve)
      {
        preconditioner.selected().build(A, positions);
        built_mass_ratio = A.mass_ratio();
      }
    else if (A.version() != known_version)
      preconditioner.selected().update(A);
    known_version = A.version();

    dealii::SolverControl control(max_iterations, tolerance * b_norm);
    try
      {
        if (operator_type == "matrix-free")
          iterate(control, A, x, b);
        else
          iterate(control, A.matrix(), x, b);
      }
    catch (const dealii::SolverControl::NoConvergence &failure)
      {
        is_built = false;
        if (!first_solve)
          // Perhaps only the preconditioner was outdated.
          return solve(A, x, b, positions);
        throw ComputationError(fmt::format(
          "the linear solver stopped after {} iterations at a relative "
          "residual of {:.3g}; required is {:.3g} within {} iterations",
          failure.last_step,
          failure.last_residual / b_norm,
          tolerance,
          max_iterations));
      }

    const unsigned int iterations = control.last_step();
    if (first_solve)
      first_iterations = iterations;
    is_built = iterations <= preconditioner.selected().acceptable_iterations(
                               first_iterations);
    return iterations;
  }

  void
  LinearSolver::clear()
  {
    preconditioner.selected().clear();
    is_built = false;
  }
} // namespace corotet
