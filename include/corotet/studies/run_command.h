// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_run_command_h
#define corotet_studies_run_command_h

#include <corotet/base/parameter_file.h>
#include <corotet/simulation/command_line.h>

#include <mpi.h>

#include <functional>

namespace corotet
{
  /**
   * Executes the command line: runs its parameter file with all results in the
   * output directory, only checks it, or lists the parameters. Declares the
   * parameters in @p file and reads it.
   *
   * Throws Error of every kind. An InputError with an entry should be shown
   * with the place that @p file knows. Collective.
   */
  void
  run_command(const CommandLine &command,
              ParameterFile     &file,
              const MPI_Comm     comm);

  /// Throws MachineError if printed text could not be written. Called on rank
  /// 0.
  void
  check_standard_output();

  /**
   * Runs @p action. If it throws an InputError with an entry, throws one with
   * the place where @p file or an option of @p command sets that entry.
   */
  void
  with_places(const CommandLine           &command,
              const ParameterFile         &file,
              const std::function<void()> &action);
} // namespace corotet

#endif
