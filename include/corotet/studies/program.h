// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_program_h
#define corotet_studies_program_h

namespace corotet
{
  /**
   * The whole program: executes the command line, from MPI_Init to
   * MPI_Finalize. A main() that adds candidates to the program's lists
   * (base/selectable.h) only has to call this afterwards.
   *
   * Returns the exit status: 0 done; 1 the input is wrong; 2 the computation,
   * or a check of it, has failed; 3 the machine has failed. Errors are shown on
   * stderr. To be called once, and only if MPI has not been started: programs
   * that start MPI use run_program(comm, action) of base/mpi.h, and SteppedRun.
   */
  int
  run_program(const int argc, char **argv);
} // namespace corotet

#endif
