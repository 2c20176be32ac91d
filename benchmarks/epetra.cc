// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/epetra/epetra_matrix.h>

#include "application.h"
#include "static_solve.h"

namespace corotet::benchmarks
{
  void
  add_epetra(CaseData &data)
  {
    add_application(data, "epetra", [&data](Application &a) {
      const auto   matrix   = std::make_shared<EpetraMatrix>(data.matrix());
      const double n        = data.problem().n_unknowns();
      const double nonzeros = data.assembly_figures().at("nonzeros");
      return Measured{[matrix, &a] { matrix->vmult(a.y, a.x); },
                      {{"flops", 2 * nonzeros},
                       {"bytes", matrix_traffic(nonzeros, nonzeros, n, n)}}};
    });
    add_long(
      data.name("solve/p-multigrid-amg"),
      [&data] {
        if (data.which().degree == 1)
          data.matrix();
        return solve(data,
                     data.effective(),
                     *make_preconditioner("p-multigrid",
                                          "set Coarse solver = amg"));
      },
      3);
    // This is the usual way: conjugate gradients with the assembled matrix and
    // ML.
    add_long(data.name("solve/cg_ml"), [&data] {
      const EpetraMatrix matrix(data.matrix());
      return solve(data, matrix, *make_preconditioner("amg"));
    });
  }
} // namespace corotet::benchmarks
