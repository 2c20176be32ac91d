// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/memory.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <cstdint>
#include <fstream>

namespace corotet
{
  std::size_t
  peak_memory(const MPI_Comm comm)
  {
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    // VmHWM is in kB.
    return dealii::Utilities::MPI::sum(static_cast<std::uint64_t>(memory.VmHWM),
                                       comm) *
           1024;
  }

  void
  reset_peak_memory()
  {
    // See proc(5): 5 resets VmHWM.
    std::ofstream("/proc/self/clear_refs") << "5";
  }
} // namespace corotet
