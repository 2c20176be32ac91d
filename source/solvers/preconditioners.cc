// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/automatic.h>
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
    // p-multigrid shares its parameters with the automatic choice, and amg with
    // the coarse solver.
#ifdef COROTET_WITH_EPETRA
    const auto          amg = std::make_shared<AMGParameters>();
    const CoarseSolvers coarse_solvers{
      candidate<CoarseSolver, AMG>("amg", amg)};
#else
    const CoarseSolvers coarse_solvers;
#endif
    const auto multigrid =
      std::make_shared<PMultigridParameters>(coarse_solvers);
    return with_added<Preconditioner>(
      {candidate<Preconditioner, AutomaticPreconditioner>("automatic",
                                                          multigrid),
       candidate<Preconditioner, PMultigrid>("p-multigrid", multigrid),
#ifdef COROTET_WITH_EPETRA
       candidate<Preconditioner, AMG>("amg", amg),
#endif
       candidate<Preconditioner, Jacobi>("jacobi"),
#ifdef COROTET_WITH_EPETRA
       candidate<Preconditioner, AmesosDirect>("direct")});
#else
       candidate<Preconditioner, CholeskyDirect>("direct")});
#endif
  }
} // namespace corotet
