// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_structural_system_h
#define corotet_simulation_structural_system_h

#include <corotet/base/timing.h>
#include <corotet/discretization/prescribed_motion.h>
#include <corotet/operators/effective_operator.h>
#include <corotet/operators/elasticity.h>
#include <corotet/operators/force_terms.h>
#include <corotet/operators/mass.h>
#include <corotet/operators/tangent_operator.h>
#include <corotet/simulation/manufactured_problem.h>
#include <corotet/simulation/simulation_parameters.h>
#include <corotet/solvers/mass_solver.h>
#include <corotet/solvers/newton.h>
#include <corotet/time_integration/second_order_system.h>

#include <limits>
#include <memory>
#include <set>
#include <utility>

namespace corotet
{
  /**
   * The body's equation of motion M a + f_int(u) + f_d + f_e = f_ext as a
   * SecondOrderSystem [seed, 2.71 and 2.75], with the force terms of damping
   * f_d, the elastic ones f_e, and all others f_ext.
   *
   * Everything but the matrix is made by the constructor, which so checks all
   * input. The arguments must outlive this object.
   */
  class StructuralSystem : public SecondOrderSystem, private NewtonProblem
  {
  public:
    /// The terms of the equation of motion [N], complete on owned entries.
    struct Forces
    {
      Vector external;
      Vector internal;
      Vector damping;
      Vector inertia;
      /// Of the elastic terms that do not depend on time, as a resistance.
      /// Empty if there are none.
      Vector elastic;
    };

    /// Throws InputError. Collective.
    StructuralSystem(const Discretization &discretization,
                     SimulationParameters &parameters,
                     const TableFunctions &tables,
                     WallTimes            &wall_times,
                     Log                  &log);

    ~StructuralSystem() override;

    void
    initialize(State &state) const;

    void
    prescribe(State       &state,
              const double time,
              const double load_factor) override;

    /**
     * The first iteration of Newton's method in a load step, with the supports'
     * motion in its increment, from the equilibrium before: the body follows
     * them as its tangent there says. (Supports that move alone would crush the
     * cells at them, and may leave the body in another equilibrium.) Nothing
     * but prescribe() if they do not move or the material is linear.
     */
    StageReport
    move_supports(State       &state,
                  const double time,
                  const double load_factor) override;

    StageReport
    solve_stage(State &state, const Stage &stage) override;

    StageReport
    solve_acceleration(State       &state,
                       const double time,
                       const double velocity_factor = 0) override;

    /// The springs of all force terms at a time, as a matrix of the surface;
    /// null if they have no such matrix. The next call overwrites it.
    /// Collective.
    const SurfaceMatrix *
    springs(const double time)
    {
      return surface ? &surface_matrix(time, 1., 0.) : nullptr;
    }

    /// Whether step_many() is possible.
    bool
    can_step_many() const;

    bool
    step_many(State &state, const double dt, const unsigned int n) override;

    /// Evaluates all terms at a state, with the rotations of its displacement.
    /// Collective.
    const Forces &
    evaluate(const State &state, const double time, const double load_factor);

    /// Takes displacement, velocity and rotations from a state, no forces.
    /// Collective.
    void
    set_state(const State &state);

    /**
     * The terms of the last evaluation: after a step, those for which the
     * equation of motion holds (for linearly implicit steps, up to the error of
     * the linearization).
     */
    const Forces &
    last_forces() const
    {
      return forces;
    }

    /// When that was [s].
    double
    last_time() const
    {
      return forces_time;
    }

    /// What may be the reason that the forces of the last evaluation are not
    /// finite: cells without a stress, or nothing that is known. To be appended
    /// to an error. Collective.
    std::string
    why_not_finite() const;

    /// Estimate of the largest angular frequency of M^-1 K [rad/s], from above
    /// by less than 0.1 percent. K is the tangent at @p state, with frozen
    /// rotations if the exact one is not symmetric, and the stiffness that
    /// force terms have on the surface at @p time. Collective.
    double
    largest_frequency(const State &state, const double time = 0);

    /// Root mean square of a vector field over the body, weighted by mass.
    /// Collective.
    double
    root_mean_square(const Vector &field) const;

    /// Displacement and velocity of the last evaluation, or of the last
    /// set_state(), with ghost entries.
    const Vector &
    displacement() const
    {
      return u_ghosted;
    }

    const Vector &
    velocity() const
    {
      return v_ghosted;
    }

    /// Null if it is not known.
    const ExactSolution *
    exact_solution() const
    {
      return problem.solution();
    }

    const ReferenceElement &
    reference_element() const
    {
      return reference;
    }

    /// Cells where the derivative of a rotation was clamped, over all ranks,
    /// largest number since the last call.
    unsigned int
    take_clamped_cells()
    {
      return std::exchange(clamped_cells, 0u);
    }

