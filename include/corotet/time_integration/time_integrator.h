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
    /// [s].
    double time;
    double dt;
    /// Part of the whole run that is done after this step, in (0, 1].
    double done;
    /// [s]. What the step's record says: time + dt may have another last digit,
    /// and loads may jump there.
    double end = time + dt;
  };

  /**
   * What a method that is stable for short steps only does about that.
   */
  struct StabilityControl
  {
    /// Part of the stable step that is taken if the step is not given.
    double safety_factor = 0.9;
    /// After so many steps the stable step is estimated anew.
    unsigned int steps_between_estimates = 1000;
    /// Whether steps above the stable one are refused.
    bool refuse = true;
  };

  /**
   * A method that advances a SecondOrderSystem step by step.
   */
  class TimeIntegrator
  {
  public:
    virtual ~TimeIntegrator() = default;

    virtual void
    declare_parameters(dealii::ParameterHandler & /*prm*/)
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
    /// problems.
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
    /// method has no such estimate.
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
