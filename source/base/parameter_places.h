// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_parameter_places_h
#define corotet_base_parameter_places_h

#include <corotet/base/parameter_trees.h>
#include <corotet/base/text.h>

#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The lines of the entries and sections of a .json or .xml file.
   */
  struct Places
  {
    std::string
    of(const std::string &name) const
    {
      const auto line = lines.find(name);
      return line == lines.end() ? file :
                                   fmt::format("{}:{}", file, line->second);
    }

    // @p names: the names of all sections on the path, then the entry's.
    void
    add(const std::vector<std::string> &names, const std::size_t line)
    {
      std::size_t length = 0;
      for (const std::string &name : names)
        length += name.size() + 1;
      // Longer paths are refused elsewhere.
      if (length <= max_path_length + 1)
        lines[join(names, "/")] = line;
    }

    std::string file;
    // Line numbers by "Section/Entry".
    std::map<std::string, std::size_t> lines;
  };
} // namespace corotet

#endif
