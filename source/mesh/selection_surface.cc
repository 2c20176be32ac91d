// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The surface of a mesh, as selections see it.

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "selection.h"

namespace corotet::selections
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;
    using dealii::Point;



    // The faces of the surface; those that the mesh has listed have their
    // boundaries.
    std::vector<CellPart>
    faces_of(const LocalMesh &mesh, const unsigned int unnamed)
    {
      const std::vector<bool> is_near = vertices_of_own_cells(mesh);
      std::vector<CellPart>   faces;
      auto                    listed = mesh.faces.begin();
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        {
          unsigned int boundaries[] = {unnamed, unnamed, unnamed, unnamed};
          for (; listed != mesh.faces.end() && listed->cell == c; ++listed)
            boundaries[listed->number] = listed->id;
          for (unsigned int f = 0; f < 4; ++f)
            {
              const CellPart face{c, f, boundaries[f]};
              const auto     v = vertices_of(mesh, face);
              // A cell beside the own cells may have unknown cells behind its
              // far side.
              if (mesh.neighbors[c][f] == LocalMesh::no_cell &&
                  (is_near[v[0]] || is_near[v[1]] || is_near[v[2]]))
                faces.push_back(face);
            }
        }
      return faces;
    }



    dealii::Tensor<1, 3>
    outer_normal(const LocalMesh &mesh, const CellPart &face)
    {
      const auto [a, b, c] = vertices_of(mesh, face);
      const Point<3> &x    = mesh.vertices[a];
      auto            normal =
        dealii::cross_product_3d(mesh.vertices[b] - x, mesh.vertices[c] - x);
      // Face f has all vertices of the cell except vertex 3 - f.
      const unsigned int inside =
        mesh.cells[face.cell].vertices[3 - face.number];
      if (normal * (mesh.vertices[inside] - x) > 0)
        normal *= -1;
      return normal / normal.norm();
    }



    // For each face, the faces that share an edge with it.
    std::vector<std::vector<unsigned int>>
    neighbours(const LocalMesh &mesh, const std::vector<CellPart> &faces)
    {
      std::vector<std::array<unsigned int, 3>> sides;
      sides.reserve(3 * faces.size());
      for (unsigned int f = 0; f < faces.size(); ++f)
        {
          const auto v = vertices_of(mesh, faces[f]);
          for (unsigned int i = 0; i < 3; ++i)
            {
              const auto [a, b] = ascending_ends(v[i], v[(i + 1) % 3]);
              sides.push_back({{a, b, f}});
            }
        }
      std::sort(sides.begin(), sides.end());
      std::vector<std::vector<unsigned int>> result(faces.size());
      for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end)
        {
          while (end < sides.size() && sides[end][0] == sides[begin][0] &&
                 sides[end][1] == sides[begin][1])
            ++end;
          for (std::size_t i = begin; i < end; ++i)
            for (std::size_t j = begin; j < end; ++j)
              if (i != j)
                result[sides[i][2]].push_back(sides[j][2]);
        }
      return result;
    }
  } // namespace



  std::array<unsigned int, 3>
  vertices_of(const LocalMesh &mesh, const CellPart &face)
  {
    const auto &v        = mesh.cells[face.cell].vertices;
    const auto [i, j, k] = corners_of_faces[face.number];
    return {{v[i], v[j], v[k]}};
  }



  std::vector<bool>
  vertices_of_own_cells(const LocalMesh &mesh)
  {
    std::vector<bool> result(mesh.vertices.size(), false);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.is_owned(c))
        for (const unsigned int v : mesh.cells[c].vertices)
          result[v] = true;
    return result;
  }



  double
  tolerance(const LocalMesh &mesh)
  {
    constexpr double      infinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{{infinity, infinity, infinity}};
    std::array<double, 3> high{{-infinity, -infinity, -infinity}};
    for (const Point<3> &x : mesh.vertices)
      for (unsigned int d = 0; d < 3; ++d)
        {
          low[d]  = std::min(low[d], x[d]);
          high[d] = std::max(high[d], x[d]);
        }
    double sum = 0;
    for (unsigned int d = 0; d < 3; ++d)
      {
        const double length = MPI::max(high[d], mesh.communicator) -
                              MPI::min(low[d], mesh.communicator);
        sum += length * length;
      }
    return 1e-6 * std::sqrt(sum);
  }



  bool
  is_place(const UsedNames &names, const std::string &name)
  {
    // Numbers of parts without a name count, too.
    const PlaceNames places(names.boundaries, names.edges, names.corners);
    return !places.boundaries.find(name).empty() ||
           !places.edges.find(name).empty() ||
           !places.corners.find(name).empty();
  }



  unsigned int
  id_without_name(const NamedSets &named)
  {
    return named.names.empty() ? 0 : named.names.rbegin()->first + 1;
  }



  std::vector<unsigned int>
  ids_of_all(std::vector<unsigned int> own, const MPI_Comm comm)
  {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    return MPI::compute_set_union(own, comm);
  }



  Surface
  surface_of(const LocalMesh   &mesh,
             const GhostCells  &ghosts,
             const unsigned int unnamed)
  {
    Surface  surface{faces_of(mesh, unnamed), {}};
    Members &members     = surface.members;
    members.kind         = "face";
    members.communicator = mesh.communicator;
    members.n_points     = 3;
    members.tolerance    = tolerance(mesh);
    members.has_normals  = true;
    members.neighbours   = neighbours(mesh, surface.faces);
    for (const CellPart &face : surface.faces)
      {
        for (const unsigned int v : vertices_of(mesh, face))
          members.points.push_back(mesh.vertices[v]);
        members.normals.push_back(outer_normal(mesh, face));
        members.is_counted.push_back(mesh.is_owned(face.cell));
        const std::uint64_t number = 4 * mesh.numbers[face.cell] + face.number;
        members.keys.push_back(
          face.id == unnamed ? 4 * mesh.n_global_cells + number : number);
      }
    members.update = [&mesh, &ghosts, faces = surface.faces](
                       std::vector<unsigned char> &values) {
      std::vector<unsigned char> of_cells(4 * mesh.cells.size());
      for (std::size_t f = 0; f < faces.size(); ++f)
        of_cells[4 * faces[f].cell + faces[f].number] = values[f];
      ghosts.update(of_cells, 4);
      for (std::size_t f = 0; f < faces.size(); ++f)
        values[f] = of_cells[4 * faces[f].cell + faces[f].number];
    };
    return surface;
  }
} // namespace corotet::selections
