// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <link.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <new>
#include <span>
#include <vector>

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
    // Writing 5 resets VmHWM, see proc(5).
    std::ofstream("/proc/self/clear_refs") << "5";
  }

  namespace
  {
    std::uintptr_t
    page_size()
    {
      static const std::uintptr_t size = sysconf(_SC_PAGESIZE);
      return size;
    }

    // The first page boundary at or after an address.
    std::uintptr_t
    next_page(const std::uintptr_t address)
    {
      return (address + page_size() - 1) / page_size() * page_size();
    }

    // Releases whole pages that belong to the process alone, or to a file and
    // are unchanged. A failure has no effect.
    void
    release_pages(const std::uintptr_t begin, const std::uintptr_t end)
    {
      if (end > begin)
        // NOLINTNEXTLINE(performance-no-int-to-ptr)
        madvise(reinterpret_cast<void *>(begin), end - begin, MADV_DONTNEED);
    }

    // Releases pages that are as the file has them: not those that have been
    // written to, as by relocations and by breakpoints of a debugger.
    void
    release_unchanged_pages(const std::uintptr_t begin,
                            const std::uintptr_t end,
                            const int            pagemap)
    {
      // See Linux' documentation of pagemap: a word for each page.
      constexpr std::uint64_t is_present = 1ull << 63, is_of_file = 1ull << 61;
      std::vector<std::uint64_t> words((end - begin) / page_size());
      const auto                 n_bytes =
        static_cast<ssize_t>(words.size() * sizeof(words[0]));
      if (pread(pagemap,
                words.data(),
                n_bytes,
                begin / page_size() * sizeof(words[0])) != n_bytes)
        return;
      const auto is_unchanged = [](const std::uint64_t word) {
        return (word & is_present) == 0 || (word & is_of_file) != 0;
      };
      for (auto first = words.begin(); first != words.end();)
        {
          first           = std::find_if(first, words.end(), is_unchanged);
          const auto last = std::find_if_not(first, words.end(), is_unchanged);
          release_pages(begin + page_size() * (first - words.begin()),
                        begin + page_size() * (last - words.begin()));
          first = last;
        }
    }

    // The callback for dl_iterate_phdr().
    int
    release_library(dl_phdr_info *library, std::size_t /*size*/, void *pagemap)
    {
      const std::span headers(library->dlpi_phdr, library->dlpi_phnum);
      for (const ElfW(Phdr) & header : headers)
        if (header.p_type == PT_LOAD && (header.p_flags & PF_W) == 0)
          {
            const std::uintptr_t begin =
              next_page(library->dlpi_addr + header.p_vaddr);
            const std::uintptr_t end =
              library->dlpi_addr + header.p_vaddr + header.p_memsz;
            if (end > begin + page_size())
              release_unchanged_pages(begin,
                                      end - end % page_size(),
                                      *static_cast<const int *>(pagemap));
          }
      return 0;
    }
  } // namespace

  void
  release_library_pages()
  {
    // Without a buffer, as only whole words are read.
    int pagemap = open("/proc/self/pagemap", O_RDONLY | O_CLOEXEC);
    if (pagemap < 0)
      return;
    dl_iterate_phdr(release_library, &pagemap);
    close(pagemap);
  }

  void
  release_free_memory()
  {
    // The number of free bytes from which releasing pays: the system must zero
    // the pages when they are used again.
    constexpr std::size_t much = 1 << 25;
    // Free memory may never have been in use, so resident memory counts. The
    // file has numbers of pages, see proc(5): all of the process, the resident
    // ones, and the shared ones of these.
    std::size_t   n_pages = 0, n_in_memory = 0, n_shared = 0;
    std::ifstream file("/proc/self/statm");
    if (!(file >> n_pages >> n_in_memory >> n_shared))
      return;
    const struct mallinfo2 heap = mallinfo2();
    if ((n_in_memory - n_shared) * page_size() >
        heap.uordblks + heap.hblkhd + much)
      malloc_trim(0);
  }

  LastReading::LastReading(void *begin)
    : end_of_released(next_page(reinterpret_cast<std::uintptr_t>(begin)))
  {}

  void
  LastReading::passed(const void *place)
  {
    // The number of bytes from which a system call pays.
    constexpr std::uintptr_t piece = 1 << 22;
    const auto               end   = reinterpret_cast<std::uintptr_t>(place);
    if (end < end_of_released + piece)
      return;
    const std::uintptr_t last = end - end % page_size();
    release_pages(end_of_released, last);
    end_of_released = last;
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
    // The memory limit of a container; the file says "max" if there is none.
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
