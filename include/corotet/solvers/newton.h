// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_newton_h
#define corotet_solvers_newton_h

#include <corotet/base/vector.h>

#include <deal.II/base/parameter_handler.h>

namespace corotet
{
  /**
   * A nonlinear system r(x) = 0 as Newton's method sees it. The problem holds
   * x itself.
   */
  class NewtonProblem
  {
  public:
    /// A norm and the size that it is compared with, in the same unit; and what
    /// round-off alone may make of it, below which it means nothing.
    struct Norm
    {
      double value;
      double scale;
      double round_off = 0;
    };

    virtual ~NewtonProblem() = default;

    /// Computes r(x) and the scale of the terms that it is the sum of.
    virtual Norm
    residual(Vector &r) = 0;

    /// Solves J dx = r with an approximation J of -dr/dx at the x of the last
    /// residual. Returns the number of linear iterations.
    virtual unsigned int
    solve_linearized(Vector &dx, const Vector &r) = 0;

    /// x += dx. The scale is the size of x.
    virtual Norm
    add(const Vector &dx) = 0;
  };

  struct NewtonReport
  {
    unsigned int iterations        = 0;
    unsigned int linear_iterations = 0;
  };

  /**
   * Newton's method (section Newton).
   *
   * It has converged when the residual is below its tolerance and the error
   * that is left in x is below that of the increment; or when the residual is
   * what round-off makes of it, as further increments are no better then.
   *
   * The error is estimated as theta / (1 - theta) |dx|, but at most |dx|, with
   * the last increment dx and the contraction theta of the residual in the last
   * iteration: the bound for linear convergence (Deuflhard, Newton methods for
   * nonlinear problems, 2004), which an approximate tangent has. So a linear
   * problem takes one iteration. A start with a thousandth of the tolerated
   * residual, or with round-off only, takes none.
   */
  class Newton
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm);

    /// Throws ComputationError if it does not converge or meets a number that
    /// is not finite. @p prototype: a vector like x. Collective.
    NewtonReport
    solve(NewtonProblem &problem, const Vector &prototype) const;

    double       residual_tolerance  = 1e-8;
    double       increment_tolerance = 1e-8;
    unsigned int max_iterations      = 50;

  private:
    mutable Vector r;
    mutable Vector dx;
  };
} // namespace corotet

#endif
