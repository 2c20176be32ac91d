// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/newmark_family.h>

#include <cmath>

namespace corotet
{
  unsigned int
  NewmarkFamily::order() const
  {
    const Coefficients c = coefficients();
    // The tolerance is for round-off in the coefficients.
    return std::abs(c.gamma - (0.5 - c.alpha_m + c.alpha_f)) <= 1e-12 ? 2 : 1;
  }

  bool
  NewmarkFamily::balances_at_end() const
  {
    const Coefficients c = coefficients();
    return c.alpha_m == 0 && c.alpha_f == 0;
  }

  bool
  NewmarkFamily::keeps_energy() const
  {
    // The trapezoidal rule: if the equation holds at the start and, with the
    // same weights for all terms, in between, it holds at the end.
    const Coefficients c = coefficients();
    return c.beta == 0.25 && c.gamma == 0.5 && c.alpha_m == c.alpha_f;
  }

  double
  NewmarkFamily::error_constant() const
  {
    const Coefficients c = coefficients();
    // A method of first order has a larger error than the one that is
    // estimated.
    constexpr double round_off = 1e-12;
    if (std::abs(c.gamma - (0.5 - c.alpha_m + c.alpha_f)) > round_off)
      return 0;
    // With conditionally stable methods steps would grow until waves become
    // unstable, and near beta = 1/6 the estimate vanishes.
    if (c.alpha_m == 0 && c.alpha_f == 0 && 2 * c.beta < c.gamma)
      return 0;
    return std::abs(1. / 6 - c.beta - 0.5 * (c.alpha_m - c.alpha_f));
  }

  StageReport
  NewmarkFamily::step(SecondOrderSystem &system,
                      const TimeStep    &step,
                      State             &state)
  {
    const auto [beta, gamma, alpha_m, alpha_f] = coefficients();

    const double dt = step.dt;

    // The guess is a_1 = a_0, with the u_1 and v_1 that follow from it.
    stage.u = state.u;
    stage.u.add(dt, state.v, 0.5 * dt * dt, state.a);
    stage.v = state.v;
    stage.v.add(dt, state.a);
    stage.a = state.a;
    system.prescribe(stage, step.end, 1.);
    end_acceleration = stage.a;

    // The guess moves from the end of the step to the intermediate times. Its
    // free accelerations do not change; prescribed ones, unlike a_n of the
    // method, belong to the time t_n, so they have to go to t_f.
    stage.u.sadd(1 - alpha_f, alpha_f, state.u);
    stage.v.sadd(1 - alpha_f, alpha_f, state.v);
    stage.a.sadd(1 - alpha_f, alpha_f, state.a);

    // The derivatives of v_f and a_m by u_f.
    const double      c_v = gamma / (beta * dt);
    const double      c_a = (1 - alpha_m) / ((1 - alpha_f) * beta * dt * dt);
    const StageReport report =
      system.solve_stage(stage,
                         {step.end - alpha_f * dt,
                          c_v,
                          c_a,
                          1.,
                          &state,
                          (1 - alpha_f) * 0.5 * dt * dt});

    // The results move back to the end of the step.
    const auto extrapolate = [&](Vector &end, const Vector &middle) {
      end.sadd(-alpha_f / (1 - alpha_f), 1 / (1 - alpha_f), middle);
    };
    extrapolate(state.u, stage.u);
    extrapolate(state.v, stage.v);
    // Free accelerations have changed by (a_m - a_0) / (1 - alpha_m),
    // prescribed ones not at all since the guess.
    state.a.sadd(-alpha_f / (1 - alpha_m), 1 / (1 - alpha_m), stage.a);
    state.a.add((alpha_f - alpha_m) / (1 - alpha_m), end_acceleration);
    return report;
  }
} // namespace corotet
