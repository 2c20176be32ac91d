// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_second_order_system_h
#define corotet_time_integration_second_order_system_h

#include <corotet/base/archive.h>

#include <limits>

namespace corotet
{
  /**
   * Displacement u [m], velocity v [m/s] and acceleration a [m/s^2] of all
   * nodes.
   */
  struct State
  {
    Vector u;
    Vector v;
    Vector a;

    void
    transfer(Archive &archive)
    {
      archive.transfer("displacement", u);
      archive.transfer("velocity", v);
      archive.transfer("acceleration", a);
    }

    /// Makes the vectors empty.
    void
    clear()
    {
      for (Vector *vector : {&u, &v, &a})
        vector->reinit(0);
    }
  };

  /**
   * The equation of one implicit stage: M a + C v + f(u) = g(t, u), to be
   * solved for increments that are coupled by du = dx, dv = c_v dx, da = c_a
   * dx.
   */
  struct Stage
  {
    /// Time at which the loads are taken [s].
    double time;
    /// c_v [1/s]; zero in statics.
    double velocity_factor;
    /// c_a [1/s^2]; zero in statics.
    double acceleration_factor;
    /// Factor of loads and prescribed displacements: 1 but in load stepping.
    double load_factor = 1;
    /// The state that the guess starts from, and the factor of its acceleration
    /// in the guess of u [s^2]. Where loads have just begun to act, only the
    /// loaded nodes have an acceleration, and their neighbours soon hold them
    /// back: the solver removes that from the guess, or all of the motion, if
    /// forces are nearer to equilibrium then. Null: the solver takes the guess
    /// as it is.
    const State *start        = nullptr;
    double       guess_factor = 0;
  };

  /**
   * The effort of solving a stage.
   */
  struct StageReport
  {
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;
    /// Observed order of convergence of Newton's method; NaN if it took too few
    /// iterations to tell.
    double order = std::numeric_limits<double>::quiet_NaN();
  };

  /**
   * The system M a + C v + f(u) = g(t, u), with unknowns that are partly
   * prescribed, as time integrators use it. All members are collective.
   */
  class SecondOrderSystem
  {
  public:
    virtual ~SecondOrderSystem() = default;

    /// Sets the prescribed entries of @p state to their values, velocities and
    /// accelerations at @p time, times @p load_factor.
    virtual void
    prescribe(State &state, const double time, const double load_factor) = 0;

    /**
     * Sets the prescribed entries as prescribe() does, in statics, where the
     * other entries may follow them: @p state comes in as an equilibrium and
     * goes out as a guess of the next one. Returns the effort. Throws
     * ComputationError.
     */
    virtual StageReport
    move_supports(State &state, const double time, const double load_factor)
    {
      prescribe(state, time, load_factor);
      return {};
    }

    /**
     * Solves the equation of @p stage. @p state comes in as a guess that
     * satisfies the coupling and the prescribed values, and goes out as the
     * solution; prescribed entries do not change. Throws ComputationError.
     */
    virtual StageReport
    solve_stage(State &state, const Stage &stage) = 0;

    /**
     * Sets a of @p state such that the equation holds at @p time with its u,
     * and adds @p velocity_factor times a to v. Prescribed entries do not
     * change; their v is that at the end. Damping takes the v before this
     * addition, for prescribed entries v - @p velocity_factor a; damping that
     * is proportional to the mass or on the surface takes the v after it.
     * Throws ComputationError.
     */
    virtual StageReport
    solve_acceleration(State       &state,
                       const double time,
                       const double velocity_factor = 0) = 0;

    /**
     * Makes @p n steps of v += dt M^{-1} (g - f(u)), u += dt v, for v half a
     * step before u, if nothing depends on time or velocity: loads, supports,
     * damping. Returns whether it is so; if not, nothing has changed.
     */
    virtual bool
    step_many(State & /*state*/, const double /*dt*/, const unsigned int /*n*/)
    {
      return false;
    }
  };
} // namespace corotet

#endif
