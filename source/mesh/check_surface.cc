// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exchange.h>
#include <corotet/mesh/check_surface.h>
#include <corotet/mesh/edges.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace corotet
{
  namespace
  {
    // Points that are closer than this many longest edges coincide: far above
    // round-off, far below the features of any sensible mesh.
    constexpr double face_tolerance = 1e-8;

    double
    longest_edge(const CellSurface &surface, const Triangle &triangle)
    {
      double longest = 0;
      for (unsigned int i = 0; i < 3; ++i)
        longest = std::max(longest,
                           surface.vertices[triangle[i]].distance(
                             surface.vertices[triangle[(i + 1) % 3]]));
      return longest;
    }



    // Whether @p p lies on a triangle, its edges and corners included.
    bool
    lies_on(const dealii::Point<3> &p,
            const CellSurface      &surface,
            const Triangle         &triangle)
    {
      const dealii::Point<3> &origin = surface.vertices[triangle[0]];
      const auto              a      = surface.vertices[triangle[1]] - origin;
      const auto              b      = surface.vertices[triangle[2]] - origin;
      const auto              r      = p - origin;
      const auto              normal = dealii::cross_product_3d(a, b);
      const double            area   = normal.norm();
      if (std::abs(r * normal) >
          face_tolerance * longest_edge(surface, triangle) * area)
        return false;
      // The barycentric coordinates of the projection onto the plane.
      const double s = dealii::cross_product_3d(r, b) * normal / (area * area);
      const double t = dealii::cross_product_3d(a, r) * normal / (area * area);
      return s >= -face_tolerance && t >= -face_tolerance &&
             s + t <= 1 + face_tolerance;
    }



    using BoundingBox = dealii::BoundingBox<3>;
    using SurfaceTree = dealii::RTree<std::pair<BoundingBox, unsigned int>>;

    // The box around a triangle and the points that count as touching it.
    BoundingBox
    box_of(const CellSurface &surface, const Triangle &triangle)
    {
      BoundingBox box(
        std::vector<dealii::Point<3>>{surface.vertices[triangle[0]],
                                      surface.vertices[triangle[1]],
                                      surface.vertices[triangle[2]]});
      box.extend(face_tolerance * longest_edge(surface, triangle));
      return box;
    }



    SurfaceTree
    tree_of(const CellSurface &surface)
    {
      std::vector<std::pair<BoundingBox, unsigned int>> boxes;
      boxes.reserve(surface.triangles.size());
      for (unsigned int t = 0; t < surface.triangles.size(); ++t)
        boxes.emplace_back(box_of(surface, surface.triangles[t]), t);
      return dealii::pack_rtree(boxes);
    }



    // A triangle in a message to another rank.
    struct SentTriangle
    {
      std::array<std::uint64_t, 3>         numbers;
      std::array<std::array<double, 3>, 3> vertices;
    };



    // The lowest and highest coordinates of a box. An empty box meets no other.
    using Extent = std::array<double, 6>;

    Extent
    extent_of(const BoundingBox &box)
    {
      Extent extent;
      for (unsigned int d = 0; d < 3; ++d)
        {
          extent[d]     = box.lower_bound(d);
          extent[3 + d] = box.upper_bound(d);
        }
      return extent;
    }



    bool
    do_meet(const Extent &a, const Extent &b)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (a[d] > b[3 + d] || b[d] > a[3 + d])
          return false;
      return true;
    }



    [[noreturn]] void
    refuse_touching_vertex(const CellSurface &surface,
                           const unsigned int vertex,
                           const Triangle    &triangle,
                           const std::string &origin)
    {
      const dealii::Point<3> &p = surface.vertices[vertex];
      for (const unsigned int corner : triangle)
        if (p.distance(surface.vertices[corner]) <=
            face_tolerance * longest_edge(surface, triangle))
          refuse_mesh(
            origin,
            fmt::format("duplicate nodes: two vertices are at {}; cells that "
                        "meet there must share one (in gmsh: BooleanFragments "
                        "or Coherence)",
                        position(p)));
      refuse_mesh(
        origin,
        fmt::format("hanging node: the vertex at {} lies on a face of a cell "
                    "without being its corner; cells must meet in whole faces "
                    "(in gmsh: BooleanFragments or Coherence)",
                    position(p)));
    }
  } // namespace



  CellSurface
  cell_surface(const MeshCells                                 &mesh,
               const std::vector<std::array<unsigned int, 4>>  &neighbors,
               const unsigned int                               none,
               const std::function<bool(const unsigned int c)> &is_owned,
               const std::function<std::uint64_t(const unsigned int v)> &number)
  {
    constexpr unsigned int    unused = dealii::numbers::invalid_unsigned_int;
    CellSurface               surface;
    std::vector<unsigned int> new_number(mesh.vertices.size(), unused);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int f = 0; f < 4; ++f)
        if (neighbors[c][f] == none && is_owned(c))
          {
            Triangle &triangle = surface.triangles.emplace_back();
            for (unsigned int i = 0; i < 3; ++i)
              {
                const unsigned int v =
                  mesh.cells[c].vertices[corners_of_faces[f][i]];
                if (new_number[v] == unused)
                  {
                    new_number[v] = surface.vertices.size();
                    surface.vertices.push_back(mesh.vertices[v]);
                    surface.vertex_numbers.push_back(number(v));
                  }
                triangle[i] = new_number[v];
              }
          }
    surface.n_own = surface.triangles.size();
    return surface;
  }



  void
  add_triangles_nearby(CellSurface &surface, const MPI_Comm comm)
  {
    namespace MPI = dealii::Utilities::MPI;
    if (MPI::n_mpi_processes(comm) == 1)
      return;
    // Triangles of this rank can be touched only inside of the box around them.
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Extent own{{infinity, infinity, infinity, -infinity, -infinity, -infinity}};
    for (const Triangle &triangle : surface.triangles)
      {
        const Extent extent = extent_of(box_of(surface, triangle));
        for (unsigned int d = 0; d < 3; ++d)
          {
            own[d]     = std::min(own[d], extent[d]);
            own[3 + d] = std::max(own[3 + d], extent[3 + d]);
          }
      }
    const std::vector<Extent> extents = MPI::all_gather(comm, own);

    std::map<unsigned int, std::vector<SentTriangle>> sent;
    for (unsigned int rank = 0; rank < extents.size(); ++rank)
      if (rank != MPI::this_mpi_process(comm) && do_meet(own, extents[rank]))
        for (const Triangle &triangle : surface.triangles)
          if (do_meet(extents[rank], extent_of(box_of(surface, triangle))))
            {
              SentTriangle &s = sent[rank].emplace_back();
              for (unsigned int i = 0; i < 3; ++i)
                {
                  s.numbers[i] = surface.vertex_numbers[triangle[i]];
                  for (unsigned int d = 0; d < 3; ++d)
                    s.vertices[i][d] = surface.vertices[triangle[i]][d];
                }
            }

    std::unordered_map<std::uint64_t, unsigned int> places;
    for (unsigned int v = 0; v < surface.vertices.size(); ++v)
      places.emplace(surface.vertex_numbers[v], v);
    for (const auto &[rank, triangles] : exchange_arrays(sent, comm))
      for (const SentTriangle &s : triangles)
        {
          Triangle &triangle = surface.triangles.emplace_back();
          for (unsigned int i = 0; i < 3; ++i)
            {
              const auto [place, is_new] =
                places.emplace(s.numbers[i], surface.vertices.size());
              triangle[i] = place->second;
              if (!is_new)
                continue;
              surface.vertices.emplace_back(s.vertices[i][0],
                                            s.vertices[i][1],
                                            s.vertices[i][2]);
              surface.vertex_numbers.push_back(s.numbers[i]);
            }
        }
  }



  void
  check_surface(const CellSurface &surface, const std::string &origin)
  {
    const SurfaceTree tree = tree_of(surface);
    const auto touching = [&](const dealii::Point<3> &p, const auto &is_own) {
      std::vector<std::pair<BoundingBox, unsigned int>> near;
      tree.query(boost::geometry::index::intersects(p),
                 std::back_inserter(near));
      for (const auto &[box, t] : near)
        if (!is_own(t) && lies_on(p, surface, surface.triangles[t]))
          return &surface.triangles[t];
      return static_cast<const Triangle *>(nullptr);
    };

    std::vector<bool> done(surface.vertices.size(), false);
    for (std::size_t i = 0; i < surface.n_own; ++i)
      for (const unsigned int v : surface.triangles[i])
        {
          if (done[v])
            continue;
          done[v] = true;
          if (const Triangle *other =
                touching(surface.vertices[v], [&](const unsigned int t) {
                  const Triangle &triangle = surface.triangles[t];
                  return std::find(triangle.begin(), triangle.end(), v) !=
                         triangle.end();
                }))
            refuse_touching_vertex(surface, v, *other, origin);
        }
    for (std::size_t i = 0; i < surface.n_own; ++i)
      {
        const Triangle  &triangle = surface.triangles[i];
        dealii::Point<3> p;
        for (const unsigned int v : triangle)
          p += surface.vertices[v] / 3.;
        if (touching(p, [&](const unsigned int t) { return t == i; }) !=
            nullptr)
          refuse_mesh(
            origin,
            fmt::format("not conforming: the faces of two cells overlap at {}; "
                        "cells must meet in whole faces",
                        position(p)));
      }
  }
} // namespace corotet
