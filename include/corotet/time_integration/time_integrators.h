// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_time_integrators_h
#define corotet_time_integration_time_integrators_h

#include <corotet/base/selectable.h>
#include <corotet/time_integration/time_integrator.h>

namespace corotet
{
  /**
   * All time integrators, by the names that a parameter file selects them by:
   * the library's, and what programs have added (AddedCandidate).
   */
  std::vector<Candidate<TimeIntegrator>>
  time_integrators();
} // namespace corotet

#endif