    /// How often a preconditioner has been made.
    unsigned int
    preconditioner_builds() const
    {
      return parameters.linear_solver.preconditioner_builds();
    }

    const Elasticity &
    elasticity() const
    {
      return elastic;
    }

    const Mass &
    mass() const
    {
      return mass_matrix;
    }

    /// All forces but the internal one.
    ForceTerms &
    force_terms()
    {
      return terms;
    }

    const ForceTerms &
    force_terms() const
    {
      return terms;
    }

    const PrescribedMotion &
    prescribed_motion() const
    {
      return motion;
    }

  private:
    Norm
    residual(Vector &r) override;
    unsigned int
    solve_linearized(Vector &dx, const Vector &r) override;
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
    /// Solves J dx = r, or A dx = r if @p J is null. Returns the number of
    /// linear iterations. Throws ComputationError.
    unsigned int
    solve_tangent_system(Vector &dx, const Vector &r, const TangentOperator *J);
    /// Makes the matrix of the surface that of the stage. Returns whether it
    /// has changed.
    bool
    update_surface();
    /// What forces.elastic has in the residual.
    void
    subtract_elastic(Vector &r) const
    {
      if (terms.has_elastic())
        r -= forces.elastic;
    }
    /// @p factor times the matrix of damping on the surface.
    const SurfaceOperator<double> &
    surface_damping(const double time, const double factor);
    /// That of the terms, in the memory of the stage's.
    const SurfaceMatrix &
    surface_matrix(const double time, const double c_u, const double c_v);
    /// What round-off may make of the sum of the last evaluation's forces [N].
    double
    round_off() const;
    /// Says once that round-off has ended Newton's iterations.
    void
    report_round_off(const NewtonReport &report);
    /// Says once that a direct solver is faster, if @p n_iterations of a solve
    /// with p-multigrid and those of slow ones before tell so.
    void
    advise_direct_solver(const unsigned int n_iterations);
    /// Accelerations with a lumped mass, without damping on the surface; @p c
    /// is the part of damping by mass that is in the velocity to come.
    void
    solve_lumped_acceleration(State       &state,
                              const double time,
                              const double velocity_factor,
                              const double c);
    /// All terms but inertia.
    void
    evaluate_forces(const State &state,
                    const double time,
                    const double load_factor);
    /// That of the last evaluation, with the velocity if a force needs it.
    Motion
    last_motion() const
    {
      return {forces_time, u_ghosted, v_ghosted};
    }

    const Discretization &discretization;
    SimulationParameters &parameters;
    const TableFunctions &tables;
    WallTimes            &wall_times;
    Log                  &log;

    const ReferenceElement    reference;
    const ManufacturedProblem problem;
    const BoundaryConditions  conditions;
    const Mass                mass_matrix;
    Elasticity                elastic;
    ForceTerms                terms;
    const PrescribedMotion    motion;
    const MassSolver          mass_solver;
    const Tangent             wanted_tangent;
    Tangent                   tangent;

    std::unique_ptr<EffectiveOperator> effective_operator;
    std::unique_ptr<TangentOperator>   tangent_operator;

    /// What force terms have of a matrix of the surface, and for which stage;
    /// null if they have none.
    std::unique_ptr<SurfaceMatrix> surface;
    double surface_time   = std::numeric_limits<double>::quiet_NaN();
    double surface_factor = std::numeric_limits<double>::quiet_NaN();
    /// Work space of explicit steps with damping on the surface.
    std::unique_ptr<SurfaceOperator<double>> damping_operator;
    double damping_time   = std::numeric_limits<double>::quiet_NaN();
    double damping_factor = std::numeric_limits<double>::quiet_NaN();

    // The stage that is being solved.
    State *stage_state = nullptr;
    Stage  stage       = {};
    State  kept;
    /// Size of the forces [N]: of the last residual, of the last stage that was
    /// solved, and what residuals of the stage are compared with at least.
    double force_scale  = 0;
    double solved_scale = 0;
    double stage_scale  = 0;
    /// Which ends by round-off the log has shown.
    std::set<NewtonReport::RoundOff> shown_round_off;
    // Of the last update of the operator.
    double operator_c_K = -1;
    double operator_c_M = -1;

    unsigned int clamped_cells = 0;
    /// Of linear solves that were slow.
    unsigned int slow_iterations = 0;

    Forces forces;
    double forces_time = 0;
    /// Of the external forces that are known, and are needed again.
    double known_load_factor = std::numeric_limits<double>::quiet_NaN();
    double known_time        = std::numeric_limits<double>::quiet_NaN();
    Vector u_ghosted;
    Vector v_ghosted;
    Vector a_ghosted;
    Vector positions;
    double mass_diagonal_sum = 0;
    /// Work space of solve_acceleration().
    Vector free_residual, free_acceleration;
  };
} // namespace corotet

#endif
