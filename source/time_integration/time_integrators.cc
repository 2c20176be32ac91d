// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/backward_euler.h>
#include <corotet/time_integration/generalized_alpha.h>
#include <corotet/time_integration/load_stepping.h>
#include <corotet/time_integration/newmark.h>
#include <corotet/time_integration/time_integrators.h>

namespace corotet
{
  std::vector<Candidate<TimeIntegrator>>
  time_integrators()
  {
    return {candidate<TimeIntegrator, LoadStepping>("static"),
            candidate<TimeIntegrator, BackwardEuler>("backward Euler"),
            candidate<TimeIntegrator, Newmark>("Newmark"),
            candidate<TimeIntegrator, GeneralizedAlpha>("generalized-alpha")};
  }
} // namespace corotet
