// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_preconditioners_h
#define corotet_solvers_preconditioners_h

#include <corotet/base/selectable.h>
#include <corotet/solvers/preconditioner.h>

namespace corotet
{
  /**
   * All preconditioners, by the names that a parameter file selects them by:
   * the library's, and what programs have added (AddedCandidate).
   */
  std::vector<Candidate<Preconditioner>>
  preconditioners();
} // namespace corotet

#endif
