// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A library to be loaded before a program's others (LD_PRELOAD): operations on
// chosen files fail on a chosen rank, as on a full disk or without permission.
// The environment says which:
// COROTET_TEST_FILES  part of the paths of these files
// COROTET_TEST_RANK   rank in MPI_COMM_WORLD (Open MPI's number), or "all"
// COROTET_TEST_FROM   number of the first operation that fails, from 1 on
// COROTET_TEST_MODE   "from": all later ones fail, too; "once": no other one
//                     does; "kill": the process is killed in place of it
// COROTET_TEST_COUNT  file that gets the number of operations at the end
// Operations are: opening, writing, changing the size, bringing to the disk,
// closing what was written, renaming, making a folder, removing.
// With COROTET_TEST_MODE = "memory" the operations are allocations of 16 KiB or
// more (those of fields and files) from the first chosen file on instead, and
// one of them fails. With "no locks" only locks fail.

#ifndef _GNU_SOURCE
#  define _GNU_SOURCE
#endif
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace
{
  constexpr int    max_descriptors = 1024;
  std::atomic_bool is_watched[max_descriptors];
  std::atomic_long n_operations;
  std::atomic_bool has_begun;

  const char *
  setting(const char *name)
  {
    const char *value = std::getenv(name);
    return value == nullptr ? "" : value;
  }

  bool
  is_chosen_rank()
  {
    static const bool chosen =
      std::strcmp(setting("COROTET_TEST_RANK"), "all") == 0 ||
      std::strcmp(setting("COROTET_TEST_RANK"),
                  setting("OMPI_COMM_WORLD_RANK")) == 0;
    return chosen;
  }

  bool
  is_chosen(const char *path)
  {
    const char *part = setting("COROTET_TEST_FILES");
    return *part != '\0' && path != nullptr &&
           std::strstr(path, part) != nullptr && is_chosen_rank();
  }

  bool
  is_chosen(const int descriptor)
  {
    return descriptor >= 0 && descriptor < max_descriptors &&
           is_watched[descriptor];
  }

  bool
  has_mode(const char *mode)
  {
    return std::strcmp(setting("COROTET_TEST_MODE"), mode) == 0;
  }

  // Whether operation number @p n fails or ends the process.
  bool
  is_its_turn(const long n)
  {
    static const long from = std::atol(setting("COROTET_TEST_FROM"));
    static const bool once = has_mode("once") || has_mode("memory");
    static const bool kill = has_mode("kill");
    if (n < from || (once && n > from))
      return false;
    if (kill)
      ::kill(getpid(), SIGKILL);
    return true;
  }

  // Counts an operation, and tells whether it has to fail, with this error.
  bool
  fails(const int error)
  {
    static const bool of_memory = has_mode("memory");
    if (of_memory)
      {
        has_begun = true;
        return false;
      }
    if (!is_its_turn(++n_operations))
      return false;
    errno = error;
    return true;
  }

  template <typename Function>
  Function *
  original(Function *, const char *name)
  {
    return reinterpret_cast<Function *>(dlsym(RTLD_NEXT, name));
  }

  void
  watch(const int descriptor)
  {
    if (descriptor >= 0 && descriptor < max_descriptors)
      is_watched[descriptor] = true;
  }

  struct Counter
  {
    Counter()                = default;
    Counter(const Counter &) = delete;
    Counter &
    operator=(const Counter &) = delete;

    ~Counter()
    {
      const char *path = setting("COROTET_TEST_COUNT");
      // Rank 0 has the most operations of all ranks.
      const char *rank = setting("OMPI_COMM_WORLD_RANK");
      if (*path == '\0' || !is_chosen_rank() ||
          (std::strcmp(setting("COROTET_TEST_RANK"), "all") == 0 &&
           *rank != '\0' && std::strcmp(rank, "0") != 0))
        return;
      if (std::FILE *file = std::fopen(path, "w"); file != nullptr)
        {
          std::fprintf(file, "%ld\n", n_operations.load());
          std::fclose(file);
        }
    }
  } counter;
} // namespace

