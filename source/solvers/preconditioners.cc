// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/amg.h>
#include <corotet/solvers/direct.h>
#include <corotet/solvers/jacobi.h>
#include <corotet/solvers/p_multigrid.h>
#include <corotet/solvers/preconditioners.h>

namespace corotet
{
  std::vector<Candidate<Preconditioner>>
  preconditioners()
  {
    const auto amg = std::make_shared<AMGParameters>();
    return with_added<Preconditioner>(
      {candidate<Preconditioner, PMultigrid>("p-multigrid", amg),
       candidate<Preconditioner, AMG>("amg", amg),
       candidate<Preconditioner, Jacobi>("jacobi"),
       candidate<Preconditioner, Direct>("direct")});
  }
} // namespace corotet
