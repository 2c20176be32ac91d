// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Benchmarks of one body: operators, updates, solvers, dynamics and memory.
// Arguments select the body and, as those of Google Benchmark, the benchmarks.
// Runs on any number of ranks.

#include <deal.II/base/mpi.h>

#include <CLI/CLI.hpp>

#include "case_data.h"

int
main(int argc, char **argv)
{
  using namespace corotet::benchmarks;
  const Session session(argv);
  Case          which;
  CLI::App      application("Benchmarks of a body");
  application.add_option("--label", which.label, "First part of all names");
  application.add_option("--degree", which.degree)->check(CLI::Range(1, 3));
  application.add_option("--cells", which.cells, "Cuboids in x, y and z")
    ->delimiter(',');
  application.add_option("--mesh", which.mesh, "Mesh instead of the beam");
  application.add_option("--element-size", which.element_size);
  application.add_option("--clamped", which.clamped, "Its boundary at x = 0");
  application.add_option("--poissons-ratio", which.poissons_ratio);
  application.add_option("--jump", which.jump, "Ratio of stiffnesses");
  application.add_option("--bend", which.bend, "Angle [rad]");
  application.allow_extras();
  CLI11_PARSE(application, argc, argv);

  CaseData data(which);
  add_operators(data);
#ifdef COROTET_WITH_EPETRA
  add_epetra(data);
#endif
  add_deal_matrix_free(data);
  add_updates(data);
  add_solvers(data);
  add_dynamics(data);
  add_memory(data);
  return run(argc, argv);
}
