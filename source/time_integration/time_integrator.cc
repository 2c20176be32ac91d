// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/time_integrator.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  StageReport
  TimeIntegrator::steps(SecondOrderSystem &system,
                        const TimeStep    &first,
                        const unsigned int n,
                        State             &state)
  {
    StageReport report;
    TimeStep    now = first;
    for (unsigned int i = 0; i < n; ++i)
      {
        if (i > 0)
          now = {first.time + i * first.dt, first.dt, first.done};
        report = step(system, now, state);
      }
    return report;
  }

  double
  TimeIntegrator::n_steps(const double duration, const double dt) const
  {
    // Round-off in the quotient must not add a step, nor make it none.
    return std::max(1., std::ceil(duration / dt * (1 - 1e-10)));
  }
} // namespace corotet
