// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A program with a bug: lonely_error RANK KIND throws an exception of a kind on
// one rank ("all": on each), while the others wait for it in a barrier.

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>

#include <new>
#include <stdexcept>
#include <string>

using namespace corotet;

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                        where = argv[1];
  const std::string                        kind  = argv[2];
  const std::string                        rank =
    std::to_string(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
  const auto program = [&] {
    if (where == rank || where == "all")
      {
        if (kind == "input")
          throw InputError("Section/Entry", "of rank " + rank);
        if (kind == "computation")
          throw ComputationError("of rank " + rank);
        if (kind == "machine")
          throw MachineError("of rank " + rank);
        if (kind == "memory")
          throw std::bad_alloc();
        if (kind == "bug")
          throw std::logic_error("of rank " + rank);
        throw 0;
      }
    MPI_Barrier(MPI_COMM_WORLD);
  };
  return run_program(MPI_COMM_WORLD, program, /* patience = */ 0.5);
}
