// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_newmark_family_h
#define corotet_time_integration_newmark_family_h

#include <corotet/time_integration/time_integrator.h>

namespace corotet
{
  /**
   * The step that Newmark's method and its descendants share:
   *
   *   u_1 = u_0 + dt v_0 + dt^2 ((1/2 - beta) a_0 + beta a_1),
   *   v_1 = v_0 + dt ((1 - gamma) a_0 + gamma a_1),
   *   M a_m + C v_f + f(u_f) = g(t_f, u_f),
   *
   * with a_m = (1 - alpha_m) a_1 + alpha_m a_0 and the index f for
   * (1 - alpha_f) ()_1 + alpha_f ()_0. The unknown of the stage is u_f.
   *
   * The last equation is that of free unknowns, whose a_n is the acceleration
   * at t_n + (alpha_m - alpha_f) dt, so that a_m is that at t_f. Accelerations
   * that are prescribed belong to t_n itself: they enter M a_m as a_f.
   */
  class NewmarkFamily : public TimeIntegrator
  {
  public:
    void
    reset() override
    {
      stage.clear();
      end_acceleration.reinit(0);
    }

    StageReport
    step(SecondOrderSystem &system,
         const TimeStep    &step,
         State             &state) override;

    unsigned int
    order() const override;

    bool
    balances_at_end() const override;

    bool
    keeps_energy() const override;

    /// C in the local error C dt^2 |a_1 - a_0| of the displacement: a_n is the
    /// acceleration at t_n + (alpha_m - alpha_f) dt [Zienkiewicz and Xie, A
    /// simple error estimator and adaptive time stepping procedure for dynamic
    /// analysis, 1991, for alpha_m = alpha_f = 0].
    double
    error_constant() const override;

  protected:
    struct Coefficients
    {
      double beta;
      double gamma;
      double alpha_m;
      double alpha_f;
    };

    virtual Coefficients
    coefficients() const = 0;

  private:
    /// The state at the intermediate times.
    State stage;
    /// The accelerations at the end of the step: free ones of the guess, and
    /// prescribed ones.
    Vector end_acceleration;
  };
} // namespace corotet

#endif
