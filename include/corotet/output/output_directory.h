// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_output_directory_h
#define corotet_output_output_directory_h

#include <mpi.h>

#include <filesystem>
#include <string>

namespace corotet
{
  /**
   * Makes @p directory (and its parents) an empty directory for the results of
   * a run.
   *
   * A directory that is not empty is refused, unless @p overwrite is set and it
   * has the results of an earlier run and nothing else: then these are removed.
   * Files that corotet does not write itself are never removed.
   *
   * Throws InputError blamed on Output/Directory, and MachineError if the
   * directory cannot be made or emptied. Collective.
   */
  void
  prepare_output_directory(const std::string &directory,
                           const bool         overwrite,
                           const MPI_Comm     comm);

  /**
   * Throws what prepare_output_directory() would throw about existing files,
   * and changes nothing. Collective.
   */
  void
  check_output_directory(const std::string &directory,
                         const bool         overwrite,
                         const MPI_Comm     comm);

  /// Whether the directory has anything but the mark of a run. Collective.
  bool
  is_filled(const std::string &directory, const MPI_Comm comm);

  /// Checks the directory of a restarted run: it must be possible to make it,
  /// and if it has anything, these must be results of corotet. Throws
  /// InputError or MachineError. Collective.
  void
  check_directory_of_restart(const std::string &directory, const MPI_Comm comm);

  /// @p directory or, if it does not exist, the innermost existing part of its
  /// path. On this rank.
  std::filesystem::path
  existing_place(const std::filesystem::path &directory);
} // namespace corotet

#endif
