// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/triangle_surface.h>

#include <deal.II/numerics/rtree.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "mending.h"

namespace corotet
{
  using mending::refuse;

  namespace
  {
    using dealii::Point;
    using Triangle = TriangleSurface::Triangle;



    // Removes the triangles that @p keep rejects. Returns their number.
    template <typename Keep>
    std::size_t
    keep_triangles(TriangleSurface &surface, const Keep &keep)
    {
      std::size_t n = 0;
      for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        if (keep(surface.triangles[t]))
          {
            surface.triangles[n] = surface.triangles[t];
            surface.groups[n]    = surface.groups[t];
            ++n;
          }
      const std::size_t n_gone = surface.triangles.size() - n;
      surface.triangles.resize(n);
      surface.groups.resize(n);
      return n_gone;
    }



    // For each vertex, the first vertex with the same coordinates.
    std::vector<unsigned int>
    equal_vertices(const std::vector<Point<3>> &vertices)
    {
      std::vector<unsigned int> order(vertices.size()), first(vertices.size());
      for (unsigned int v = 0; v < order.size(); ++v)
        order[v] = v;
      const auto less = [&](const unsigned int a, const unsigned int b) {
        for (unsigned int d = 0; d < 3; ++d)
          if (vertices[a][d] != vertices[b][d])
            return vertices[a][d] < vertices[b][d];
        return a < b;
      };
      std::sort(order.begin(), order.end(), less);
      for (std::size_t i = 0; i < order.size(); ++i)
        first[order[i]] =
          i > 0 && vertices[order[i]] == vertices[order[i - 1]] ?
            first[order[i - 1]] :
            order[i];
      return first;
    }



    // Replaces vertices at the same place by the first of them, and removes
    // unused ones. Returns how many were near another vertex, but not equal to
    // it.
    std::size_t
    merge_vertices(TriangleSurface &surface)
    {
      std::vector<unsigned int> first = equal_vertices(surface.vertices);
      // Finds vertices that differ but are near each other.
      const double near = mending::resolution(surface);
      std::vector<std::pair<Point<3>, unsigned int>> points;
      for (unsigned int v = 0; v < first.size(); ++v)
        if (first[v] == v)
          points.emplace_back(surface.vertices[v], v);
      std::size_t n_near = 0;
      const auto  tree   = dealii::pack_rtree(points);
      std::vector<std::pair<Point<3>, unsigned int>> found;
      for (const auto &[x, v] : points)
        {
          dealii::BoundingBox<3> box(x);
          box.extend(near);
          found.clear();
          tree.query(boost::geometry::index::intersects(box),
                     std::back_inserter(found));
          unsigned int lowest = v;
          for (const auto &[y, w] : found)
            if (y.distance(x) <= near)
              lowest = std::min(lowest, w);
          if (lowest != v)
            ++n_near;
          first[v] = first[lowest];
        }

      constexpr unsigned int    none = std::numeric_limits<unsigned int>::max();
      std::vector<unsigned int> numbers(first.size(), none);
      std::vector<Point<3>>     used;
      for (Triangle &triangle : surface.triangles)
        for (unsigned int &v : triangle)
          {
            const unsigned int merged = first[first[v]];
            if (numbers[merged] == none)
              {
                numbers[merged] = used.size();
                used.push_back(surface.vertices[merged]);
              }
            v = numbers[merged];
          }
      surface.vertices = used;
      return n_near;
    }



    // The edges whose number of triangles is not two.
    struct WrongEdges
    {
      std::size_t n = 0;
      Point<3>    first_place;

      void
      add(const TriangleSurface &surface, const Triangle &edge)
      {
        if (n++ == 0)
          first_place =
            surface.vertices[edge[0]] +
            (surface.vertices[edge[1]] - surface.vertices[edge[0]]) / 2;
      }
    };



    void
    check_edges(const TriangleSurface &surface)
    {
      std::vector<Triangle> halves;
      halves.reserve(3 * surface.triangles.size());
      for (unsigned int t = 0; t < surface.triangles.size(); ++t)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int a = surface.triangles[t][i];
            const unsigned int b = surface.triangles[t][(i + 1) % 3];
            halves.push_back({{std::min(a, b), std::max(a, b), t}});
          }
      std::sort(halves.begin(), halves.end());
      WrongEdges open, branched;
      for (std::size_t begin = 0, end = 0; begin < halves.size(); begin = end)
        {
          while (end < halves.size() && halves[end][0] == halves[begin][0] &&
                 halves[end][1] == halves[begin][1])
            ++end;
          if (end - begin == 1)
            open.add(surface, halves[begin]);
          else if (end - begin > 2)
            branched.add(surface, halves[begin]);
        }
      if (open.n > 0)
        refuse(surface,
               fmt::format("the surface is not closed: found {} edge{} of one "
                           "triangle, the first at {}; every edge must have "
                           "two triangles",
                           open.n,
                           open.n > 1 ? "s" : "",
                           position(open.first_place)));
      if (branched.n > 0)
        refuse(surface,
               fmt::format("the surface branches: found {} edge{} of more than "
                           "two triangles, the first at {}; bodies that touch "
                           "need a surface each, with a gap, or a volume mesh",
                           branched.n,
                           branched.n > 1 ? "s" : "",
                           position(branched.first_place)));
    }



