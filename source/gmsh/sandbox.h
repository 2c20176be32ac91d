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
   * From here on this process cannot start programs, write files, or read
   * others than @p readable (files and folders), where the kernel has Landlock
   * (Linux 5.13 and newer,
   * https://docs.kernel.org/userspace-api/landlock.html); elsewhere it can
   * still not fill a file. Its memory is limited to
   * @p max_memory [byte] more than it has, and it ends with the process that
   * has started it. Throws std::runtime_error if the kernel refuses.
   */
  void
  confine(const std::vector<std::string> &readable,
          const std::uint64_t             max_memory);
} // namespace corotet::gmsh_program

#endif
