// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/bdf2.h>

#include <cmath>

namespace corotet
{
  void
  BDF2::remember(const TimeStep &step, const State &state)
  {
    // If the same step is tried again, perhaps in a run with another end time,
    // times may differ by round-off.
    const double round_off = 1e-6 * step.dt;
    Assert(!(step.time < present.time - round_off),
           dealii::ExcMessage("reset() starts another run"));
    if (step.time > present.time + round_off)
      std::swap(present, before);
    present = {step.time, state.u, state.v};
  }

  StageReport
  BDF2::step(SecondOrderSystem &system, const TimeStep &step, State &state)
  {
    remember(step, state);
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
