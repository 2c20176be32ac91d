// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/bdf2.h>

#include <cmath>

namespace corotet
{
  void
  BDF2::remember(const double time, const State &state)
  {
    Assert(!(time < present.time),
           dealii::ExcMessage("reset() starts another run"));
    if (time > present.time)
      std::swap(present, before);
    // Else the same step is tried again.
    present = {time, state.u, state.v};
  }

  StageReport
  BDF2::step(SecondOrderSystem &system, const TimeStep &step, State &state)
  {
    remember(step.time, state);
    const double dt = step.dt;
    double       w =
      std::isfinite(before.time) ? dt / (present.time - before.time) : 0.;
    // Round-off in the times must not change the coefficients.
    if (std::abs(w - 1) < 1e-6)
      w = 1;
    const double c_1 = (1 + 2 * w) / ((1 + w) * dt);
    const double c_0 = -(1 + w) / dt;
    const double c_m = w * w / ((1 + w) * dt);

    // Sets derivative = D y, with y_1 = y.
    const auto differentiate =
      [&](Vector &derivative, const Vector &y, const auto past) {
        derivative = y;
        derivative.sadd(c_1, c_0, present.*past);
        if (w > 0)
          derivative.add(c_m, before.*past);
      };

    // Guess: no acceleration.
    state.u.add(dt, state.v);
    differentiate(state.v, state.u, &Past::u);
    differentiate(state.a, state.v, &Past::v);
    system.prescribe(state, step.end, 1.);
    return system.solve_stage(state, {step.end, c_1, c_1 * c_1});
  }
} // namespace corotet
