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
  /// reset_peak_memory(), summed over all ranks [byte]. Collective.
  std::size_t
  peak_memory(const MPI_Comm comm);

  /// Measures the peak from now on, where the system allows it (Linux does).
  void
  reset_peak_memory();

  /// Gives back the pages of the program and its libraries that only the start
  /// has read, which count as memory of each rank: tables of names and
  /// relocations (some 80 MB of deal.II and Trilinos) and code. Only pages that
  /// are unchanged are given back; the system reads them from the files again
  /// when they are used.
  void
  release_library_pages();

  /// Gives freed memory that the allocator keeps back to the system, if it is
  /// much: to be called before arrays of other sizes are made.
  void
  release_free_memory();

  /**
   * Gives back the memory of an array on the heap while it is read for the last
   * time, from its beginning to its end. The part that has been passed has no
   * values any more, but may be written, and is freed as usual.
   */
  class LastReading
  {
  public:
    explicit LastReading(void *begin);

    /// Tells that everything before @p place has been read.
    void
    passed(const void *place);

  private:
    /// The end of the memory that has been given back, a page boundary.
    std::uintptr_t end_of_released;
  };

  /// The memory that this process may use [byte]: that of the machine, or less
  /// if there is a limit.
  double
  available_memory();

  /// Throws MachineError if @p n_bytes, which @p what needs at least, are more
  /// than available_memory(). @p advice tells what would need less.
  void
  check_memory(const double       n_bytes,
               const std::string &what,
               const std::string &advice);

  /// Whether an exception, of this program or of a library, means that memory
  /// could not be allocated.
  bool
  is_lack_of_memory(const std::exception &error);

  /// The message about a lack of memory, with the memory that this process uses
  /// and may use.
  std::string
  lack_of_memory();
} // namespace corotet

#endif
