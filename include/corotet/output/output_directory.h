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
   * Makes @p directory (and its parents) an empty one for the results of a run.
   *
   * A directory that is not empty is refused, unless @p overwrite is set and it
   * holds the results of an earlier run and nothing else: then these are
   * removed. Anything that corotet does not write itself is left alone.
   *
   * Throws InputError blamed on Output/Directory, and MachineError if the
   * directory cannot be made or emptied. Collective.
   */
  void
  prepare_output_directory(const std::string &directory,
                           const bool         overwrite,
                           const MPI_Comm     comm);

  /**
   * Throws what prepare_output_directory() would throw about what is there, and
   * changes nothing. Collective.
   */
  void
  check_output_directory(const std::string &directory,
                         const bool         overwrite,
                         const MPI_Comm     comm);

  /// Whether anything but the mark of a run is in it. Collective.
  bool
  is_filled(const std::string &directory, const MPI_Comm comm);

  /// What a run that is restarted needs: a place, and results of corotet if
  /// there is anything. Throws InputError or MachineError. Collective.
  void
  check_directory_of_restart(const std::string &directory, const MPI_Comm comm);

  /// @p directory, or if there is none the innermost folder (or what else)
  /// that it would be made in. On this rank.
  std::filesystem::path
  existing_place(const std::filesystem::path &directory);
} // namespace corotet

#endif
