// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/check_surface.h>

#include <deal.II/numerics/rtree.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  namespace
  {
    // Points that are closer than this many longest edges coincide: far above
    // round-off, far below the features of any sensible mesh.
    constexpr double face_tolerance = 1e-8;

    double
    longest_edge(const SerialMesh &mesh, const Triangle &triangle)
    {
      double longest = 0;
      for (unsigned int i = 0; i < 3; ++i)
        longest = std::max(longest,
                           mesh.vertices[triangle[i]].distance(
                             mesh.vertices[triangle[(i + 1) % 3]]));
      return longest;
    }



    // Whether @p p lies on a triangle, its edges and corners included.
    bool
    lies_on(const dealii::Point<3> &p,
            const SerialMesh       &mesh,
            const Triangle         &triangle)
    {
      const dealii::Point<3> &origin = mesh.vertices[triangle[0]];
      const auto              a      = mesh.vertices[triangle[1]] - origin;
      const auto              b      = mesh.vertices[triangle[2]] - origin;
      const auto              r      = p - origin;
      const auto              normal = dealii::cross_product_3d(a, b);
      const double            area   = normal.norm();
      if (std::abs(r * normal) >
          face_tolerance * longest_edge(mesh, triangle) * area)
        return false;
      // Barycentric coordinates of the projection on the plane.
      const double s = dealii::cross_product_3d(r, b) * normal / (area * area);
      const double t = dealii::cross_product_3d(a, r) * normal / (area * area);
      return s >= -face_tolerance && t >= -face_tolerance &&
             s + t <= 1 + face_tolerance;
    }



    using BoundingBox = dealii::BoundingBox<3>;
    using SurfaceTree = dealii::RTree<std::pair<BoundingBox, unsigned int>>;

    SurfaceTree
    tree_of(const SerialMesh &mesh, const std::vector<Triangle> &surface)
    {
      std::vector<std::pair<BoundingBox, unsigned int>> boxes;
      boxes.reserve(surface.size());
      for (unsigned int t = 0; t < surface.size(); ++t)
        {
          BoundingBox box(
            std::vector<dealii::Point<3>>{mesh.vertices[surface[t][0]],
                                          mesh.vertices[surface[t][1]],
                                          mesh.vertices[surface[t][2]]});
          box.extend(face_tolerance * longest_edge(mesh, surface[t]));
          boxes.emplace_back(box, t);
        }
      return dealii::pack_rtree(boxes);
    }



    [[noreturn]] void
    refuse_touching_vertex(const SerialMesh  &mesh,
                           const unsigned int vertex,
                           const Triangle    &triangle)
    {
      const dealii::Point<3> &p = mesh.vertices[vertex];
      for (const unsigned int corner : triangle)
        if (p.distance(mesh.vertices[corner]) <=
            face_tolerance * longest_edge(mesh, triangle))
          refuse_mesh(mesh,
                      fmt::format("duplicate nodes: two vertices are at {}; "
                                  "cells that meet there must share one (in "
                                  "gmsh: BooleanFragments or Coherence)",
                                  position(p)));
      refuse_mesh(mesh,
                  fmt::format("hanging node: the vertex at {} lies on a face "
                              "of a cell without being its corner; cells must "
                              "meet in whole faces (in gmsh: "
                              "BooleanFragments or Coherence)",
                              position(p)));
    }
  } // namespace



  void
  check_surface(const SerialMesh &mesh, const std::vector<Triangle> &surface)
  {
    const SurfaceTree tree = tree_of(mesh, surface);
    const auto touching = [&](const dealii::Point<3> &p, const auto &is_own) {
      std::vector<std::pair<BoundingBox, unsigned int>> near;
      tree.query(boost::geometry::index::intersects(p),
                 std::back_inserter(near));
      for (const auto &[box, t] : near)
        if (!is_own(surface[t]) && lies_on(p, mesh, surface[t]))
          return &surface[t];
      return static_cast<const Triangle *>(nullptr);
    };

    std::vector<bool> done(mesh.vertices.size(), false);
    for (const Triangle &triangle : surface)
      for (const unsigned int v : triangle)
        {
          if (done[v])
            continue;
          done[v] = true;
          if (const Triangle *other =
                touching(mesh.vertices[v], [&](const Triangle &t) {
                  return std::find(t.begin(), t.end(), v) != t.end();
                }))
            refuse_touching_vertex(mesh, v, *other);
        }
    for (const Triangle &triangle : surface)
      {
        const dealii::Point<3> p = centre(mesh, triangle);
        if (touching(p, [&](const Triangle &t) { return t == triangle; }) !=
            nullptr)
          refuse_mesh(mesh,
                      fmt::format("not conforming: the faces of two cells "
                                  "overlap at {}; cells must meet in whole "
                                  "faces",
                                  position(p)));
      }
  }
} // namespace corotet
