// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_acceleration_solver_h
#define corotet_simulation_acceleration_solver_h

#include <corotet/operators/surface_matrix.h>
#include <corotet/simulation/equation_of_motion.h>
#include <corotet/solvers/mass_solver.h>

#include <limits>
#include <memory>

namespace corotet
{
  /**
   * Solves the equation of motion for the acceleration: at the start of a run
   * and in explicit steps. The argument of the constructor must outlive this
   * object. Members are collective.
   */
  class AccelerationSolver
  {
  public:
    explicit AccelerationSolver(EquationOfMotion &equation);

    /// The members of SecondOrderSystem with these names.
    StageReport
    solve_acceleration(State       &state,
                       const double time,
                       const double velocity_factor);
    bool
    step_many(State &state, const double dt, const unsigned int n);

    /// Whether step_many() is possible.
    bool
    can_step_many() const;

    /// Angular frequencies that bound an explicit step [rad/s], estimated from
    /// above by less than 0.1 percent.
    struct LargestFrequencies
    {
      /// The largest frequency of M^-1 K: K is the tangent at a state, with
      /// frozen rotations if the exact one is not symmetric, and the stiffness
      /// of force terms on the surface.
      double all;
      /// The one with only the stiffness that damping may be proportional to:
      /// that of the cells, with frozen rotations.
      double damped;
    };

    /// The frequencies at @p state and @p time. The second one is not estimated
    /// but equal to the first if no damping is proportional to the stiffness,
    /// or if both have the same stiffness. Collective.
    LargestFrequencies
    largest_frequencies(const State &state, const double time = 0);

    /// Gives back all memory until the next solve: implicit runs only need the
    /// first solve. Not collective.
    void
    release();

  private:
    /// solve_acceleration() with all entries of the velocity at one moment; the
    /// prescribed ones, too, get @p velocity_factor times a later on.
    StageReport
    solve(State &state, const double time, const double velocity_factor);
    /// Adds @p factor times @p a to the prescribed entries of @p v.
    void
    add_to_supports(Vector &v, const double factor, const Vector &a) const;
    const MassSolver &
    mass_solver();
    /// Solves with a lumped mass, without damping on the surface; @p c is the
    /// factor of the mass that damping by mass adds. Returns the forces.
    EquationOfMotion::Forces &
    solve_lumped(State       &state,
                 const double time,
                 const double velocity_factor,
                 const double c);
    /// The same with damping on the surface. Returns the number of iterations.
    unsigned int
    solve_lumped_with_surface_damping(State       &state,
                                      const double time,
                                      const double velocity_factor,
                                      const double c);
    /// @p factor times the matrix of damping on the surface.
    const SurfaceOperator<double> &
    surface_damping(const double time, const double factor);

    EquationOfMotion &equation;
    Body             &body;
    /// The solver is made when it is first needed; statics do not need it.
    std::unique_ptr<const MassSolver> the_mass_solver;

    std::unique_ptr<SurfaceMatrix>           surface;
    std::unique_ptr<SurfaceOperator<double>> damping_operator;
    double damping_time   = std::numeric_limits<double>::quiet_NaN();
    double damping_factor = std::numeric_limits<double>::quiet_NaN();

    /// Work space; empty until it is needed.
    Vector residual, acceleration, ghosted;
  };
} // namespace corotet

#endif
