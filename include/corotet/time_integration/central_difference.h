// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_central_difference_h
#define corotet_time_integration_central_difference_h

#include <corotet/time_integration/time_integrator.h>

namespace corotet
{
  /**
   * Explicit central difference method (leapfrog, velocity Verlet, Newmark with
   * beta = 0 and gamma = 1/2):
   *
   *   v_1/2 = v_0 + dt/2 a_0,  u_1 = u_0 + dt v_1/2,
   *   M a_1 + C v_1 + f(u_1) = g(t_1, u_1),  v_1 = v_1/2 + dt/2 a_1.
   *
   * Stiffness-proportional damping takes v_1/2 in place of v_1, which is of
   * first order. Otherwise second order. Stable for steps up to
   * stable_step().
   */
  class CentralDifference : public TimeIntegrator
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    StageReport
    step(SecondOrderSystem &system,
         const TimeStep    &step,
         State             &state) override;

    StageReport
    steps(SecondOrderSystem &system,
          const TimeStep    &first,
          const unsigned int n,
          State             &state) override;

    unsigned int
    order() const override
    {
      return 2;
    }

    bool
    is_explicit() const override
    {
      return true;
    }

    bool
    balances_at_end() const override
    {
      return true;
    }

    bool
    keeps_energy() const override
    {
      return true;
    }

    const StabilityControl *
    stability() const override
    {
      return &control;
    }

    double
    stable_step(const double omega, const double alpha_K) const override;

    bool
    is_staggered() const override
    {
      return true;
    }

    StabilityControl control;
  };
} // namespace corotet

#endif
