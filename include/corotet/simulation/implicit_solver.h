// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_implicit_solver_h
#define corotet_simulation_implicit_solver_h

#include <corotet/base/log.h>
#include <corotet/operators/effective_operator.h>
#include <corotet/operators/surface_matrix.h>
#include <corotet/operators/tangent_operator.h>
#include <corotet/simulation/equation_of_motion.h>
#include <corotet/simulation/part_residuals.h>
#include <corotet/solvers/linear_solver.h>
#include <corotet/solvers/newton.h>

#include <deal.II/lac/vector_memory.h>

#include <limits>
#include <memory>
#include <set>
#include <utility>

namespace corotet
{
  /**
   * Solves the equation of motion at the stages of implicit steps and of load
   * steps by Newton's method. The matrix is made at the first solve. The
   * arguments of the constructor must outlive this object. Members are
   * collective.
   */
  class ImplicitSolver : private NewtonProblem
  {
  public:
    /// Throws InputError if the linear solver is not fit for the equation.
    ImplicitSolver(EquationOfMotion             &equation,
                   const NewtonParameters       &newton_parameters,
                   const LinearSolverParameters &linear_solver_parameters,
                   Log                          &log);

    /// The members of SecondOrderSystem with these names.
    StageReport
    solve_stage(State &state, const Stage &stage);
    StageReport
    move_supports(State &state, const double time, const double load_factor);

    /// From now on solves ask @p question, and may throw StepInterrupted.
    void
    ask(const StopQuestion &question)
    {
      linear_solver.ask(question);
    }

    /// The largest number of cells, over all ranks, where a tangent clamped the
    /// derivative of the rotation since the last call.
    unsigned int
    take_clamped_cells()
    {
      return std::exchange(clamped_cells, 0u);
    }

    /// Transfers the data that later solves depend on: a preconditioner that is
    /// still in use is made again as it was. Leaves the equation with another
    /// state.
    void
    transfer(Archive &archive);

    /// How often a preconditioner has been made.
    unsigned int
    preconditioner_builds() const
    {
      return linear_solver.preconditioner_builds();
    }

    /// Warns, once, of statics that move the body many times its size, as wrong
    /// units do. Collective.
    void
    warn_of_far_motion();

  private:
    Norm
    residual(Vector &r) override;
    double
    unexplained_residual(const Vector &r) override;
    double
    residual_of_parts(const Vector &r) override;
    Norm
    improve_guess(Vector &r, const Norm &at_guess) override;
    unsigned int
    solve_linearized(Vector       &dx,
                     const Vector &r,
                     const double  tolerance) override;
    Norm
    add(const double factor, const Vector &dx) override;
    void
    keep() override;
    void
    restore() override;
    bool
    is_linear() const override;
    bool
    has_energy() const override;
    bool
    use_definite_tangent(const bool use) override;

    void
    make_operators();
    /// Takes the tangent at the last evaluation, for the stage. Returns its
    /// operator; null if it is the effective operator.
    const TangentOperator *
    linearize();
    /// Makes the effective operator that of the stage, with the rotations of
    /// the last evaluation.
    void
    update_effective_operator();
    /// Makes the preconditioner again.
    void
    restore_preconditioner();
    /// Makes the matrix of the surface that of the stage. Returns whether it
    /// has changed.
    bool
    update_surface();
    /// Solves J dx = r, or A dx = r if @p J is null. Returns the number of
    /// linear iterations. Throws ComputationError.
    unsigned int
    solve_tangent_system(Vector                &dx,
                         const Vector          &r,
                         const TangentOperator *J,
                         const double           tolerance = 0);
    /// The round-off in the sum of the last evaluation's forces [N]: a value
    /// that is certain, and an upper bound; zero if the body has run away.
    struct RoundOffOfForces
    {
      double sure, most;
    };
    RoundOffOfForces
    round_off();
    /// The largest extent of the body at rest [m]. Collective.
    double
    size_of_body() const;
    /// The largest displacement in statics over the body's size and that of the
    /// supports [-]; 0 in dynamics. Collective.
    double
    times_its_size() const;
    /// Logs, once, that round-off has ended Newton's iterations.
    void
    report_round_off(const NewtonReport &report);
    /// Warns, once, of a part whose equations could not be solved beside those
    /// of others.
    void
    report_parts(const NewtonReport &report);
    /// Logs what the linear solver has decided and, once, why solves are slow,
    /// if this one with @p n_iterations and those before it are.
    void
    report_linear_solver(const unsigned int n_iterations);

    EquationOfMotion      &equation;
    Body                  &body;
    const NewtonParameters parameters;
    Newton                 newton;
    LinearSolver           linear_solver;
    Log                   &log;
    Tangent                tangent;

    std::unique_ptr<EffectiveOperator> effective_operator;
    std::unique_ptr<TangentOperator>   tangent_operator;

    /// The matrix that force terms have on the surface, and the time and factor
    /// of the stage it was made for; null if they have none.
    std::unique_ptr<SurfaceMatrix> surface;
    double surface_time   = std::numeric_limits<double>::quiet_NaN();
    double surface_factor = std::numeric_limits<double>::quiet_NaN();

    // The stage that is being solved.
    State *stage_state = nullptr;
    Stage  stage       = {};
    /// The state of keep() while Newton's method runs, in vectors that the
    /// linear solver does not need meanwhile.
    struct KeptState
    {
      dealii::VectorMemory<Vector>::Pointer u, v, a;
    };
    dealii::GrowingVectorMemory<Vector> memory;
    KeptState                           kept;
    /// Sizes of the forces [N]: those of the last residual, that of the last
    /// stage that was solved, and the smallest scale for residuals of the
    /// stage.
    double force_scale    = 0;
    double residual_norm  = 0;
    double external_force = 0;
    double inertia_force  = 0;
    double solved_scale   = 0;
    double stage_scale    = 0;
    /// The round-off that the last residual may have [N].
    double force_noise = 0;
    /// Whether round-off of stiff parts of the body has hidden forces on
    /// others: then linear solves do not end at the round-off of the whole
    /// body.
    bool hides_parts = false;
    /// Null if there is one part only.
    std::unique_ptr<PartResiduals> parts;
    PartResiduals::Worst           worst_part;
    bool                           has_warned_of_parts = false;
    /// Whether nothing resists the loads: the displacement is so large that its
    /// round-off exceeds them, and is far out of reach.
    bool has_run_away = false;
    /// The kinds of ends by round-off that the log has shown.
    std::set<NewtonReport::RoundOff> shown_round_off;
    // The factors of stiffness and mass at the last update of the operator.
    double operator_c_K = -1;
    double operator_c_M = -1;

    /// The stage and the displacement that the preconditioner was made with;
    /// the displacement is empty if no matrix depends on it.
    Stage  built_stage = {};
    Vector built_displacement;
    /// The velocity; empty if no matrix depends on it.
    Vector built_velocity;
    /// Whether solves used the tangent operator then, and which tangent.
    bool    built_with_tangent = false;
    Tangent built_tangent      = Tangent::consistent;

    unsigned int clamped_cells = 0;
    /// The number of iterations of all slow linear solves.
    unsigned int slow_iterations          = 0;
    bool         has_warned_of_far_motion = false;
  };
} // namespace corotet

#endif
