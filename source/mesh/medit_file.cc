// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// What gmsh does not say about files of Medit.

#include <corotet/base/exceptions.h>
#include <corotet/mesh/mesh_readers.h>

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "abaqus_lines.h"

namespace corotet
{
  namespace
  {
    // Goes through a file, word for word.
    class MeditCheck
    {
    public:
      explicit MeditCheck(const std::string &path)
        : place{path, 0}
      {
        std::ifstream file(path);
        if (!file)
          throw MachineError(path + ": cannot be read (permission?)");
        for (std::string line; is_readable && std::getline(file, line);)
          {
            ++place.line;
            std::istringstream words(line.substr(0, line.find('#')));
            for (std::string word; is_readable && words >> word;)
              read(word);
          }
      }

    private:
      // What is no number is for gmsh to refuse.
      void
      read(const std::string &word)
      {
        // Nodes and the reference.
        static const std::map<std::string, std::int64_t> lengths{
          {"Triangles", 4},
          {"TrianglesP2", 7},
          {"Tetrahedra", 5},
          {"TetrahedraP2", 11},
          {"Prisms", 7},
          {"Pyramids", 6}};
        if (is_count)
          {
            const auto n = abaqus::whole_number(word);
            is_count     = false;
            is_readable  = n && *n >= 0 && *n < 1'000'000'000'000;
            n_left       = is_readable ? *n * length : 0;
            if (n_left > 0 && (keyword == "Prisms" || keyword == "Pyramids"))
              place.refuse(fmt::format("cells other than tetrahedra: found {} "
                                       "{}; allowed are Tetrahedra",
                                       *n,
                                       keyword));
          }
        else if (n_left > 0)
          {
            const auto number = abaqus::whole_number(word);
            is_readable       = number.has_value();
            --n_left;
            if (number && n_left % length == 0 && *number < 0)
              place.refuse(fmt::format("a reference in {}: found {}; allowed "
                                       "are 0 and more",
                                       keyword,
                                       *number));
          }
        else if (const auto found = lengths.find(word); found != lengths.end())
          {
            keyword  = word;
            length   = found->second;
            is_count = true;
          }
      }

      abaqus::Place place;
      std::string   keyword;
      std::int64_t  length = 0, n_left = 0;
      bool          is_count = false, is_readable = true;
    };
  } // namespace



  void
  check_medit(const std::string &path)
  {
    const MeditCheck check(path);
  }
} // namespace corotet
