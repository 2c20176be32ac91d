// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/backward_euler.h>
#include <corotet/time_integration/bdf2.h>
#include <corotet/time_integration/central_difference.h>
#include <corotet/time_integration/generalized_alpha.h>
#include <corotet/time_integration/hht_alpha.h>
#include <corotet/time_integration/implicit_midpoint.h>
#include <corotet/time_integration/load_stepping.h>
#include <corotet/time_integration/newmark.h>
#include <corotet/time_integration/time_integrators.h>

namespace corotet
{
  std::vector<Candidate<TimeIntegrator>>
  time_integrators()
  {
    return with_added<TimeIntegrator>(
      {candidate<TimeIntegrator, LoadStepping>("static"),
       candidate<TimeIntegrator, BackwardEuler>("backward Euler"),
       candidate<TimeIntegrator, BDF2>("BDF2"),
       candidate<TimeIntegrator, ImplicitMidpoint>("implicit midpoint"),
       candidate<TimeIntegrator, Newmark>("Newmark"),
       candidate<TimeIntegrator, HHTAlpha>("HHT-alpha"),
       candidate<TimeIntegrator, GeneralizedAlpha>("generalized-alpha"),
       candidate<TimeIntegrator, CentralDifference>("central difference")});
  }
} // namespace corotet
