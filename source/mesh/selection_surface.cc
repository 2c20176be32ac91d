// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The surface of a mesh, as selections see it.

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <map>

#include "selection.h"

namespace corotet::selections
{
  namespace
  {
    using dealii::Point;
    using Triangle = std::array<unsigned int, 3>;



    Triangle
    sorted(Triangle triangle)
    {
      std::sort(triangle.begin(), triangle.end());
      return triangle;
    }



    // Adds to listed faces of a mesh all others of its surface, with the id @p
    // unnamed. Returns the vertex inside of each.
    std::vector<unsigned int>
    complete(std::vector<SerialMesh::Face> &faces,
             const SerialMesh              &mesh,
             const unsigned int             unnamed)
    {
      struct Side
      {
        Triangle     vertices;
        unsigned int inside;
      };
      std::vector<Side> sides;
      sides.reserve(4 * mesh.cells.size());
      for (const SerialMesh::Cell &cell : mesh.cells)
        for (unsigned int i = 0; i < 4; ++i)
          sides.push_back({sorted({{cell.vertices[(i + 1) % 4],
                                    cell.vertices[(i + 2) % 4],
                                    cell.vertices[(i + 3) % 4]}}),
                           cell.vertices[i]});
      std::sort(sides.begin(), sides.end(), [](const Side &a, const Side &b) {
        return a.vertices < b.vertices;
      });
      std::map<Triangle, std::size_t> known;
      for (std::size_t f = 0; f < faces.size(); ++f)
        known.emplace(sorted(faces[f].vertices), f);
      std::vector<unsigned int> inside(faces.size());
      for (std::size_t i = 0; i < sides.size(); ++i)
        {
          if (i + 1 < sides.size() &&
              sides[i].vertices == sides[i + 1].vertices)
            {
              ++i;
              continue;
            }
          if (const auto found = known.find(sides[i].vertices);
              found != known.end())
            inside[found->second] = sides[i].inside;
          else
            {
              faces.push_back({sides[i].vertices, unnamed});
              inside.push_back(sides[i].inside);
            }
        }
      return inside;
    }



    // Faces that share an edge.
    std::vector<std::vector<unsigned int>>
    neighbours(const std::vector<SerialMesh::Face> &faces)
    {
      std::vector<Triangle> halves;
      for (unsigned int f = 0; f < faces.size(); ++f)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int a = faces[f].vertices[i];
            const unsigned int b = faces[f].vertices[(i + 1) % 3];
            halves.push_back({{std::min(a, b), std::max(a, b), f}});
          }
      std::sort(halves.begin(), halves.end());
      std::vector<std::vector<unsigned int>> result(faces.size());
      for (std::size_t i = 0; i + 1 < halves.size(); ++i)
        if (halves[i][0] == halves[i + 1][0] &&
            halves[i][1] == halves[i + 1][1])
          {
            result[halves[i][2]].push_back(halves[i + 1][2]);
            result[halves[i + 1][2]].push_back(halves[i][2]);
          }
      return result;
    }
  } // namespace



  double
  tolerance(const SerialMesh &mesh)
  {
    const dealii::BoundingBox<3> box(mesh.vertices);
    const auto [low, high] = box.get_boundary_points();
    return 1e-6 * low.distance(high);
  }



  bool
  is_place(const SerialMesh &mesh, const std::string &name)
  {
    return !mesh.boundaries.ids(name).empty() ||
           !mesh.edge_names.ids(name).empty() ||
           !mesh.corner_names.ids(name).empty();
  }



  unsigned int
  id_without_name(const SerialMesh &mesh)
  {
    unsigned int result = 0;
    for (const SerialMesh::Face &face : mesh.faces)
      result = std::max(result, face.boundary + 1);
    for (const auto &[id, name] : mesh.boundaries.names)
      result = std::max(result, id + 1);
    return result;
  }



  Surface
  surface_of(const SerialMesh &mesh, const unsigned int unnamed)
  {
    Surface                         surface{mesh.faces, {}};
    const std::vector<unsigned int> inside =
      complete(surface.faces, mesh, unnamed);
    Members &members   = surface.members;
    members.kind       = "face";
    members.tolerance  = tolerance(mesh);
    members.neighbours = neighbours(surface.faces);
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
      {
        std::vector<Point<3>> x;
        for (const unsigned int v : surface.faces[f].vertices)
          x.push_back(mesh.vertices[v]);
        auto normal = dealii::cross_product_3d(x[1] - x[0], x[2] - x[0]);
        if (normal * (mesh.vertices[inside[f]] - x[0]) > 0)
          normal *= -1;
        members.normals.push_back(normal / normal.norm());
        members.points.push_back(x);
      }
    return surface;
  }
} // namespace corotet::selections
