// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_equation_of_motion_h
#define corotet_simulation_equation_of_motion_h

#include <corotet/base/timing.h>
#include <corotet/operators/force_terms.h>
#include <corotet/simulation/body.h>
#include <corotet/time_integration/second_order_system.h>

#include <limits>
#include <string>

namespace corotet
{
  /**
   * The terms of a body's equation of motion
   *
   *   M a + f_int(u) + f_d + f_e = f_ext
   *
   * at a state [seed, 2.71 and 2.75], with the force terms of damping f_d, the
   * elastic ones f_e, and all others f_ext. The arguments of the constructor
   * must outlive this object. Members are collective.
   */
  class EquationOfMotion
  {
  public:
    /// The terms [N], complete on owned entries.
    struct Forces
    {
      Vector external;
      Vector internal;
      /// Empty if there is no damping term.
      Vector damping;
      /// Empty in statics.
      Vector inertia;
      /// Forces of the elastic terms that do not depend on time, as a
      /// resistance. Empty if there are none.
      Vector elastic;
    };

    /// Throws InputError.
    EquationOfMotion(Body                       &body,
                     const SimulationParameters &parameters,
                     WallTimes                  &wall_times,
                     Log                        &log);

    /// Evaluates all terms at a state, with the rotations of its displacement.
    /// A caller who solves for an acceleration completes inertia and damping.
    Forces &
    evaluate(const State &state, const double time, const double load_factor);

    /// Evaluates all terms but inertia.
    Forces &
    evaluate_forces(const State &state,
                    const double time,
                    const double load_factor);

    /// Sets the inertia of the forces to M @p acceleration.
    void
    evaluate_inertia(const Vector &acceleration);

    /// r = f_ext - f_int - f_d - f_e - M a of the last evaluation, zero where
    /// the displacement is prescribed.
    void
    residual(Vector &r) const;

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

    /// Displacement and velocity of the last evaluation, or of the last
    /// set_state(), with ghost entries; the velocity, after an evaluation, if a
    /// force needs it. In statics it is zero, and empty if none does.
    Motion
    motion(const double time) const
    {
      return {time, u, v};
    }

    /// The motion at the time of the last evaluation.
    Motion
    last_motion() const
    {
      return motion(time);
    }

    double
    last_time() const
    {
      return time;
    }

    /// The factor of loads in the last evaluation [-].
    double
    last_load_factor() const
    {
      return known_load_factor;
    }

    /// Whether the external forces of the last evaluation are the same at any
    /// time, with a load factor of 1.
    bool
    has_constant_loads() const
    {
      return terms.is_constant() && known_load_factor == 1;
    }

    /// Takes displacement, velocity and rotations from a state, but no forces.
    void
    set_state(const State &state);

    /// Displacement of the last evaluation, or of the last set_state(), with
    /// ghost entries.
    const Vector &
    displacement() const
    {
      return u;
    }

    /// The velocity, like displacement(). The first call is collective.
    const Vector &
    velocity() const
    {
      if (v.size() == 0)
        body.discretization.initialize_vector(v);
      return v;
    }

    /// Whether the equation is linear in the motion.
    bool
    is_linear() const
    {
      return body.law->is_linear() && terms.is_linear();
    }

    /// Whether the forces are the gradient of an energy.
    bool
    has_energy() const
    {
      return body.elasticity.is_symmetric(Tangent::consistent) &&
             terms.has_potential();
    }

    /// A possible reason that the forces of the last evaluation are not finite:
    /// a formula that is not finite, or cells without a stress; empty if no
    /// reason is known. To be appended to an error message. Collective.
    std::string
    why_not_finite() const;

    Body      &body;
    WallTimes &wall_times;
    /// Whether anything moves in time: not in statics, where velocity and
    /// acceleration are zero.
    const bool is_dynamic;
    /// All forces but the internal ones.
    ForceTerms terms;

  private:
    Forces forces;
    double time = 0;
    /// Load factor and time of the external forces that are stored for later
    /// use.
    double known_load_factor = std::numeric_limits<double>::quiet_NaN();
    double known_time        = std::numeric_limits<double>::quiet_NaN();
    Vector u;
    /// Empty in statics before it is needed.
    mutable Vector v;
    Vector         a;
  };
} // namespace corotet

#endif