extern "C"
{
#define COROTET_OPEN(NAME)                                       \
  int NAME(const char *path, int flags, ...)                     \
  {                                                              \
    std::va_list arguments;                                      \
    va_start(arguments, flags);                                  \
    const mode_t mode = va_arg(arguments, mode_t);               \
    va_end(arguments);                                           \
    const bool chosen = is_chosen(path);                         \
    if (chosen && fails(EACCES))                                 \
      return -1;                                                 \
    const int result = original(NAME, #NAME)(path, flags, mode); \
    if (chosen)                                                  \
      watch(result);                                             \
    return result;                                               \
  }
  COROTET_OPEN(open)
  COROTET_OPEN(open64)

#define COROTET_FOPEN(NAME)                                      \
  std::FILE *NAME(const char *path, const char *mode)            \
  {                                                              \
    const bool chosen = is_chosen(path);                         \
    if (chosen && fails(EACCES))                                 \
      return nullptr;                                            \
    std::FILE *const result = original(NAME, #NAME)(path, mode); \
    if (chosen && result != nullptr)                             \
      watch(fileno(result));                                     \
    return result;                                               \
  }
  COROTET_FOPEN(fopen)
  COROTET_FOPEN(fopen64)

  ssize_t
  write(int descriptor, const void *data, size_t size)
  {
    if (is_chosen(descriptor) && fails(ENOSPC))
      return -1;
    return original(write, "write")(descriptor, data, size);
  }

  ssize_t
  writev(int descriptor, const iovec *data, int n)
  {
    if (is_chosen(descriptor) && fails(ENOSPC))
      return -1;
    return original(writev, "writev")(descriptor, data, n);
  }

#define COROTET_PWRITE(NAME)                                               \
  ssize_t NAME(int descriptor, const void *data, size_t size, off_t place) \
  {                                                                        \
    if (is_chosen(descriptor) && fails(ENOSPC))                            \
      return -1;                                                           \
    return original(NAME, #NAME)(descriptor, data, size, place);           \
  }
  COROTET_PWRITE(pwrite)
  COROTET_PWRITE(pwrite64)

#define COROTET_FTRUNCATE(NAME)                     \
  int NAME(int descriptor, off_t size) noexcept     \
  {                                                 \
    if (is_chosen(descriptor) && fails(ENOSPC))     \
      return -1;                                    \
    return original(NAME, #NAME)(descriptor, size); \
  }
  COROTET_FTRUNCATE(ftruncate)
  COROTET_FTRUNCATE(ftruncate64)

  // The file is closed also if the operation fails.
  int
  close(int descriptor)
  {
    const bool chosen = is_chosen(descriptor);
    if (chosen)
      is_watched[descriptor] = false;
    const int result = original(close, "close")(descriptor);
    return chosen && fails(ENOSPC) ? -1 : result;
  }

  int
  fclose(std::FILE *file)
  {
    const int  descriptor = fileno(file);
    const bool chosen     = is_chosen(descriptor);
    if (chosen)
      is_watched[descriptor] = false;
    const int result = original(fclose, "fclose")(file);
    return chosen && fails(ENOSPC) ? EOF : result;
  }

#define COROTET_SYNC(NAME)                    \
  int NAME(int descriptor)                    \
  {                                           \
    if (is_chosen(descriptor) && fails(EIO))  \
      return -1;                              \
    return original(NAME, #NAME)(descriptor); \
  }
  COROTET_SYNC(fsync)

  // With "no locks" locks fail as on file systems without them.
  int
  flock(int descriptor, int operation) noexcept
  {
    if (is_chosen(descriptor) && has_mode("no locks"))
      {
        errno = ENOLCK;
        return -1;
      }
    return original(flock, "flock")(descriptor, operation);
  }

  int
  syncfs(int descriptor) noexcept
  {
    if (is_chosen(descriptor) && fails(EIO))
      return -1;
    return original(syncfs, "syncfs")(descriptor);
  }

#define COROTET_REMOVE(NAME)              \
  int NAME(const char *path) noexcept     \
  {                                       \
    if (is_chosen(path) && fails(EACCES)) \
      return -1;                          \
    return original(NAME, #NAME)(path);   \
  }
  COROTET_REMOVE(unlink)
  COROTET_REMOVE(remove)

  // glibc's own function is used, as dlsym() itself allocates memory.
  void *
  __libc_malloc(size_t size);

  // operator new and deal.II's vectors call these functions.
  void *
  malloc(size_t size)
  {
    if (size >= 16384 && has_begun && is_its_turn(++n_operations))
      {
        errno = ENOMEM;
        return nullptr;
      }
    return __libc_malloc(size);
  }

  int
  posix_memalign(void **result, size_t alignment, size_t size) noexcept
  {
    if (size >= 16384 && has_begun && is_its_turn(++n_operations))
      return ENOMEM;
    return original(posix_memalign, "posix_memalign")(result, alignment, size);
  }

  int
  rename(const char *from, const char *to) noexcept
  {
    if (is_chosen(to) && fails(EACCES))
      return -1;
    return original(rename, "rename")(from, to);
  }

  int
  mkdir(const char *path, mode_t mode) noexcept
  {
    if (is_chosen(path) && fails(EACCES))
      return -1;
    return original(mkdir, "mkdir")(path, mode);
  }
}
