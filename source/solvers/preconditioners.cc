// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/direct.h>
#include <corotet/solvers/jacobi.h>
#include <corotet/solvers/p_multigrid.h>
#include <corotet/solvers/preconditioners.h>

#ifdef COROTET_WITH_EPETRA
#  include <corotet/solvers/epetra/amesos_direct.h>
#  include <corotet/solvers/epetra/amg.h>
#endif

namespace corotet
{
  std::vector<Candidate<Preconditioner>>
  preconditioners()
  {
#ifdef COROTET_WITH_EPETRA
    const auto          amg = std::make_shared<AMGParameters>();
    const CoarseSolvers coarse_solvers{
      candidate<CoarseSolver, AMG>("amg", amg)};
    return with_added<Preconditioner>(
      {candidate<Preconditioner, PMultigrid>("p-multigrid", coarse_solvers),
       candidate<Preconditioner, AMG>("amg", amg),
       candidate<Preconditioner, Jacobi>("jacobi"),
       candidate<Preconditioner, AmesosDirect>("direct")});
#else
    return with_added<Preconditioner>(
      {candidate<Preconditioner, PMultigrid>("p-multigrid"),
       candidate<Preconditioner, Jacobi>("jacobi"),
       candidate<Preconditioner, CholeskyDirect>("direct")});
#endif
  }
} // namespace corotet
