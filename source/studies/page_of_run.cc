// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "page_of_run.h"

#include <corotet/base/programs.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace corotet
{
  namespace
  {
    // A text as a shell takes it for one word.
    std::string
    shell_word(const std::string &text)
    {
      const bool is_plain =
        std::all_of(text.begin(), text.end(), [](const unsigned char c) {
          return std::isalnum(c) != 0 || c >= 0x80 ||
                 std::strchr("_-+=./:,@%", c) != nullptr;
        });
      if (is_plain && !text.empty())
        return text;
      std::string result = "'";
      for (const char c : text)
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
      return result + "'";
    }
  } // namespace

  std::string
  command_for_page(const std::string &directory)
  {
    namespace fs                = std::filesystem;
    const char *const variable  = std::getenv("COROTET_TOOLCHAIN");
    std::string       toolchain = variable != nullptr ? variable : "";
    // In a build it is the script of the sources, beside the toolchain.
    std::string    script = "scripts/report";
    const fs::path beside = fs::path(toolchain).parent_path() / "report";
    if (const std::string found = find_installed("share/corotet/" + script);
        !found.empty() && find_installed("CMakeCache.txt").empty())
      script = shell_word(found);
    else if (!toolchain.empty() && fs::is_regular_file(beside))
      {
        script    = shell_word(beside.string());
        toolchain = shell_word(toolchain);
      }
    return (toolchain.empty() ? "" : toolchain + " ") + script + " " +
           shell_word(as_argument(directory));
  }
} // namespace corotet
