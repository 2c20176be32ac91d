// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_time_integrator_h
#define corotet_time_integration_time_integrator_h

#include <corotet/time_integration/second_order_system.h>

#include <deal.II/base/parameter_handler.h>

#include <limits>

namespace corotet
{
  /**
   * One step from time to end.
   */
  struct TimeStep
  {
    /// Time at the start of the step, and its length [s].
    double time;
    double dt;
    /// Part of the whole run that is done after this step, in (0, 1].
    double done;
    /// Time at the end [s] as in the step's record: time + dt may have another
    /// last digit, and loads may jump there.
    double end = time + dt;
  };

  /**
   * How a method that is stable only for short steps chooses and checks them.
   */
  struct StabilityControl
  {
    /// Part of the stable step that is taken if the step is not given.
    double safety_factor = 0.9;
    /// Number of steps after which the stable step is estimated anew.
    unsigned int steps_between_estimates = 1000;
    /// Whether steps above the stable one are refused.
    bool refuse = true;
  };

  /**
   * A method that advances a SecondOrderSystem step by step.
   *
   * Beside its steps a method says what it is: its order, whether it is
   * explicit and so on, with the parameters that it has. The program relies on
   * that, and tests that loop over time_integrators() check it; nothing asks
   * for a name. The defaults are those of an implicit method that claims
   * nothing else.
   */
  class TimeIntegrator
  {
  public:
    virtual ~TimeIntegrator() = default;

    /// Declares its entries: the caller has entered the section of the
    /// method's name in section Time integration.
    virtual void
    declare_parameters(dealii::ParameterHandler & /*prm*/)
    {}

    /// Forgets all earlier steps. To be called before the first step of a run
    /// (not before a step that is tried again, from the same time): vectors
    /// that the method keeps must not be recognised as those of another run by
    /// their sizes or times.
    virtual void
    reset()
    {}

    /// Transfers what the method keeps from one step to the next beside the
    /// state, if it uses earlier steps: a run that is restarted goes on with
    /// it.
    virtual void
    transfer(Archive & /*archive*/)
    {}

    /// Advances @p state by one step; prescribed entries come out as the system
    /// has them at its end. Throws ComputationError. Collective.
    virtual StageReport
    step(SecondOrderSystem &system, const TimeStep &step, State &state) = 0;

    /// Advances @p state by @p n equal steps, of which @p first is the first.
    /// Throws ComputationError. Collective.
    virtual StageReport
    steps(SecondOrderSystem &system,
          const TimeStep    &first,
          const unsigned int n,
          State             &state);

    /// Order of convergence of displacement and velocity, in motion without
    /// stiffness-proportional damping; 0 in statics, where time is no more than
    /// a parameter.
    virtual unsigned int
    order() const = 0;

    /// Whether steps solve no equation but for the mass: they are many and
    /// cheap, are not halved if they fail, and several of them may be made at
    /// once.
    virtual bool
    is_explicit() const
    {
      return false;
    }

    /// Number of steps before the present one that a step uses beside the state
    /// at its start: 0 for one-step methods. As many steps at the start of a
    /// run are made otherwise.
    virtual unsigned int
    n_earlier_steps() const
    {
      return 0;
    }

    /// Whether the equation of motion holds for the state at the end of each
    /// step, so that reactions are those of that time.
    virtual bool
    balances_at_end() const
    {
      return false;
    }

    /// Whether the energy of linear bodies without loads and damping stays as
    /// it is, with the velocities of is_staggered().
    virtual bool
    keeps_energy() const
    {
      return false;
    }

    /// Whether the energy of linear bodies changes by just the work of loads,
    /// damping and supports that move: their budget closes to round-off.
    virtual bool
    closes_budget() const
    {
      return false;
    }

    /// Whether masses and velocities matter, so that the state needs an initial
    /// acceleration.
    virtual bool
    is_dynamic() const
    {
      return true;
    }

    /// Factor on loads and prescribed displacements when the part @p done of
    /// the run is done.
    virtual double
    load_factor(const double /*done*/) const
    {
      return 1;
    }

    /// Null if the method is stable for steps of any length, on linear
    /// problems. If not, a step of 0 in the parameters is the program's choice.
    virtual const StabilityControl *
    stability() const
    {
      return nullptr;
    }

    /// Longest stable step [s] for the largest angular frequency @p omega
    /// [rad/s] with stiffness-proportional damping @p alpha_K [s].
    virtual double
    stable_step(const double /*omega*/, const double /*alpha_K*/) const
    {
      return std::numeric_limits<double>::infinity();
    }

    /// Whether the kinetic energy that the method keeps is that of velocities
    /// half a step before and after.
    virtual bool
    is_staggered() const
    {
      return false;
    }

    /// C in the local error C dt^2 |a_1 - a_0| of the displacement; 0 if the
    /// method has no such estimate. Steps that follow their error are for
    /// methods that are not explicit.
    virtual double
    error_constant() const
    {
      return 0;
    }

    /// Number of equal steps for a run of @p duration when the parameters ask
    /// for the step @p dt (both in s): a whole number, as large as it may be.
    virtual double
    n_steps(const double duration, const double dt) const;
  };
} // namespace corotet

#endif
