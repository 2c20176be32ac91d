// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_linear_solver_h
#define corotet_solvers_linear_solver_h

#include <corotet/base/archive.h>
#include <corotet/base/selectable.h>
#include <corotet/operators/tangent_operator.h>
#include <corotet/solvers/preconditioner.h>
#include <corotet/solvers/stop_question.h>

#include <deal.II/lac/solver_control.h>

#include <limits>
#include <memory>
#include <string>

namespace corotet
{
  /// Krylov methods, as named by the entry Method.
  enum class KrylovMethod
  {
    automatic,
    conjugate_gradients,
    minres,
    gmres
  };

  /**
   * The parameters of section Linear solver. Must not be moved after
   * declare_parameters().
   */
  struct LinearSolverParameters
  {
    LinearSolverParameters();

    void
    declare_parameters(dealii::ParameterHandler &prm);

    Selectable<Preconditioner> preconditioner;
    KrylovMethod               method         = KrylovMethod::automatic;
    bool                       is_assembled   = false;
    double                     tolerance      = 1e-8;
    unsigned int               max_iterations = 10000;
  };

  /**
   * A Krylov method for the effective operator, or for an operator close to it,
   * with a preconditioner chosen at run time.
   *
   * Conjugate gradients solve with symmetric operators; if they meet a
   * direction of negative curvature, the operator is indefinite and MINRES goes
   * on from there (the preconditioner, made of the effective operator, is
   * always definite). Flexible conjugate gradients solve with operators that
   * are not symmetric; where they are slow GMRES goes on, which takes far more
   * memory.
   *
   * A preconditioner is made at the first solve, after the ratio of mass to
   * stiffness in the operator has changed by more than round-off, or the
   * surface's matrix by more than a factor of two, and when iterations exceed
   * the number that the preconditioner calls acceptable. Until then it takes
   * over new rotations only as far as that is cheap.
   */
  class LinearSolver
  {
  public:
    /// @p parameters must outlive this object. Residuals relative to the
    /// right-hand side must also be below @p largest_tolerance.
    explicit LinearSolver(
      const LinearSolverParameters &parameters,
      const double largest_tolerance = std::numeric_limits<double>::infinity());

    /// Throws InputError if the parameters are not fit for operators other than
    /// the effective one, which are @p symmetric or not.
    void
    check_fit(const bool symmetric) const;

    /**
     * Solves J x = b, or A x = b if J is null, from x = 0 until the residual is
     * below the tolerance, or @p loosest if that is larger, times |b|, and
     * below @p limit; or, if it gets no further, below the round-off of J x.
     * @p displacement is the current one of the nodes [m]. Returns the number
     * of iterations. Throws ComputationError if it does not get there. All
     * operators must be the same object, whose numbers may change, and live as
     * long as this one is used. Collective.
     */
    unsigned int
    solve(const EffectiveOperator &A,
          Vector                  &x,
          const Vector            &b,
          const Vector            &displacement,
          const TangentOperator   *J = nullptr,
          const double limit         = std::numeric_limits<double>::infinity(),
          const double loosest       = 0);

    /// From now on @p question is asked in iterations and before a
    /// preconditioner is made: then solve() may throw StepInterrupted.
    void
    ask(const StopQuestion &question)
    {
      stop_question = question;
    }

    /// Whether systems with the effective operator are those of its matrix.
    bool
    is_assembled() const
    {
      return parameters.is_assembled;
    }

    /// Lines for the log about the solution method, new since the last call.
    std::string
    take_news()
    {
      return preconditioner->take_news();
    }

    /// Transfers the data that later solves depend on, except for the
    /// preconditioner itself, which build_again() makes.
    void
    transfer(Archive &archive);

    /// Whether there is a preconditioner of an earlier solve that the next one
    /// may use.
    bool
    is_preconditioner_built() const
    {
      return is_built;
    }

    /// Makes the preconditioner again as it was made before a checkpoint; @p A,
    /// @p J and @p displacement must be those of that time.
    void
    build_again(const EffectiveOperator &A,
                const TangentOperator   *J,
                const Vector            &displacement);

    /// Name of the preconditioner, as the parameter has it.
    const std::string &
    type() const
    {
      return parameters.preconditioner.name();
    }

    /// The number of preconditioners that have been made.
    unsigned int
    preconditioner_builds() const
    {
      return n_builds;
    }

  private:
    /// The preconditioner as deal.II's methods see it; it asks the stop
    /// question from time to time.
    class AskingPreconditioner;

    /// Whether b - J x is only round-off.
    bool
    is_round_off(const EffectiveOperator &A,
                 const TangentOperator   *J,
                 const Vector            &x,
                 const Vector            &b) const;
    /// Number of iterations after which a solve has failed: smaller if the
    /// preconditioner was made of another operator, unless it @p is_new, and if
    /// @p J is an exact tangent.
    unsigned int
    largest_number(const bool is_new, const TangentOperator *J) const;
    /// Decides whether the next solve may use the same preconditioner, after a
    /// solve with J, or with A if that is null, for which it @p was_built.
    void
    take_note(const unsigned int       iterations,
              const bool               was_built,
              const EffectiveOperator &A,
              const TangentOperator   *J,
              const double             loosest);
    /// These go on from x to a residual of @p wanted and return the number of
    /// iterations. The first one lets the preconditioner change meanwhile;
    /// @p is_new says that it was made for this solve. The others throw
    /// dealii::SolverControl::NoConvergence after @p limit iterations.
    unsigned int
    solve_patiently(const bool               is_new,
                    const EffectiveOperator &A,
                    const TangentOperator   *J,
                    Vector                  &x,
                    const Vector            &b,
                    const Vector            &displacement,
                    const double             wanted);
    unsigned int
    solve_with(const EffectiveOperator &A,
               const TangentOperator   *J,
               Vector                  &x,
               const Vector            &b,
               const double             wanted,
               const unsigned int       limit) const;
    template <typename Matrix>
    unsigned int
    iterate(const Matrix      &A,
            const bool         symmetric,
            Vector            &x,
            const Vector      &b,
            const double       wanted,
            const unsigned int limit) const;
    template <typename Matrix>
    unsigned int
    minimal_residuals(const Matrix      &A,
                      const unsigned int limit,
                      Vector            &x,
                      const Vector      &b,
                      const double       wanted) const;

    const LinearSolverParameters         &parameters;
    const double                          tolerance;
    const std::unique_ptr<Preconditioner> preconditioner;
    StopQuestion                          stop_question;

    bool   is_built         = false;
    double built_mass_ratio = 0;
    double built_surface    = 0;
    /// Version of the operator that the preconditioner was made of.
    unsigned int built_version = 0;

    unsigned int n_builds = 0;
    /// Iterations of the present solve with a preconditioner that has been
    /// replaced meanwhile.
    unsigned int done_before_change = 0;
    /// Whether a preconditioner has been replaced, perhaps at the first
    /// iteration.
    bool has_changed = false;
    /// Version of the operator at the preconditioner's last build or update.
    unsigned int known_version = 0;
    /// Iterations of the first solve after the preconditioner was made.
    unsigned int first_iterations = 0;
    /// The sum of the iterations by which the solves since then exceeded that
    /// number.
    unsigned int more_iterations = 0;
  };
} // namespace corotet

#endif
