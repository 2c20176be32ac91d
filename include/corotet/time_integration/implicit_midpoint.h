// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_implicit_midpoint_h
#define corotet_time_integration_implicit_midpoint_h

#include <corotet/time_integration/time_integrator.h>

namespace corotet
{
  /**
   * Implicit midpoint rule: u_1 - u_0 = dt v_m, v_1 - v_0 = dt a_m and the
   * equation of motion for a_m at the middle of the step, with u_m = (u_0 +
   * u_1) / 2 and v_m = (v_0 + v_1) / 2. Second order; unconditionally stable
   * for linear problems, whose energy it keeps; symplectic for nonlinear ones,
   * and it keeps angular momentum. The acceleration of the state is a_m.
   */
  class ImplicitMidpoint : public TimeIntegrator
  {
  public:
    void
    reset() override
    {
      middle.clear();
    }

    StageReport
    step(SecondOrderSystem &system,
         const TimeStep    &step,
         State             &state) override;

    unsigned int
    order() const override
    {
      return 2;
    }

    bool
    keeps_energy() const override
    {
      return true;
    }

    bool
    closes_budget() const override
    {
      return true;
    }

  private:
    /// The state at the middle of the step.
    State middle;
  };
} // namespace corotet

#endif
