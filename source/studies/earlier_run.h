// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_earlier_run_h
#define corotet_studies_earlier_run_h

#include <corotet/base/parameter_file.h>

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The reason why the results in a directory are not those of the run that is
   * to continue there: the entry that differs, and the message of an error.
   */
  struct OtherRun
  {
    std::string entry;
    std::string message;
  };

  /// Compares the entries in @p file, all of which are read, with the entries
  /// that the run in @p directory was started with, parameters.prm. Entries may
  /// differ where restarts from a checkpoint allow it, and in studies also
  /// those of the output and those that the lists of the study replace. Names
  /// of files may differ in their folders, as both are relative to other
  /// folders, but not in their last parts. Returns nothing if all of these
  /// agree, or if there is no earlier run. Collective.
  std::optional<OtherRun>
  other_run_in(const std::string   &directory,
               const ParameterFile &file,
               const MPI_Comm       comm);

  /// Throws InputError if a restart without a checkpoint must not replace the
  /// contents of @p directory: results of a run that has ended by itself,
  /// checkpoints that are all damaged (@p has_checkpoints), or results of
  /// another run. Collective.
  void
  check_new_beginning(const std::string   &directory,
                      const ParameterFile &file,
                      const bool           has_checkpoints,
                      const MPI_Comm       comm);

  /// Whether the directory has one of the files @p names. Collective.
  bool
  holds_any(const std::string              &directory,
            const std::vector<std::string> &names,
            const MPI_Comm                  comm);
} // namespace corotet

#endif
