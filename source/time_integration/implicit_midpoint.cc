// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/implicit_midpoint.h>

namespace corotet
{
  StageReport
  ImplicitMidpoint::step(SecondOrderSystem &system,
                         const TimeStep    &step,
                         State             &state)
  {
    const double dt = step.dt;

    // The guess of a_m is that of the step before.
    middle = state;
    middle.u.add(dt, state.v, 0.5 * dt * dt, state.a);
    middle.v.add(dt, state.a);
    system.prescribe(middle, step.end, 1.);

    // The guess moves from the end of the step to its middle. The acceleration
    // follows from the velocities, also for prescribed unknowns.
    middle.a = middle.v;
    middle.a -= state.v;
    middle.a *= 1 / dt;
    middle.u.sadd(0.5, 0.5, state.u);
    middle.v.sadd(0.5, 0.5, state.v);

    const StageReport report = system.solve_stage(middle,
                                                  {step.time + 0.5 * dt,
                                                   2 / dt,
                                                   4 / (dt * dt),
                                                   1.,
                                                   &state,
                                                   0.25 * dt * dt});

    state.u.sadd(-1., 2., middle.u);
    state.v.sadd(-1., 2., middle.v);
    state.a = middle.a;
    return report;
  }
} // namespace corotet
