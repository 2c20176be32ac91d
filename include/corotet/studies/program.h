// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_program_h
#define corotet_studies_program_h

namespace corotet
{
  /**
   * The whole program: what the command line asks for, from MPI_Init to
   * MPI_Finalize. All of a main() that adds candidates to the program's lists
   * (base/selectable.h) before it calls this.
   *
   * Returns the exit status: 0 done; 1 the input is wrong; 2 the computation
   * has failed, or a check of it; 3 the machine has failed. Errors are shown on
   * stderr. To be called once, and where MPI has not been started: what else
   * starts it uses run_program(comm, action) of base/mpi.h, and SteppedRun.
   */
  int
  run_program(const int argc, char **argv);
} // namespace corotet

#endif
