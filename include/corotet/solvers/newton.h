// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_newton_h
#define corotet_solvers_newton_h

#include <corotet/base/archive.h>
#include <corotet/base/negligible.h>
#include <corotet/base/vector.h>
#include <corotet/operators/tangent.h>
#include <corotet/solvers/newton_report.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  /**
   * A nonlinear system r(x) = 0 as Newton's method sees it. The problem holds
   * x itself.
   */
  class NewtonProblem
  {
  public:
    /// A norm, and the size that it is compared with, in the same unit; the
    /// part of it that round-off alone makes at the present x, below which it
    /// means nothing; and an upper bound of that part.
    struct Norm
    {
      double value;
      double scale;
      double round_off      = 0;
      double most_round_off = 0;

      bool
      is_finite() const
      {
        return std::isfinite(value) && std::isfinite(scale);
      }

      double
      relative() const
      {
        return value > 0 ? value / scale : 0.;
      }

      /// Whether the norm is at most that part of the scale, or negligible.
      bool
      is_below(const double tolerance) const
      {
        return value <= std::max(tolerance * scale, negligible);
      }
    };

    virtual ~NewtonProblem() = default;

    /// Computes r(x), and the scale of the terms that are summed in it.
    virtual Norm
    residual(Vector &r) = 0;

    /// The norm of those entries of @p r, the residual of the last evaluation,
    /// that are too large for round-off where they are, if each part of the
    /// body is looked at by itself. As a whole, r is round-off: its norm is no
    /// more than Norm::most_round_off.
    virtual double
    unexplained_residual(const Vector & /*r*/)
    {
      return 0;
    }

    /// The largest ratio of the residual @p r, that of the last evaluation, to
    /// the forces, if each part that is not connected with the others is looked
    /// at by itself, and round-off left out.
    virtual double
    residual_of_parts(const Vector & /*r*/)
    {
      return 0;
    }

    /// Called with the residual @p r and its norm @p at_guess at the guess of
    /// x: may go to another guess. Leaves the residual there in @p r and
    /// returns its norm.
    virtual Norm
    improve_guess(Vector & /*r*/, const Norm &at_guess)
    {
      return at_guess;
    }

    /// Solves J dx = r with an approximation J of -dr/dx at the x of the last
    /// residual. The residual of this solve may be @p tolerance times r, unless
    /// the problem's own tolerance is larger. Returns the number of linear
    /// iterations. Throws ComputationError.
    virtual unsigned int
    solve_linearized(Vector &dx, const Vector &r, const double tolerance) = 0;

    /// x += factor dx. Returns the norm of factor dx; its scale is the size of
    /// x, and its round-off that of x.
    virtual Norm
    add(const double factor, const Vector &dx) = 0;

    /// Whether r(x) is linear, with J its exact derivative.
    virtual bool
    is_linear() const
    {
      return false;
    }

    /// Keeps a copy of x.
    virtual void
    keep() = 0;

    /// Sets x to the copy.
    virtual void
    restore() = 0;

    /// Whether r is the negative gradient of an energy, so that the minimum
    /// along a direction is where r is orthogonal to it.
    virtual bool
    has_energy() const
    {
      return false;
    }

    /// Makes J positive definite from now on, or no longer, if there is a
    /// choice. Returns whether there is.
    virtual bool
    use_definite_tangent(const bool /*use*/)
    {
      return false;
    }
  };

  /**
   * The parameters of section Newton.
   */
  struct NewtonParameters
  {
    void
    declare_parameters(dealii::ParameterHandler &prm);

    double       residual_tolerance  = 1e-8;
    double       increment_tolerance = 1e-8;
    unsigned int max_iterations      = 50;
    Tangent      tangent             = Tangent::consistent;
    bool         linearly_implicit   = false;
    bool         always_log          = false;
  };

  /**
   * Newton's method.
   *
   * It has converged when the residual is below its tolerance and the error
   * that is left in x is below that of the increment (which adds no condition
   * where the problem is linear); or when the residual, or a full increment, is
   * only round-off, as further increments are no better then. Moreover each
   * part that is not connected with the others must have a residual of at most
   * a hundred times the tolerance in terms of its own forces; if iterations do
   * not achieve that, the report says so.
   *
   * The error is estimated as theta / (1 - theta) |dx|, but at most |dx|, with
   * the last increment dx and the contraction theta of the residual in the last
   * iteration: the bound for linear convergence (Deuflhard, Newton methods for
   * nonlinear problems, 2004), to be expected with an approximate tangent. So a
   * linear problem takes one iteration. No iteration is made if the start has a
   * thousandth of the tolerated residual, or round-off only.
   *
   * Full increments are taken although the residual grows: in bending it first
   * grows by orders of magnitude and is then gone within a few iterations,
   * where a monotone method would be very slow. When it has grown several times
   * without coming below its best value in between, has grown far (to 1e8 times
   * that value), or is not finite, the method returns to its best point and
   * searches along the increment from there (the watchdog technique of
   * Chamberlain, Powell, Lemarechal, Pedersen, 1982): for the zero of r . dx
   * where there is an energy (Matthies, Strang, The solution of nonlinear
   * finite element equations, 1979), else for a smaller |r|. If that fails, it
   * tries the direction of the definite tangent, in which the energy always
   * decreases.
   *
   * Linear solves are as accurate as needed: their residual is a small part of
   * what quadratic convergence will leave after as many iterations as the last
   * solve has needed (an inexact Newton method: Eisenstat, Walker 1996), at
   * most a hundredth. The last one is solved to the full tolerance.
   *
   * Where the linear solve of a first iteration has failed with the exact
   * tangent, the next solve begins with the definite one; the exact one is
   * tried again after one solve, two, four and so on.
   *
   * If it is linearly implicit, it makes only one iteration: the remaining
   * residual is an error of the time step.
   */
  class Newton
  {
  public:
    explicit Newton(const NewtonParameters &parameters)
      : parameters(parameters)
    {}

    /// Solves the problem. Throws ComputationError if it does not converge;
    /// also then @p report tells what was done. @p prototype is a vector like
    /// x. Collective.
    void
    solve(NewtonProblem &problem,
          const Vector  &prototype,
          NewtonReport  &report);

    /// Transfers the data that later solves depend on.
    void
    transfer(Archive &archive)
    {
      archive.transfer("n_last", n_last);
      archive.transfer("n_without_exact", n_without_exact);
      archive.transfer("last_pause", last_pause);
    }

  private:
    class Iteration;

    const NewtonParameters parameters;
    /// Iterations that the last solve needed; 0 before the first one, and after
    /// one that failed or searched along a direction.
    unsigned int n_last = 0;
    /// Number of solves that are to begin with the definite tangent, as linear
    /// solves with the exact one have failed in first iterations, and that
    /// number at the last failure.
    unsigned int n_without_exact = 0;
    unsigned int last_pause      = 0;
    // Work space.
    Vector r;
    Vector dx;
    Vector best_dx;
  };
} // namespace corotet

#endif
