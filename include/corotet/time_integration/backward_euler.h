// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_backward_euler_h
#define corotet_time_integration_backward_euler_h

#include <corotet/time_integration/time_integrator.h>

namespace corotet
{
  /**
   * Backward Euler: v_1 = (u_1 - u_0) / dt, a_1 = (v_1 - v_0) / dt, and the
   * equation of motion at the end of the step. First order; unconditionally
   * stable; damps all motion that the step does not resolve, strongly.
   */
  class BackwardEuler : public TimeIntegrator
  {
  public:
    StageReport
    step(SecondOrderSystem &system,
         const TimeStep    &step,
         State             &state) override;

    unsigned int
    order() const override
    {
      return 1;
    }

    bool
    balances_at_end() const override
    {
      return true;
    }
  };
} // namespace corotet

#endif
