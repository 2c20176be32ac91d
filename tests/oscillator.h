// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_oscillator_h
#define corotet_tests_oscillator_h

#include <corotet/time_integration/second_order_system.h>

#include <cmath>

namespace corotet::tests
{
  /**
   * A scalar oscillator m a + c v + k u = weight + p sin(w t), which solves its
   * linear stages exactly.
   */
  class Oscillator : public SecondOrderSystem
  {
  public:
    void
    prescribe(State &, const double, const double) override
    {}

    StageReport
    solve_stage(State &s, const Stage &stage) override
    {
      double      &u = s.u.local_element(0);
      double      &v = s.v.local_element(0);
      double      &a = s.a.local_element(0);
      const double residual =
        stage.load_factor * load(stage.time) - m * a - c * v - k * u;
      const double du = residual / (k + stage.velocity_factor * c +
                                    stage.acceleration_factor * m);
      u += du;
      v += stage.velocity_factor * du;
      a += stage.acceleration_factor * du;
      return {1, 0};
    }

    StageReport
    solve_acceleration(State       &s,
                       const double time,
                       const double velocity_factor = 0) override
    {
      const double a =
        (load(time) - c * s.v.local_element(0) - k * s.u.local_element(0)) /
        (m + velocity_factor * c);
      s.a.local_element(0) = a;
      s.v.local_element(0) += velocity_factor * a;
      return {};
    }

    double
    load(const double t) const
    {
      return weight + p * std::sin(w * t);
    }

    double m = 2, c = 0, k = 8, p = 0, w = 3, weight = 0;
  };

  /// The state at time 0 with these values of u and v.
  inline State
  initial_state(Oscillator &system, const double u, const double v)
  {
    State state{Vector(1), Vector(1), Vector(1)};
    state.u = u;
    state.v = v;
    system.solve_acceleration(state, 0.);
    return state;
  }
} // namespace corotet::tests

#endif
