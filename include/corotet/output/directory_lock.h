// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_directory_lock_h
#define corotet_output_directory_lock_h

#include <corotet/base/log.h>

#include <mpi.h>

#include <string>

namespace corotet
{
  /**
   * Marks an output directory as one of corotet by the file ".corotet", and
   * keeps other runs out of it during its lifetime: rank 0 holds a lock on that
   * file. The system ends the lock with the process, so the file of a run that
   * was killed locks nothing.
   */
  class DirectoryLock
  {
  public:
    /// Makes the directory and locks it. Throws MachineError if another process
    /// has the lock; where the file system has no locks, @p log gets a warning
    /// instead. Collective.
    DirectoryLock(const std::string &directory, const MPI_Comm comm, Log &log);
    ~DirectoryLock();

    DirectoryLock(const DirectoryLock &) = delete;
    DirectoryLock &
    operator=(const DirectoryLock &) = delete;

    /// The name of the file.
    static const std::string file_name;

    /// Whether a directory has been marked. Not collective.
    static bool
    has_marked(const std::string &directory);

  private:
    void
    take(const std::string &directory, Log &log);

    /// The descriptor of the file on rank 0; -1 elsewhere.
    int descriptor = -1;
  };
} // namespace corotet

#endif
