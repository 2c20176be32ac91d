// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "surface_lines.h"

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>

namespace corotet::surface_files
{
  namespace
  {
    constexpr std::string_view blanks = " \t\r\v\f";

    // Reads a word as a whole number; returns whether it is one.
    bool
    parse(std::string_view word, long long &number)
    {
      // Some programs write a plus sign.
      if (word.size() > 1 && word[0] == '+')
        word.remove_prefix(1);
      const auto [end, error] =
        std::from_chars(word.data(), word.data() + word.size(), number);
      return error == std::errc() && end == word.data() + word.size();
    }



    // A polygon in its plane; areas are twice those of triangles, positive if
    // these turn as the polygon does.
    class FlatPolygon
    {
    public:
      FlatPolygon(const TriangleSurface           &surface,
                  const std::vector<unsigned int> &corners)
      {
        dealii::Tensor<1, 3> normal;
        for (std::size_t i = 2; i < corners.size(); ++i)
          normal += dealii::cross_product_3d(surface.vertices[corners[i - 1]] -
                                               surface.vertices[corners[0]],
                                             surface.vertices[corners[i]] -
                                               surface.vertices[corners[0]]);
        unsigned int axis = 0;
        for (unsigned int d = 1; d < 3; ++d)
          if (std::abs(normal[d]) > std::abs(normal[axis]))
            axis = d;
        const unsigned int a = (axis + 1) % 3, b = (axis + 2) % 3;
        for (const unsigned int v : corners)
          points.push_back({{surface.vertices[v][normal[axis] < 0 ? b : a],
                             surface.vertices[v][normal[axis] < 0 ? a : b]}});
      }

      double
      area(const std::size_t i, const std::size_t j, const std::size_t k) const
      {
        const auto &[x, y] = points[i];
        return (points[j][0] - x) * (points[k][1] - y) -
               (points[j][1] - y) * (points[k][0] - x);
      }

      bool
      is_convex() const
      {
        const std::size_t n = points.size();
        for (std::size_t i = 0; i < n; ++i)
          if (area(i, (i + 1) % n, (i + 2) % n) < 0)
            return false;
        return true;
      }

      // Whether the triangle of three consecutive corners among those left is
      // inside of the polygon.
      bool
      is_ear(const std::vector<std::size_t> &left,
             const std::size_t               i,
             const std::size_t               j,
             const std::size_t               k) const
      {
        return area(i, j, k) > 0 &&
               std::none_of(left.begin(), left.end(), [&](const auto p) {
                 return points[p] != points[i] && points[p] != points[j] &&
                        points[p] != points[k] && area(i, j, p) >= 0 &&
                        area(j, k, p) >= 0 && area(k, i, p) >= 0;
               });
      }

    private:
      std::vector<std::array<double, 2>> points;
    };



    // Divides a polygon into triangles, given by its corners: triangles that
    // share the first corner or, if it is not convex, ears that are cut off one
    // by one.
    std::vector<std::array<std::size_t, 3>>
    triangles_of(const FlatPolygon &polygon, const std::size_t n)
    {
      // The largest number of corners: cutting takes its cube at worst.
      constexpr std::size_t                   most = 1000;
      std::vector<std::array<std::size_t, 3>> result;
      std::vector<std::size_t>                left(n);
      std::iota(left.begin(), left.end(), std::size_t(0));
      const bool has_ears = n > 3 && n <= most && !polygon.is_convex();
      for (bool is_cut = has_ears; is_cut && left.size() > 3;)
        {
          is_cut = false;
          for (std::size_t i = 0; i < left.size() && !is_cut; ++i)
            {
              const std::size_t m      = left.size();
              const std::size_t before = left[(i + m - 1) % m], own = left[i],
                                next = left[(i + 1) % m];
              if (!polygon.is_ear(left, before, own, next))
                continue;
              result.push_back({{before, own, next}});
              left.erase(left.begin() + i);
              is_cut = true;
            }
        }
      for (std::size_t i = 2; i < left.size(); ++i)
        result.push_back({{left[0], left[i - 1], left[i]}});
      return result;
    }
  } // namespace



  Lines::Lines(const std::string &path, const std::string &bytes)
    : path(path)
    , bytes(bytes)
  {}



  bool
  Lines::next(const char comment)
  {
    while (begin_of_next < bytes.size())
      {
        const std::size_t end =
          std::min(bytes.find('\n', begin_of_next), bytes.size());
        line =
          std::string_view(bytes).substr(begin_of_next, end - begin_of_next);
        begin_of_next = std::min(end + 1, bytes.size());
        ++line_number;
        if (comment != 0)
          line = line.substr(0, line.find(comment));
        present.clear();
        for (std::size_t i = 0; i < line.size();)
          {
            const std::size_t begin = line.find_first_not_of(blanks, i);
            if (begin == std::string_view::npos)
              break;
            i = std::min(line.find_first_of(blanks, begin), line.size());
            present.push_back(line.substr(begin, i - begin));
          }
        if (!present.empty())
          return true;
      }
    return false;
  }



  std::string
  Lines::rest() const
  {
    if (present.size() < 2)
      return "";
    const char *const begin = present[1].data();
    return {begin, present.back().data() + present.back().size()};
  }



  double
  Lines::number(const std::size_t i) const
  {
    if (i >= present.size())
      refuse(fmt::format("a number is missing after '{}'",
                         shortened(std::string(line), 40)));
    const auto result = parse_number(present[i]);
    if (!result)
      refuse(fmt::format("a number is expected: found '{}'",
                         shortened(std::string(present[i]), 40)));
    return *result;
  }



  long long
  Lines::integer(const std::size_t i) const
  {
    long long result = 0;
    if (i >= present.size())
      refuse("a whole number is missing at the end of the line");
    if (!parse(present[i], result))
      refuse(fmt::format("a whole number is expected: found '{}'",
                         shortened(std::string(present[i]), 40)));
    return result;
  }



  dealii::Point<3>
  Lines::point(const std::size_t i) const
  {
    return {number(i), number(i + 1), number(i + 2)};
  }



  void
  Lines::refuse(const std::string &message) const
  {
    throw InputError("", fmt::format("{}:{}: {}", path, line_number, message));
  }



  void
  Lines::refuse_end(const std::string &what) const
  {
    throw InputError(
      "",
      fmt::format("{}: the file ends before {}: is the rest missing?",
                  path,
                  what));
  }



  void
  add_polygon(TriangleSurface                 &surface,
              const std::vector<unsigned int> &corners,
              const unsigned int               group)
  {
    const FlatPolygon polygon(surface, corners);
    for (const auto &[i, j, k] : triangles_of(polygon, corners.size()))
      {
        surface.triangles.push_back({{corners[i], corners[j], corners[k]}});
        surface.groups.push_back(group);
      }
  }



  void
  check_number_of_vertices(const TriangleSurface &surface,
                           const std::size_t      more)
  {
    // STL files have three vertices for each triangle.
    constexpr std::size_t most = 2'000'000'000;
    if (surface.vertices.size() + more > most)
      throw InputError("",
                       fmt::format("{}: too many vertices: found more than {}",
                                   surface.origin,
                                   most));
  }
} // namespace corotet::surface_files
