// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "page_of_run.h"

#include <corotet/base/programs.h>

#include <cstdlib>

namespace corotet
{
  std::string
  command_for_page(const std::string &directory)
  {
    const char *const toolchain = std::getenv("COROTET_TOOLCHAIN");
    const bool        is_named  = toolchain != nullptr && *toolchain != '\0';
    return (is_named ? toolchain + std::string(" ") : "") + "scripts/report " +
           directory;
  }

  bool
  write_page_of_run(const std::string &directory)
  {
    const std::string script = find_installed("share/corotet/scripts/report");
    if (script.empty())
      return false;
    constexpr double hour = 3600;
    const ProgramEnd end  = run_for_output(script, {directory}, hour);
    return end.status == 0 && end.signal == 0 && !end.has_exceeded;
  }
} // namespace corotet
