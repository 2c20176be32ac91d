// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_memory_h
#define corotet_base_memory_h

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>

namespace corotet
{
  /// The largest resident memory since the start of the process or the last
  /// reset_peak_memory(), over all ranks [byte]. Collective.
  std::size_t
  peak_memory(const MPI_Comm comm);

  /// Measures the peak from now on, where the system allows it (Linux does).
  void
  reset_peak_memory();

  /// Gives back the pages of the program and its libraries that only the start
  /// has read, which count as memory of each rank: tables of names and
  /// relocations, some 80 MB of deal.II and Trilinos, and code. Those that are
  /// as the files have them, and come back from there when they are used.
  void
  release_library_pages();

  /// Gives back what has been freed and is kept for the next time, if it is
  /// much: where other large arrays than those before are to be made.
  void
  release_free_memory();

  /**
   * The last reading of an array on the heap, from its beginning to its end:
   * gives back the memory of what has been passed. That has no values any more,
   * but may be written, and is freed as ever.
   */
  class LastReading
  {
  public:
    explicit LastReading(void *begin);

    /// All that is before @p place has been read.
    void
    passed(const void *place);

  private:
    /// Up to where memory has been given back, the beginning of a page.
    std::uintptr_t end_of_released;
  };

  /// What this process may have [byte]: the memory of the machine, or less
  /// where a limit is set.
  double
  available_memory();

  /// Throws MachineError if @p n_bytes, which @p what needs at least, are more
  /// than available_memory(). @p advice is what takes less.
  void
  check_memory(const double       n_bytes,
               const std::string &what,
               const std::string &advice);

  /// Whether an exception, of this program or of a library, tells that no
  /// memory was to be had.
  bool
  is_lack_of_memory(const std::exception &error);

  /// What there is to be said about a lack of memory, with what this process
  /// has and may have.
  std::string
  lack_of_memory();
} // namespace corotet

#endif
