// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

#include "surface_lines.h"

namespace corotet::surface_files
{
  namespace
  {
    // A binary file has a header, the number of triangles, and for each
    // triangle its normal, its corners and two further bytes.
    constexpr std::size_t header = 80, triangle_size = 50;



    void
    read_binary(const std::string &bytes, TriangleSurface &surface)
    {
      std::uint32_t n = 0;
      std::memcpy(&n, bytes.data() + header, 4);
      surface.names.emplace_back();
      surface.vertices.reserve(3 * std::size_t(n));
      surface.triangles.reserve(n);
      for (std::size_t t = 0; t < n; ++t)
        {
          float x[9];
          std::memcpy(x,
                      bytes.data() + header + 4 + t * triangle_size + 12,
                      sizeof(x));
          std::vector<unsigned int> corners;
          for (unsigned int i = 0; i < 9; i += 3)
            {
              if (!std::isfinite(x[i]) || !std::isfinite(x[i + 1]) ||
                  !std::isfinite(x[i + 2]))
                throw InputError("",
                                 fmt::format("{}: triangle {} of {} has a "
                                             "corner that is no point: found "
                                             "{}, {}, {}",
                                             surface.origin,
                                             t + 1,
                                             n,
                                             x[i],
                                             x[i + 1],
                                             x[i + 2]));
              corners.push_back(surface.vertices.size());
              surface.vertices.emplace_back(x[i], x[i + 1], x[i + 2]);
            }
          add_polygon(surface, corners, 0);
        }
    }



    class AsciiReader
    {
    public:
      AsciiReader(const std::string &bytes, TriangleSurface &surface)
        : lines(surface.origin, bytes)
        , surface(surface)
      {}

      void
      read()
      {
        while (lines.next(0))
          {
            expect("solid");
            const std::string name = lines.rest();
            const auto [group, is_new] =
              groups.emplace(name, surface.names.size());
            if (is_new)
              surface.names.push_back(name.empty() ?
                                        std::vector<std::string>() :
                                        std::vector<std::string>{name});
            read_solid(group->second);
          }
      }

    private:
      Lines                               lines;
      TriangleSurface                    &surface;
      std::map<std::string, unsigned int> groups;

      bool
      is(const std::size_t i, const std::string_view word) const
      {
        return i < lines.words().size() &&
               upper_case(lines.words()[i]) == upper_case(word);
      }

      void
      expect(const std::string &word) const
      {
        if (!is(0, word))
          lines.refuse(fmt::format("'{}' is expected: found '{}'",
                                   word,
                                   shortened(std::string(lines.words()[0]))));
      }

      void
      next(const std::string &word)
      {
        if (!lines.next(0))
          lines.refuse_end("'" + word + "'");
        expect(word);
      }

      void
      read_solid(const unsigned int group)
      {
        while (true)
          {
            if (!lines.next(0))
              lines.refuse_end("'endsolid'");
            if (is(0, "endsolid") || (is(0, "end") && is(1, "solid")))
              return;
            expect("facet");
            next("outer");
            std::vector<unsigned int> corners;
            for (unsigned int i = 0; i < 3; ++i)
              {
                next("vertex");
                corners.push_back(surface.vertices.size());
                surface.vertices.push_back(lines.point(1));
              }
            next("endloop");
            next("endfacet");
            check_number_of_vertices(surface);
            add_polygon(surface, corners, group);
          }
      }
    };
  } // namespace



  void
  read_stl(const std::string &bytes, TriangleSurface &surface)
  {
    // Binary files may begin with "solid", too; only their size distinguishes
    // them.
    std::uint32_t n = 0;
    if (bytes.size() >= header + 4)
      std::memcpy(&n, bytes.data() + header, 4);
    const std::size_t size      = header + 4 + triangle_size * std::size_t(n);
    const std::size_t begin     = bytes.find_first_not_of(" \t\r\n");
    const bool        has_solid = begin != std::string::npos &&
                           upper_case(bytes.substr(begin, 5)) == "SOLID";
    // Text has no zero bytes.
    const bool is_text = has_solid && bytes.find('\0') == std::string::npos &&
                         bytes.size() != size;
    if (is_text)
      AsciiReader(bytes, surface).read();
    else if (bytes.size() == size)
      {
        check_number_of_vertices(surface, 3 * std::size_t(n));
        read_binary(bytes, surface);
      }
    else
      throw InputError(
        "",
        bytes.size() < header + 4 ?
          fmt::format("{}: a binary STL file has at least {} bytes: found {}",
                      surface.origin,
                      header + 4,
                      bytes.size()) :
          fmt::format("{}: a binary STL file with {} triangles has {} bytes: "
                      "found {}{}",
                      surface.origin,
                      n,
                      size,
                      bytes.size(),
                      bytes.size() < size ? ": is the rest missing?" : ""));
  }
} // namespace corotet::surface_files
