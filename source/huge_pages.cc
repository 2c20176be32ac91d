// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Memory of the program on huge pages, of 2 MB on most machines, also where
// Linux gives these to who asks for them only (see its documentation of
// transparent huge pages): arrays are there many times as soon, and processors
// find numbers of all over a body without going through tables of pages. Where
// all programs have them, or none, nothing is done. The library leaves memory
// to the programs that it is in.

#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string_view>

namespace
{
  // Bytes from which on an array does not lie on the heap: the most that
  // malloc() allows.
  constexpr std::size_t own_mapping = std::size_t(32) << 20;

  // The heap grows by so much more than is asked for, which takes no memory as
  // long as nobody writes there: huge pages must be asked for before anything
  // is written, and malloc() writes beside each array.
  constexpr int growth = 64 << 20, most_unused = 2 * growth;

  // Bytes for which a look at the heap pays.
  constexpr std::size_t large = 1 << 16;

  bool                        is_on = false;
  std::uintptr_t              page_size, heap_begin;
  std::atomic<std::uintptr_t> heap_end;

  std::uintptr_t
  end_of_heap() noexcept
  {
    return reinterpret_cast<std::uintptr_t>(sbrk(0));
  }

  // Whole pages from an address on. It may fail: then pages are small.
  void
  ask(const std::uintptr_t begin, const std::uintptr_t end) noexcept
  {
    const int error = errno;
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    madvise(reinterpret_cast<void *>(begin),
            (end - begin) / page_size * page_size,
            MADV_HUGEPAGE);
    errno = error;
  }

  void
  ask_for(void *const memory, const std::size_t n_bytes) noexcept
  {
    const std::uintptr_t end = end_of_heap();
    if (heap_end.exchange(end) != end && end > heap_begin)
      ask(heap_begin, end);
    if (n_bytes >= own_mapping)
      {
        const auto           address = reinterpret_cast<std::uintptr_t>(memory);
        const std::uintptr_t begin   = (address + page_size - 1) / page_size;
        ask(begin * page_size, address + n_bytes);
      }
  }

  bool
  are_on_request()
  {
    const int file =
      open("/sys/kernel/mm/transparent_hugepage/enabled", O_RDONLY | O_CLOEXEC);
    if (file < 0)
      return false;
    std::array<char, 64> text{};
    const ssize_t        n = read(file, text.data(), text.size());
    close(file);
    return n > 0 && std::string_view(text.data(), n).find("[madvise]") !=
                      std::string_view::npos;
  }

  // The environment may choose for malloc().
  [[gnu::constructor]] void
  switch_on()
  {
    if (std::getenv("GLIBC_TUNABLES") != nullptr || !are_on_request())
      return;
    mallopt(M_MMAP_THRESHOLD, own_mapping);
    mallopt(M_TOP_PAD, growth);
    mallopt(M_TRIM_THRESHOLD, most_unused);
    page_size  = sysconf(_SC_PAGESIZE);
    heap_end   = end_of_heap();
    heap_begin = (heap_end + page_size - 1) / page_size * page_size;
    is_on      = true;
  }
} // namespace

// What the standard lets a program replace: all other forms of new, and of
// delete, call these.
void *
operator new(const std::size_t n_bytes)
{
  for (;;)
    {
      if (void *const memory = std::malloc(n_bytes == 0 ? 1 : n_bytes))
        {
          if (is_on && n_bytes >= large)
            ask_for(memory, n_bytes);
          return memory;
        }
      if (const std::new_handler handler = std::get_new_handler())
        handler();
      else
        throw std::bad_alloc();
    }
}

void
operator delete(void *const memory) noexcept
{
  std::free(memory);
}

void
operator delete(void *const memory, std::size_t /*n_bytes*/) noexcept
{
  std::free(memory);
}

// deal.II's arrays for registers. The C library's names of the parameters are
// reserved ones.
// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name)
extern "C" [[gnu::visibility("default")]] int
posix_memalign(void            **memory,
               const std::size_t alignment,
               const std::size_t n_bytes) noexcept
{
  if (alignment % sizeof(void *) != 0 || !std::has_single_bit(alignment))
    return EINVAL;
  const int   error     = errno;
  void *const allocated = memalign(alignment, n_bytes);
  errno                 = error;
  if (allocated == nullptr)
    return ENOMEM;
  if (is_on && n_bytes >= large)
    ask_for(allocated, n_bytes);
  *memory = allocated;
  return 0;
}
