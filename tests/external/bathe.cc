// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "bathe.h"

void
Bathe::reset()
{
  middle.clear();
  end.clear();
}

corotet::StageReport
Bathe::step(corotet::SecondOrderSystem &system,
            const corotet::TimeStep    &step,
            corotet::State             &state)
{
  const double dt = step.dt, h = 0.5 * dt;

  // Each stage starts from a guess, here with constant acceleration, that
  // satisfies the formulas of the stage. Those of the trapezoidal rule are:
  //   v_1 = 2 (u_1 - u_0) / h - v_0,  a_1 = 2 (v_1 - v_0) / h - a_0.
  middle.u = state.u;
  middle.u.add(h, state.v, 0.5 * h * h, state.a);
  middle.v = state.v;
  middle.v.add(h, state.a);
  middle.a = state.a;
  system.prescribe(middle, step.time + h, 1.);
  // Given are the derivatives of v_1 and a_1 by u_1, and the state that the
  // guess starts from with its factor of the acceleration: the solver leaves
  // out the acceleration where that is better.
  const corotet::StageReport first = system.solve_stage(
    middle, {step.time + h, 2 / h, 4 / (h * h), 1., &state, 0.5 * h * h});

  // v_2 = (u_0 - 4 u_1 + 3 u_2) / dt,  a_2 = (v_0 - 4 v_1 + 3 v_2) / dt.
  end.u = middle.u;
  end.u.add(h, middle.v, 0.5 * h * h, middle.a);
  end.v = end.u;
  end.v *= 3 / dt;
  end.v.add(-4 / dt, middle.u, 1 / dt, state.u);
  end.a = end.v;
  end.a *= 3 / dt;
  end.a.add(-4 / dt, middle.v, 1 / dt, state.v);
  system.prescribe(end, step.end, 1.);
  corotet::StageReport report = system.solve_stage(
    end, {step.end, 3 / dt, 9 / (dt * dt), 1., &middle, 0.5 * h * h});
  state = end;

  report.newton_iterations += first.newton_iterations;
  report.linear_iterations += first.linear_iterations;
  return report;
}
