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
    const char *const toolchain = std::getenv("COROTET_TOOLCHAIN");
    const bool        is_named  = toolchain != nullptr && *toolchain != '\0';
    // In a build it is the script of the sources, beside the toolchain.
    const std::string path = "scripts/report";
    std::string       script =
      is_named ?
              (std::filesystem::path(toolchain).parent_path() / "report").string() :
              path;
    const std::string found = find_installed("share/corotet/" + path);
    if (!found.empty() && find_installed("CMakeCache.txt").empty())
      script = found;
    return (is_named ? shell_word(toolchain) + " " : "") + shell_word(script) +
           " " + shell_word(as_argument(directory));
  }
} // namespace corotet
