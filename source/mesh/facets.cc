// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/disjoint_sets.h>
#include <corotet/base/text.h>
#include <corotet/mesh/edges.h>
#include <corotet/mesh/face_neighbors.h>
#include <corotet/mesh/facets.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  namespace
  {
    using Corners = std::array<unsigned int, 3>;
    using Edge    = std::array<unsigned int, 2>;

    struct OuterTriangle
    {
      Corners              corners;
      unsigned int         boundary;
      dealii::Tensor<1, 3> normal;
    };

    // Two triangles of a boundary that share an edge, and the angle between
    // their normals.
    struct Bend
    {
      Edge                        edge;
      std::array<unsigned int, 2> triangles;
      double                      angle;
    };

    Corners
    sorted(Corners corners)
    {
      std::sort(corners.begin(), corners.end());
      return corners;
    }

    // The faces that belong to only one cell, with normals that point outwards.
    std::vector<OuterTriangle>
    surface_of(const SerialMesh &mesh)
    {
      std::map<Corners, unsigned int> boundaries;
      for (const SerialMesh::Face &face : mesh.faces)
        boundaries.emplace(sorted(face.vertices), face.boundary);
      // Overlapping cells are reported elsewhere.
      constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;
      const auto             neighbors =
        find_neighbors(mesh, none, mesh.origin, [](const unsigned int) {
          return false;
        });
      std::vector<OuterTriangle> result;
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        for (unsigned int f = 0; f < 4; ++f)
          {
            if (neighbors[c][f] != none)
              continue;
            const auto &v = mesh.cells[c].vertices;
            const auto &x = mesh.vertices;
            Corners     corners;
            for (unsigned int i = 0; i < 3; ++i)
              corners[i] = v[corners_of_faces[f][i]];
            const dealii::Point<3> origin = x[corners[0]];
            auto                   normal =
              cross_product_3d(x[corners[1]] - origin, x[corners[2]] - origin);
            // The corner opposite to the face is inside.
            if (normal * (x[v[3 - f]] - origin) > 0)
              normal *= -1.;
            const auto boundary = boundaries.find(sorted(corners));
            result.push_back(
              {corners,
               boundary == boundaries.end() ? no_boundary : boundary->second,
               normal / normal.norm()});
          }
      return result;
    }

    std::vector<Bend>
    bends_of(const std::vector<OuterTriangle> &surface)
    {
      std::map<Edge, std::vector<unsigned int>> edges;
      for (unsigned int t = 0; t < surface.size(); ++t)
        for (unsigned int k = 0; k < 3; ++k)
          {
            Edge edge{{surface[t].corners[k], surface[t].corners[(k + 1) % 3]}};
            std::sort(edge.begin(), edge.end());
            edges[edge].push_back(t);
          }
      std::vector<Bend> result;
      for (const auto &[edge, sides] : edges)
        if (sides.size() == 2 &&
            surface[sides[0]].boundary == surface[sides[1]].boundary)
          result.push_back(
            {edge,
             {{sides[0], sides[1]}},
             std::atan2(cross_product_3d(surface[sides[0]].normal,
                                         surface[sides[1]].normal)
                          .norm(),
                        surface[sides[0]].normal * surface[sides[1]].normal)});
      return result;
    }
  } // namespace

  std::set<unsigned int>
  faceted_boundaries(const SerialMesh &mesh)
  {
    constexpr double       degree = dealii::numbers::PI / 180;
    constexpr double       flat = 0.1 * degree, sharp = 42 * degree;
    constexpr unsigned int n_in_sequence = 4;

    const std::vector<OuterTriangle> surface = surface_of(mesh);
    const std::vector<Bend>          bends   = bends_of(surface);
    DisjointSets                     facets(surface.size());
    std::vector<unsigned char>       is_bent(mesh.vertices.size());
    for (const Bend &bend : bends)
      if (bend.angle < flat)
        facets.unite(bend.triangles[0], bend.triangles[1]);
      else
        is_bent[bend.edge[0]] = is_bent[bend.edge[1]] = 1;
    // Vertices whose triangles belong to several facets are on the rim of
    // these: so are vertices on edges between boundaries or at sharp edges.
    std::vector<unsigned int> facet_at(mesh.vertices.size(), no_boundary);
    for (unsigned int t = 0; t < surface.size(); ++t)
      for (const unsigned int v : surface[t].corners)
        if (facet_at[v] == no_boundary)
          facet_at[v] = facets.root(t);
        else if (facet_at[v] != facets.root(t))
          is_bent[v] = 1;
    std::vector<unsigned char> is_wide(surface.size());
    for (unsigned int t = 0; t < surface.size(); ++t)
      for (const unsigned int v : surface[t].corners)
        if (is_bent[v] == 0)
          is_wide[facets.root(t)] = 1;

    DisjointSets sequences(surface.size());
    for (const Bend &bend : bends)
      {
        const unsigned int a = facets.root(bend.triangles[0]),
                           b = facets.root(bend.triangles[1]);
        if (bend.angle < sharp && is_wide[a] == 0 && is_wide[b] == 0)
          sequences.unite(a, b);
      }
    std::map<unsigned int, unsigned int> lengths;
    for (unsigned int t = 0; t < surface.size(); ++t)
      if (facets.root(t) == t && is_wide[t] == 0)
        ++lengths[sequences.root(t)];
    std::set<unsigned int> result;
    for (const auto &[sequence, length] : lengths)
      if (length >= n_in_sequence)
        result.insert(surface[sequence].boundary);
    return result;
  }

  std::string
  remark_on_facets(const std::set<unsigned int> &boundaries,
                   const NamedSets              &named)
  {
    const MeshNames          known("boundary", named);
    std::vector<std::string> names;
    for (const unsigned int id : boundaries)
      names.push_back(id == no_boundary ? "surfaces without a name" :
                                          known.name(id));
    return "warning for elements of degree 2 and 3: cells are straight along "
           "curved surfaces (" +
           join(names) +
           "), stress there is no better than with degree 1; set Geometry "
           "degree of the mesh to that of the elements, or give a mesh of "
           "curved cells";
  }

  void
  remark_facets(SerialMesh &mesh, const std::set<unsigned int> &boundaries)
  {
    if (boundaries.empty())
      return;
    mesh.faceted = boundaries;
    mesh.remarks.push_back(remark_on_facets(boundaries, mesh.boundaries));
  }
} // namespace corotet
