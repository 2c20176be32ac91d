// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/solvers/newton.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  void
  Newton::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Residual tolerance",
                      residual_tolerance,
                      "Residual at which iterations stop, relative to the "
                      "largest of the internal, external, inertia and damping "
                      "forces [-].",
                      dealii::Patterns::Double(1e-15, 0.1));
    prm.add_parameter("Increment tolerance",
                      increment_tolerance,
                      "Estimated error of the displacement at which iterations "
                      "stop, relative to the displacement [-].",
                      dealii::Patterns::Double(1e-15, 0.1));
    prm.add_parameter("Maximum iterations",
                      max_iterations,
                      "A step that needs more has failed [-].",
                      dealii::Patterns::Integer(1));
  }

  NewtonReport
  Newton::solve(NewtonProblem &problem, const Vector &prototype) const
  {
    if (r.size() != prototype.size())
      {
        r.reinit(prototype);
        dx.reinit(prototype);
      }
    NewtonReport        report;
    NewtonProblem::Norm residual = problem.residual(r);
    double              error    = 0;
    double              size     = 0;

    const auto check_finite = [&] {
      if (!std::isfinite(residual.value) || !std::isfinite(residual.scale))
        throw ComputationError(
          fmt::format("the forces are not finite in Newton iteration {}",
                      report.iterations));
    };
    check_finite();
    const auto is_round_off = [&] {
      return residual.value <= residual.round_off;
    };
    if (is_round_off() ||
        residual.value <= 1e-3 * residual_tolerance * residual.scale)
      return report;

    while (report.iterations < max_iterations)
      {
        report.linear_iterations += problem.solve_linearized(dx, r);
        const NewtonProblem::Norm increment = problem.add(dx);
        const double              previous  = residual.value;
        residual                            = problem.residual(r);
        ++report.iterations;
        check_finite();

        const double theta = residual.value / previous;
        error = increment.value * (theta < 0.5 ? theta / (1 - theta) : 1.);
        size  = increment.scale;
        if (is_round_off() ||
            (residual.value <= residual_tolerance * residual.scale &&
             error <= increment_tolerance * size))
          return report;
      }
    throw ComputationError(fmt::format(
      "Newton's method did not converge in {} iterations: the residual is "
      "{:.3g} of the forces (required: {:.3g}), the estimated error {:.3g} of "
      "the displacement (required: {:.3g}); a smaller time step or more load "
      "steps may help",
      max_iterations,
      residual.value / residual.scale,
      residual_tolerance,
      error / size,
      increment_tolerance));
  }
} // namespace corotet
