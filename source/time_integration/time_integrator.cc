// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/time_integrator.h>

#include <cmath>

namespace corotet
{
  unsigned int
  TimeIntegrator::n_steps(const double duration, const double dt) const
  {
    // Round-off in the quotient must not add a step.
    return static_cast<unsigned int>(std::ceil(duration / dt * (1 - 1e-10)));
  }
} // namespace corotet
