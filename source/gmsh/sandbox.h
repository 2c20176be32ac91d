// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_gmsh_sandbox_h
#define corotet_gmsh_sandbox_h

#include <cstdint>
#include <string>
#include <vector>

namespace corotet::gmsh_program
{
  /**
   * From here on this process cannot start programs, write files, or read other
   * files and folders than @p readable, if the kernel has Landlock (Linux 5.13
   * and newer, https://docs.kernel.org/userspace-api/landlock.html); otherwise
   * it still cannot fill a file. It may use @p max_memory [byte] in addition to
   * its present memory, and it ends with the process that has started it.
   * Throws std::runtime_error if the kernel refuses.
   */
  void
  confine(const std::vector<std::string> &readable,
          const std::uint64_t             max_memory);
} // namespace corotet::gmsh_program

#endif
