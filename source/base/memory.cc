// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <new>

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

  namespace
  {
    std::string
    gigabytes(const double n_bytes)
    {
      return fmt::format("{:.3g} GB", 1e-9 * n_bytes);
    }
  } // namespace

  double
  available_memory()
  {
    double available = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                       static_cast<double>(sysconf(_SC_PAGESIZE));
    for (const auto resource : {RLIMIT_AS, RLIMIT_DATA})
      {
        rlimit limit{};
        if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
          available = std::min(available, static_cast<double>(limit.rlim_cur));
      }
    // Of a container; it says "max" where there is no limit.
    double of_container = 0;
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> of_container)
      available = std::min(available, of_container);
    return available;
  }

  void
  check_memory(const double       n_bytes,
               const std::string &what,
               const std::string &advice)
  {
    const double available = available_memory();
    if (n_bytes > available)
      throw MachineError(fmt::format("memory is too short: {} would need at "
                                     "least {}, found are {} in all; {}",
                                     what,
                                     gigabytes(n_bytes),
                                     gigabytes(available),
                                     advice));
  }

  bool
  is_lack_of_memory(const std::exception &error)
  {
    return dynamic_cast<const std::bad_alloc *>(&error) != nullptr ||
           dynamic_cast<const dealii::ExcOutOfMemory *>(&error) != nullptr ||
           std::string(error.what()).starts_with("Kokkos failed to allocate");
  }

  std::string
  lack_of_memory()
  {
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    return fmt::format("memory is too short: this process has {}, and may have "
                       "no more than {} if others leave it that; a coarser "
                       "mesh or a lower degree needs less",
                       gigabytes(1024. * memory.VmRSS),
                       gigabytes(available_memory()));
  }
} // namespace corotet
