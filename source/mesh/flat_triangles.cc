// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/mesh/check_mesh.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mending.h"

namespace corotet::mending
{
  namespace
  {
    using dealii::Point;
    using Triangle = TriangleSurface::Triangle;



    double
    height(const TriangleSurface &surface, const Triangle &triangle)
    {
      double         longest = 0;
      const Point<3> a       = surface.vertices[triangle[0]],
                     b       = surface.vertices[triangle[1]],
                     c       = surface.vertices[triangle[2]];
      longest = std::max({a.distance(b), b.distance(c), c.distance(a)});
      return dealii::cross_product_3d(b - a, c - a).norm() / longest;
    }



    // The corner between the two shorter edges of a triangle.
    unsigned int
    blunt_corner(const TriangleSurface &surface, const Triangle &triangle)
    {
      unsigned int result  = 0;
      double       longest = -1;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double length =
            surface.vertices[triangle[(i + 1) % 3]].distance(
              surface.vertices[triangle[(i + 2) % 3]]);
          if (length > longest)
            {
              longest = length;
              result  = i;
            }
        }
      return result;
    }
  } // namespace



  void
  refuse(const TriangleSurface &surface, const std::string &message)
  {
    throw InputError("", surface.origin + ": " + message);
  }



  double
  resolution(const TriangleSurface &surface)
  {
    double largest = 0;
    for (const Point<3> &x : surface.vertices)
      for (unsigned int d = 0; d < 3; ++d)
        largest = std::max(largest, std::abs(x[d]));
    return 2 * std::numeric_limits<float>::epsilon() * largest;
  }



  std::size_t
  divide_at_flat_triangles(TriangleSurface &surface)
  {
    const double              least  = resolution(surface);
    std::size_t               n_gone = 0;
    std::vector<unsigned int> flat;
    for (unsigned int t = 0; t < surface.triangles.size(); ++t)
      if (height(surface, surface.triangles[t]) <= least)
        flat.push_back(t);
    if (flat.empty())
      return 0;
    std::map<std::pair<unsigned int, unsigned int>, std::vector<unsigned int>>
               of_edge;
    const auto edge = [](const unsigned int a, const unsigned int b) {
      return std::pair(std::min(a, b), std::max(a, b));
    };
    const auto change_edges = [&](const unsigned int t, const bool add) {
      const Triangle &triangle = surface.triangles[t];
      for (unsigned int i = 0; i < 3; ++i)
        {
          auto &around = of_edge[edge(triangle[i], triangle[(i + 1) % 3])];
          if (add)
            around.push_back(t);
          else
            std::erase(around, t);
        }
    };
    for (unsigned int t = 0; t < surface.triangles.size(); ++t)
      change_edges(t, true);
    // Each turn of an edge makes two triangles of two. Several flat triangles
    // in a row need one turn each, and a few more where they are stacked.
    for (unsigned int round = 0; round < 10 && !flat.empty(); ++round)
      {
        std::vector<unsigned int> next;
        for (const unsigned int t : flat)
          {
            if (height(surface, surface.triangles[t]) > least)
              continue;
            const unsigned int i = blunt_corner(surface, surface.triangles[t]);
            const unsigned int c = surface.triangles[t][i];
            const unsigned int a = surface.triangles[t][(i + 1) % 3];
            const unsigned int b = surface.triangles[t][(i + 2) % 3];
            const auto        &around = of_edge[edge(a, b)];
            if (around.size() != 2)
              continue;
            const unsigned int other = around[0] == t ? around[1] : around[0];
            unsigned int       k     = 0;
            while (surface.triangles[other][k] == a ||
                   surface.triangles[other][k] == b)
              ++k;
            const unsigned int d = surface.triangles[other][k];
            // The other corners of the neighbour, in its own order.
            const unsigned int from = surface.triangles[other][(k + 1) % 3];
            const unsigned int to   = surface.triangles[other][(k + 2) % 3];
            if (c == d || !of_edge[edge(c, d)].empty())
              continue;
            change_edges(t, false);
            change_edges(other, false);
            surface.triangles[t]     = {{d, from, c}};
            surface.triangles[other] = {{d, c, to}};
            surface.groups[t]        = surface.groups[other];
            change_edges(t, true);
            change_edges(other, true);
            ++n_gone;
            next.push_back(t);
            next.push_back(other);
          }
        flat = next;
      }
    return n_gone;
  }



  void
  check_areas(const TriangleSurface &surface)
  {
    const double least = resolution(surface) / 4;
    std::size_t  n     = 0;
    Point<3>     first;
    for (const Triangle &triangle : surface.triangles)
      if (height(surface, triangle) <= least && n++ == 0)
        first = surface.vertices[triangle[0]];
    if (n > 0)
      refuse(surface,
             fmt::format("found {} triangle{} without area, the first at {}; "
                         "mend the surface in the program that it is from",
                         n,
                         n > 1 ? "s" : "",
                         position(first)));
  }
} // namespace corotet::mending
