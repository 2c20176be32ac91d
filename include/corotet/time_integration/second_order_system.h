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

    /// Makes them empty, of no nodes.
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
    /// At which the loads are taken [s].
    double time;
    /// c_v [1/s]; zero in statics.
    double velocity_factor;
    /// c_a [1/s^2]; zero in statics.
    double acceleration_factor;
    /// Multiplies loads and prescribed displacements: 1 but in load stepping.
    double load_factor = 1;
    /// The state that the guess goes on from, and what its acceleration is
    /// multiplied by in the guess of u [s^2]. Where loads have just begun to
    /// act it is that of the nodes that they act on, which neighbours soon hold
    /// back: the solver takes it back, or all of the motion, where forces are
    /// nearer to equilibrium so. Null: it takes the guess as it is.
    const State *start        = nullptr;
    double       guess_factor = 0;
  };

  /**
   * What a stage took.
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
   * What a time integrator may ask of the system M a + C v + f(u) = g(t, u)
   * whose unknowns are partly prescribed. All members are collective.
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
     * others may go along with them: @p state comes in as an equilibrium and
     * goes out as a guess of the next one. Returns what that took. Throws
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
     * and adds @p velocity_factor times a to v, both but for prescribed
     * entries, which come in with the v that goes out. Damping is that of the
     * v that comes in, of prescribed entries v - @p velocity_factor a; damping
     * that is proportional to the mass or on the surface is that of the v that
     * goes out. Throws ComputationError.
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