    // Turns triangles so that neighbours face the same way, and closed surfaces
    // outwards. Returns the number of turned triangles.
    std::size_t
    orient(TriangleSurface &surface)
    {
      const std::vector<SurfaceEdge>       edges = surface_edges(surface);
      std::vector<std::array<unsigned, 3>> neighbours(surface.triangles.size());
      std::vector<unsigned int>            n_neighbours(neighbours.size(), 0);
      for (const SurfaceEdge &edge : edges)
        for (const unsigned int i : {0u, 1u})
          {
            const unsigned int t             = edge.triangles[i];
            neighbours[t][n_neighbours[t]++] = edge.triangles[1 - i];
          }
      // Whether two triangles run along a shared edge in the same direction:
      // then one of them must be turned.
      const auto disagree = [&](const Triangle &s, const Triangle &t) {
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            if (s[i] == t[j] && s[(i + 1) % 3] == t[(j + 1) % 3])
              return true;
        return false;
      };
      std::vector<bool> is_done(surface.triangles.size(), false);
      std::size_t       n_turned = 0;
      for (unsigned int seed = 0; seed < surface.triangles.size(); ++seed)
        {
          if (is_done[seed])
            continue;
          std::vector<unsigned int> shell{seed};
          std::size_t               n = 0;
          is_done[seed]               = true;
          for (std::size_t i = 0; i < shell.size(); ++i)
            for (const unsigned int other : neighbours[shell[i]])
              {
                const bool wrong = disagree(surface.triangles[shell[i]],
                                            surface.triangles[other]);
                if (wrong && is_done[other])
                  refuse(surface,
                         fmt::format(
                           "the surface has one side only, like a "
                           "Moebius strip: seen at {}",
                           position(
                             surface.vertices[surface.triangles[other][0]])));
                if (is_done[other])
                  continue;
                is_done[other] = true;
                if (wrong)
                  {
                    ++n;
                    std::swap(surface.triangles[other][1],
                              surface.triangles[other][2]);
                  }
                shell.push_back(other);
              }
          // The volume is computed relative to a corner, so that nothing
          // cancels far from the origin.
          double         volume = 0;
          const Point<3> origin = surface.vertices[surface.triangles[seed][0]];
          for (const unsigned int t : shell)
            {
              const Triangle &s = surface.triangles[t];
              volume +=
                (surface.vertices[s[0]] - origin) *
                dealii::cross_product_3d(surface.vertices[s[1]] - origin,
                                         surface.vertices[s[2]] - origin);
            }
          if (volume < 0)
            for (const unsigned int t : shell)
              std::swap(surface.triangles[t][1], surface.triangles[t][2]);
          // A closed surface that faces inwards as a whole is a hollow and not
          // counted.
          n_turned += std::min(n, shell.size() - n);
        }
      return n_turned;
    }
  } // namespace



  void
  mend_surface(TriangleSurface &surface)
  {
    const auto remark = [&](const std::size_t n, const std::string &what) {
      if (n > 0)
        surface.remarks.push_back(fmt::format("{} {}", n, what));
    };
    remark(merge_vertices(surface),
           "vertices of the surface that lie beside another were merged with "
           "it");
    remark(keep_triangles(surface,
                          [](const Triangle &t) {
                            return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
                          }),
           "triangles of the surface that are no more than an edge were left "
           "out");
    std::set<Triangle> seen;
    remark(keep_triangles(surface,
                          [&](Triangle t) {
                            std::sort(t.begin(), t.end());
                            return seen.insert(t).second;
                          }),
           "further copies of triangles of the surface were left out");
    if (surface.triangles.empty())
      refuse(surface, "all triangles are without area");
    check_edges(surface);
    remark(mending::divide_at_flat_triangles(surface),
           "triangles of the surface without area were given to their "
           "neighbours");
    mending::check_areas(surface);
    remark(
      orient(surface),
      "triangles of the surface were turned over: they faced the other way "
      "than their neighbours");
  }
} // namespace corotet
