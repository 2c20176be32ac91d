// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A clamped bar is pushed along its axis from time 0 on. The push ends when the
// bar's end comes to rest for a moment, where it is stretched most: that moment
// is not known in advance. The bar then swings as far to the other side.

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/discretization/discretization.h>
#include <corotet/studies/stepped_run.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdio>

#include "push.h"

namespace
{
  constexpr double length = 10; // m, as in bar.prm

  // The mean x component of a vector over the nodes at the bar's end.
  double
  mean_at_end(const corotet::Discretization &discretization,
              const corotet::Vector         &vector)
  {
    double sum = 0, n_nodes = 0;
    for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
      if (discretization.node_position(n)[0] > (1 - 1e-6) * length)
        {
          sum += vector.local_element(3 * n);
          ++n_nodes;
        }
    const MPI_Comm comm = discretization.communicator();
    return dealii::Utilities::MPI::sum(sum, comm) /
           dealii::Utilities::MPI::sum(n_nodes, comm);
  }

  void
  run(const std::string &parameter_file, double &push)
  {
    corotet::CommandLine command;
    command.parameter_file = parameter_file;
    command.quiet          = true;

    push = 100;
    corotet::SteppedRun run(command);
    double              let_go_at = 0, highest = 0, lowest = 0;
    while (!run.is_done())
      {
        run.step();
        const double u = mean_at_end(run.discretization(), run.displacement());
        const double v = mean_at_end(run.discretization(), run.velocity());
        highest        = std::max(highest, u);
        lowest         = std::min(lowest, u);
        if (push > 0 && v < 0)
          {
            push      = 0;
            let_go_at = run.time();
          }
      }
    run.finish();
    corotet::on_root(MPI_COMM_WORLD, [&] {
      std::printf("%.16g %.16g %.16g\n", let_go_at, highest, lowest);
    });
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  double                                            push = 0;
  const corotet::AddedCandidate<corotet::ForceKind> kind(
    corotet::candidate<corotet::ForceKind, PushKind>("push", &push));

  // run_program() shows errors once, and turns them into an exit status.
  return corotet::run_program(MPI_COMM_WORLD, [&] {
    if (argc != 2)
      throw corotet::InputError("", "let_go needs one parameter file");
    run(argv[1], push);
  });
}
