// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/mesh_readers.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <set>

namespace corotet
{
  namespace
  {
    // The text between @p before and @p after; empty if these are missing.
    std::string
    between(const std::string &text,
            const std::string &before,
            const std::string &after)
    {
      const std::size_t begin = text.find(before);
      if (begin == std::string::npos)
        return "";
      const std::size_t first = begin + before.size();
      const std::size_t end   = text.find(after, first);
      return end == std::string::npos ? "" : text.substr(first, end - first);
    }
  } // namespace



  std::string
  other_length_unit(const std::string &path)
  {
    std::ifstream stream(path, std::ios::binary);
    if (!stream)
      throw MachineError(path + ": cannot be read (permission?)");
    // Units by prefixes of the metre, and other units, which are defined by
    // these.
    std::set<std::string> units, converted;
    for (std::string instance; std::getline(stream, instance, ';');)
      {
        if (instance.find("LENGTH_UNIT") == std::string::npos)
          continue;
        std::erase_if(instance, [](const unsigned char c) {
          return std::isspace(c) != 0;
        });
        instance = upper_case(instance);
        if (instance.find("LENGTH_UNIT()") == std::string::npos)
          continue;
        std::string name = between(instance, "CONVERSION_BASED_UNIT('", "'");
        if (!name.empty())
          converted.insert(name);
        else if (name = between(instance, "SI_UNIT(", ",.METRE.)");
                 !name.empty())
          {
            std::erase_if(name,
                          [](const char c) { return c == '.' || c == '$'; });
            units.insert(name + "METRE");
          }
      }
    if (!converted.empty())
      units = converted;
    units.erase("MILLIMETRE");
    std::string result = join({units.begin(), units.end()});
    for (char &c : result)
      c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return shortened(result, 40);
  }
} // namespace corotet
