// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/newmark_family.h>

namespace corotet
{
  StageReport
  NewmarkFamily::step(SecondOrderSystem  &system,
                      const TimeStep     &step,
                      const Coefficients &coefficients,
                      State              &state)
  {
    const auto &[beta, gamma, alpha_m, alpha_f] = coefficients;

    const double dt = step.dt;
    if (stage.u.size() != state.u.size())
      stage = state;

    // Guess: a_1 = a_0, and what follows for u_1 and v_1.
    stage.u = state.u;
    stage.u.add(dt, state.v, 0.5 * dt * dt, state.a);
    stage.v = state.v;
    stage.v.add(dt, state.a);
    stage.a = state.a;
    system.prescribe(stage, step.time + dt, 1.);

    // From the end of the step to the intermediate times.
    stage.u.sadd(1 - alpha_f, alpha_f, state.u);
    stage.v.sadd(1 - alpha_f, alpha_f, state.v);
    stage.a.sadd(1 - alpha_m, alpha_m, state.a);

    // How v_f and a_m change with u_f.
    const double      c_v = gamma / (beta * dt);
    const double      c_a = (1 - alpha_m) / ((1 - alpha_f) * beta * dt * dt);
    const StageReport report =
      system.solve_stage(stage, {step.time + (1 - alpha_f) * dt, c_v, c_a});

    // And back to the end of the step.
    const auto extrapolate =
      [](Vector &end, const Vector &middle, const double alpha) {
        end.sadd(-alpha / (1 - alpha), 1 / (1 - alpha), middle);
      };
    extrapolate(state.u, stage.u, alpha_f);
    extrapolate(state.v, stage.v, alpha_f);
    extrapolate(state.a, stage.a, alpha_m);
    return report;
  }
} // namespace corotet
