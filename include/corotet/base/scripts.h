// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_scripts_h
#define corotet_base_scripts_h

#include <optional>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * Path of a script that belongs to the library: share/corotet/scripts/@p name
   * in the nearest folder above the running program, or else above the file
   * that this code is in (the shared library), that has it. So it is found
   * wherever the installation, or the folder of the build, was moved to. Empty
   * if there is none.
   */
  std::string
  find_script(const std::string &name);

  /**
   * Runs the program at @p path with @p arguments, without a shell, and waits
   * for its end. Returns its exit status; nothing if it could not be started or
   * was ended by a signal.
   */
  std::optional<int>
  run_and_wait(const std::string              &path,
               const std::vector<std::string> &arguments);
} // namespace corotet

#endif
