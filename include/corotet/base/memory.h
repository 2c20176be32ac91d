// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_memory_h
#define corotet_base_memory_h

#include <mpi.h>

#include <cstddef>

namespace corotet
{
  /// The largest resident memory since the start of the process or the last
  /// reset_peak_memory(), over all ranks [byte]. Collective.
  std::size_t
  peak_memory(const MPI_Comm comm);

  /// Measures the peak from now on, where the system allows it (Linux does).
  void
  reset_peak_memory();
} // namespace corotet

#endif
