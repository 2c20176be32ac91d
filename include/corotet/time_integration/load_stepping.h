// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_load_stepping_h
#define corotet_time_integration_load_stepping_h

#include <corotet/time_integration/time_integrator.h>

namespace corotet
{
  /**
   * Statics in load steps: f(u) = s g(t, u). In equal steps the load factor s
   * grows to 1 (proportional loading) and t to the end time. Velocities and
   * accelerations are zero.
   */
  class LoadStepping : public TimeIntegrator
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    StageReport
    step(SecondOrderSystem &system,
         const TimeStep    &step,
         State             &state) override;

    unsigned int
    order() const override
    {
      return 0;
    }

    bool
    is_dynamic() const override
    {
      return false;
    }

    double
    load_factor(const double done) const override
    {
      return proportional ? done : 1.;
    }

    double
    n_steps(const double, const double) const override
    {
      return load_steps;
    }

    unsigned int load_steps   = 1;
    bool         proportional = true;
  };
} // namespace corotet

#endif
