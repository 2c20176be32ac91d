// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>

#include "surface_lines.h"

namespace corotet::surface_files
{
  namespace
  {
    /// OBJ, of Wavefront: vertices and polygons, which have names.
    class ObjReader
    {
    public:
      ObjReader(const std::string &bytes, TriangleSurface &surface)
        : lines(surface.origin, bytes)
        , surface(surface)
      {}

      void
      read()
      {
        while (lines.next())
          {
            const std::string_view keyword = lines.words()[0];
            if (keyword == "v")
              {
                surface.vertices.push_back(lines.point(1));
                check_number_of_vertices(surface);
              }
            else if (keyword == "f")
              read_face();
            else if (keyword == "o")
              object = lines.rest();
            else if (keyword == "g")
              group = lines.rest();
            else if (keyword == "usemtl")
              material = lines.rest();
            else if (std::find(skipped.begin(), skipped.end(), keyword) ==
                     skipped.end())
              lines.refuse(
                fmt::format("the keyword is unknown or means a shape that is "
                            "not read: found '{}'; allowed are v, f, o, g, "
                            "usemtl, and such that mean nothing here",
                            shortened(std::string(keyword), 40)));
          }
      }

    private:
      // Keywords of texture coordinates, normals, points, lines, smoothing and
      // materials.
      static inline const std::vector<std::string>
        skipped{"vt", "vn", "vp", "p", "l", "s", "mg", "mtllib"};

      Lines                                            lines;
      TriangleSurface                                 &surface;
      std::string                                      object, group, material;
      std::map<std::vector<std::string>, unsigned int> groups;

      unsigned int
      present_group()
      {
        std::vector<std::string> names;
        for (const std::string &name : {object, group, material})
          // Programs write "default" and "off" if there is no name.
          if (!name.empty() && name != "default" && name != "off" &&
              std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
        const auto [found, is_new] = groups.emplace(names, groups.size());
        if (is_new)
          surface.names.push_back(names);
        return found->second;
      }

      void
      read_face()
      {
        if (lines.words().size() < 4)
          lines.refuse(fmt::format("a face has three corners or more: found {}",
                                   lines.words().size() - 1));
        std::vector<unsigned int> corners;
        for (std::size_t i = 1; i < lines.words().size(); ++i)
          corners.push_back(corner(lines.words()[i]));
        add_polygon(surface, corners, present_group());
      }

      // The vertex of a corner "vertex/texture/normal": numbers count from 1,
      // or backwards from -1.
      unsigned int
      corner(const std::string_view word) const
      {
        const std::string text(word.substr(0, word.find('/')));
        const auto        n   = static_cast<long long>(surface.vertices.size());
        char             *end = nullptr;
        const long long   number = std::strtoll(text.c_str(), &end, 10);
        const long long   index  = number < 0 ? n + number : number - 1;
        if (text.empty() || *end != '\0' || index < 0 || index >= n)
          lines.refuse(
            n == 0 ? fmt::format("found the vertex '{}' before any vertices; "
                                 "they must come before what they belong to",
                                 shortened(std::string(word), 40)) :
                     fmt::format("no such vertex: found '{}'; allowed are 1 to "
                                 "{} and -1 to -{}",
                                 shortened(std::string(word), 40),
                                 n,
                                 n));
        return static_cast<unsigned int>(index);
      }
    };
  } // namespace



  void
  read_obj(const std::string &bytes, TriangleSurface &surface)
  {
    ObjReader(bytes, surface).read();
  }



  void
  read_off(const std::string &bytes, TriangleSurface &surface)
  {
    Lines lines(surface.origin, bytes);
    // Colours and normals may follow the coordinates.
    const std::vector<std::string> keywords{"OFF", "COFF", "NOFF", "CNOFF"};
    if (!lines.next())
      lines.refuse_end("the first of its lines");
    const std::string keyword(lines.words()[0]);
    if (std::find(keywords.begin(), keywords.end(), keyword) == keywords.end())
      lines.refuse(fmt::format("the first word is unknown: found '{}'; allowed "
                               "are {}",
                               shortened(keyword, 40),
                               join(keywords)));
    // The numbers of vertices and faces may be on the same line.
    std::size_t i = 1;
    if (lines.words().size() > 1 && lines.words()[1] == "BINARY")
      lines.refuse("binary files are not read; allowed is text");
    if (lines.words().size() == 1)
      {
        i = 0;
        if (!lines.next())
          lines.refuse_end("its number of vertices");
      }
    const long long n_vertices = lines.integer(i),
                    n_faces    = lines.integer(i + 1);
    surface.names.emplace_back();
    for (long long v = 0; v < n_vertices; ++v)
      {
        if (!lines.next())
          lines.refuse_end(fmt::format("vertex {} of {}", v + 1, n_vertices));
        surface.vertices.push_back(lines.point(0));
        check_number_of_vertices(surface);
      }
    for (long long face = 0; face < n_faces; ++face)
      {
        if (!lines.next())
          lines.refuse_end(fmt::format("face {} of {}", face + 1, n_faces));
        const long long n = lines.integer(0);
        if (n < 3 || n > 1000)
          lines.refuse(
            fmt::format("a face has 3 to 1000 corners: found {}", n));
        std::vector<unsigned int> corners;
        for (long long k = 1; k <= n; ++k)
          {
            const long long corner = lines.integer(k);
            if (corner < 0 || corner >= n_vertices)
              lines.refuse(fmt::format("no such vertex: found {}; allowed are "
                                       "0 to {}",
                                       corner,
                                       n_vertices - 1));
            corners.push_back(static_cast<unsigned int>(corner));
          }
        add_polygon(surface, corners, 0);
      }
  }
} // namespace corotet::surface_files
