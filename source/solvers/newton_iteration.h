// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_newton_iteration_h
#define corotet_solvers_newton_iteration_h

#include <corotet/solvers/newton.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The state of one solve by Newton's method.
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

    /// Solves the problem. Throws ComputationError.
    void
    run();

  private:
    /// Limit of full increments that raise the residual, before a line search.
    static constexpr unsigned int patience = 5;
    /// Limit of solves that begin with the definite tangent after failures.
    static constexpr unsigned int longest_pause = 16;
    /// Limit of trials of a line search: the last are some 1e-4 of the
    /// increment.
    static constexpr unsigned int max_trials = 10;
    /// A residual may be round-off if a full increment leaves at least this
    /// part of it, or after this many iterations.
    static constexpr double       stalled = 0.5;
    static constexpr unsigned int many    = 5;
    /// The part of the first increment that is a small error.
    static constexpr double small_error = 1e-6;
    /// Residuals of single parts may be larger by this factor.
    static constexpr double of_parts_over_whole = 100;
    /// Limit of iterations that do not halve the residual of a part, and of
    /// those in which increments count instead of residuals.
    static constexpr unsigned int most_in_vain = 3, most_slow = 3;
    /// The ratio of a residual to the best one that counts as divergence.
    static constexpr double divergence = 1e8;

    /// Computes the residual and its norm.
    void
    evaluate()
    {
      residual = problem.residual(r);
      unexplained.reset();
      of_parts.reset();
    }

    /// Whether the residual is no larger than round-off may be in the whole
    /// body. The upper bound of that counts if a full increment has not reduced
    /// the residual, or after many iterations.
    bool
    is_within_round_off() const;

    /// Whether iterations have nothing left to gain: the residual is round-off
    /// in all parts of the body, or what is not has converged. Where it may be
    /// round-off of stiff parts, which hides the forces of soft ones,
    /// increments may tell, too (have_settled()).
    bool
    is_round_off();

    /// Whether increments do not become smaller any more, after many
    /// iterations, or what they leave is small against the first one: at the
    /// rate of the last two, du_k and du_k-1, this is du_k q / (1 - q) with q =
    /// du_k / du_k-1.
    bool
    have_settled() const;

    /// Whether the estimated error of x is small enough. Linear problems have
    /// no estimate of their own.
    bool
    has_small_error() const
    {
      return problem.is_linear() ||
             error <= parameters.increment_tolerance * size;
    }

    bool
    has_small_residual() const
    {
      return residual.is_below(parameters.residual_tolerance);
    }

    /// Whether the body as a whole has converged.
    bool
    has_converged();

    /// Whether each part that is not connected with the others has converged,
    /// too, or further iterations hardly reduce its residual. To be asked once
    /// where the whole has converged.
    bool
    have_parts_converged();

    /// The contraction of the residual in the last iteration, or 1 if the last
    /// increment shows that it does not tell the error.
    double
    contraction(const double previous, const double increment);

    NewtonReport::RoundOff
    round_off_limit();

    [[noreturn]] void
    fail(const std::string &what) const;

    /// The residual that a linear solve may leave, relative to r: a small part
    /// of what quadratic convergence leaves after the iteration. That doubles
    /// the digits in each iteration, and the last solve tells the number of
    /// iterations to expect. The last one is solved fully. From the fifth on
    /// all digits are reached; more than eight iterations are no quadratic
    /// convergence.
    double
    linear_tolerance() const;

    /// Finds a direction from the present point, with the definite tangent if
    /// the exact one fails.
    void
    find_direction();

    bool
    use_definite_tangent();

    void
    iterate();

    /// The same, but returns false, at the best state, if it fails where the
    /// whole has converged and some part has not.
    bool
    try_to_iterate();

    void
    search_from_best(const bool dx_is_known);

    /// Moves x along dx; returns the part of dx that it took, or zero. Forces
    /// that are not finite mean that x is too far.
    double
    line_search(const double value, const double slope);

    void
    record(const NewtonProblem::Norm &increment, const double length);

    /// Throws if the residual has been falling far too slowly.
    void
    check_progress() const;

    Newton                 &newton;
    const NewtonParameters &parameters;
    NewtonProblem          &problem;
    NewtonReport           &report;
    Vector                 &r;
    Vector                 &dx;
    Vector                 &best_dx;

    NewtonProblem::Norm residual = {};
    /// What round-off does not explain of the residual, as far as that was
    /// asked.
    std::optional<double> unexplained;
    /// The residual of the worst part, as far as that was asked, and the
    /// smallest one that iterations have halved.
    std::optional<double> of_parts;
    double       best_of_parts  = std::numeric_limits<double>::infinity();
    unsigned int n_in_vain      = 0;
    bool         whole_is_ready = false;
    /// The number of increments that did not become smaller.
    unsigned int n_slow = 0;
    /// Whether there is no direction from a residual within round-off.
    bool cannot_improve = false;
    /// Norms of the first increment, the last one, and the one before it.
    double first_increment = 0, last_increment = 0, increment_before = 0;
    double error    = std::numeric_limits<double>::infinity();
    double size     = 1;
    bool   definite = false;
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
} // namespace corotet

#endif
