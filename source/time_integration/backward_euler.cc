// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/backward_euler.h>

namespace corotet
{
  StageReport
  BackwardEuler::step(SecondOrderSystem &system,
                      const TimeStep    &step,
                      State             &state)
  {
    // Guess: no acceleration.
    state.u.add(step.dt, state.v);
    state.a = 0;
    system.prescribe(state, step.end, 1.);
    return system.solve_stage(state,
                              {step.end, 1 / step.dt, 1 / (step.dt * step.dt)});
  }
} // namespace corotet
