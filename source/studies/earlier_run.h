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
   * Why the results in a directory are not those of the run that is to go on
   * there: the entry that differs, and what an error says of it.
   */
  struct OtherRun
  {
    std::string entry;
    std::string message;
  };

  /// Compares the entries in @p file, all of which are read, with those that
  /// the run in @p directory was started with, parameters.prm. Entries may
  /// differ where restarts from a checkpoint allow it, and in studies those of
  /// the output and those that the lists of the study replace. Where names of
  /// files lead may differ, as both are relative to other folders, but not
  /// their last parts. None if all that is the same, or nothing is known of an
  /// earlier run. Collective.
  std::optional<OtherRun>
  other_run_in(const std::string   &directory,
               const ParameterFile &file,
               const MPI_Comm       comm);

  /// Throws InputError if a restart that has no checkpoint to go on from must
  /// not replace what is in @p directory: results of a run that came to an end
  /// by itself, checkpoints none of which is good (@p has_checkpoints), or
  /// results of another run. Collective.
  void
  check_new_beginning(const std::string   &directory,
                      const ParameterFile &file,
                      const bool           has_checkpoints,
                      const MPI_Comm       comm);

  /// Whether one of these is in the directory. Collective.
  bool
  holds_any(const std::string              &directory,
            const std::vector<std::string> &names,
            const MPI_Comm                  comm);
} // namespace corotet

#endif
