// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/solvers/linear_solver.h>
#include <corotet/solvers/preconditioners.h>

#include <deal.II/lac/solver_cg.h>

#include <fmt/format.h>

#include <cmath>

namespace corotet
{
  LinearSolver::LinearSolver()
    : preconditioner(preconditioners(), "amg")
  {}

  void
  LinearSolver::declare_parameters(dealii::ParameterHandler &prm)
  {
    preconditioner.declare_parameters(
      prm,
      "Preconditioner of conjugate gradients: 'amg', smoothed aggregation with "
      "rigid body modes; 'jacobi', the diagonal; 'direct', a sparse "
      "factorisation.");
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

    dealii::SolverControl    control(max_iterations, tolerance * b_norm);
    dealii::SolverCG<Vector> cg(control);
    try
      {
        cg.solve(A, x, b, preconditioner.selected());
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
