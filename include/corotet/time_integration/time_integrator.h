// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_time_integrator_h
#define corotet_time_integration_time_integrator_h

#include <corotet/time_integration/second_order_system.h>

#include <deal.II/base/parameter_handler.h>

namespace corotet
{
  /**
   * One step from time to time + dt.
   */
  struct TimeStep
  {
    double time;
    double dt;
    /// Part of the whole run that is done after this step, in (0, 1].
    double done;
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

    /// Number of equal steps for a run of @p duration when the parameters ask
    /// for the step @p dt (both in s).
    virtual unsigned int
    n_steps(const double duration, const double dt) const;
  };
} // namespace corotet

#endif
