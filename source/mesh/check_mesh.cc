// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/check_surface.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/edges.h>
#include <corotet/mesh/mesh_quality.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace corotet
{
  namespace
  {
    // More would exceed the 32-bit numbers of deal.II's unknowns at degree 3.
    constexpr double max_n_cells = 3e8;

    // A cell is flat if its volume is below this many cubes of its longest
    // edge: the round-off of the volume. Needles and slivers are allowed.
    constexpr double flat = 1e-14;



    // A boundary as messages call it.
    std::string
    boundary_name(const SerialMesh &mesh, const unsigned int id)
    {
      const std::string name = MeshNames("boundary", mesh.boundaries).name(id);
      return name == std::to_string(id) ? name : "'" + name + "'";
    }



    void
    check_vertices(const SerialMesh &mesh)
    {
      if (mesh.cells.empty())
        refuse_mesh(mesh, "the mesh has no tetrahedra");
      for (const dealii::Point<3> &p : mesh.vertices)
        if (!std::isfinite(p.norm_square()))
          refuse_mesh(mesh,
                      "a vertex has the coordinates " + position(p) +
                        "; they must be finite numbers");

      const auto check = [&](const auto &vertices, const std::string &what) {
        for (const unsigned int v : vertices)
          if (v >= mesh.vertices.size())
            refuse_mesh(mesh,
                        fmt::format("a {} has the vertex {}; there are only "
                                    "the vertices 0 to {}",
                                    what,
                                    v,
                                    mesh.vertices.size() - 1));
      };
      for (const SerialMesh::Cell &cell : mesh.cells)
        check(cell.vertices, "cell");
      for (const SerialMesh::Face &face : mesh.faces)
        check(face.vertices,
              "face of boundary " + boundary_name(mesh, face.boundary));
      for (const SerialMesh::Edge &edge : mesh.edges)
        check(edge.vertices, "named edge");
      for (const SerialMesh::Corner &corner : mesh.corners)
        check(std::array<unsigned int, 1>{{corner.vertex}}, "named corner");
    }



    void
    check_volumes(const SerialMesh &mesh)
    {
      std::size_t      n_wrong = 0;
      SerialMesh::Cell first{};
      double           first_volume = 0;
      for (const SerialMesh::Cell &cell : mesh.cells)
        {
          const auto p            = cell_vertices(mesh, cell);
          double     longest_edge = 0;
          for (unsigned int i = 0; i < 4; ++i)
            for (unsigned int j = 0; j < i; ++j)
              longest_edge = std::max(longest_edge, p[i].distance(p[j]));
          const double volume = signed_volume(p);
          if (volume > flat * std::pow(longest_edge, 3))
            continue;
          if (n_wrong++ == 0)
            {
              first        = cell;
              first_volume = volume;
              if (std::abs(volume) <= flat * std::pow(longest_edge, 3))
                first_volume = 0;
            }
        }
      if (n_wrong == 0)
        return;

      const auto p = cell_vertices(mesh, first);
      refuse_mesh(
        mesh,
        fmt::format("{} of {} cells {} no positive volume: found {} with the "
                    "corners {}, {}, {}, {}; the last must see the others "
                    "counter-clockwise",
                    n_wrong,
                    mesh.cells.size(),
                    n_wrong == 1 ? "has" : "have",
                    first_volume == 0 ?
                      "a flat one (zero volume)" :
                      fmt::format("{:.6g} (inverted)", first_volume),
                    position(p[0]),
                    position(p[1]),
                    position(p[2]),
                    position(p[3])));
    }



    // A face of a cell: its vertices in ascending order, and whether an even
    // permutation of them is counter-clockwise seen from outside of the cell.
    struct CellFace
    {
      Triangle vertices;
      bool     even;
    };



    // Calls action(face) for each face of each cell.
    template <typename Action>
    void
    for_each_cell_face(const SerialMesh &mesh, const Action &action)
    {
      constexpr unsigned int outward[4][3] = {{1, 2, 3},
                                              {0, 3, 2},
                                              {0, 1, 3},
                                              {0, 2, 1}};
      for (const SerialMesh::Cell &cell : mesh.cells)
        for (const auto &corners : outward)
          {
            Triangle v;
            for (unsigned int i = 0; i < 3; ++i)
              v[i] = cell.vertices[corners[i]];
            const bool even = (v[0] < v[1]) ^ (v[1] < v[2]) ^ (v[0] < v[2]);
            std::sort(v.begin(), v.end());
            action(CellFace{v, even});
          }
    }



    // By their vertices. Those with the same lowest vertex are few, and sorted
    // among themselves: several times faster than sorting them all.
    std::vector<CellFace>
    sorted_cell_faces(const SerialMesh &mesh)
    {
      // Where the faces of each lowest vertex begin, and where the next goes.
      std::vector<std::size_t> begin(mesh.vertices.size() + 1, 0);
      for_each_cell_face(mesh, [&](const CellFace &face) {
        ++begin[face.vertices[0] + 1];
      });
      std::partial_sum(begin.begin(), begin.end(), begin.begin());
      std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
      std::vector<CellFace>    faces(begin.back());
      for_each_cell_face(mesh, [&](const CellFace &face) {
        faces[next[face.vertices[0]]++] = face;
      });
      for (std::size_t v = 0; v < next.size(); ++v)
        std::sort(faces.begin() + begin[v],
                  faces.begin() + begin[v + 1],
                  [](const CellFace &a, const CellFace &b) {
                    return a.vertices < b.vertices;
                  });
      return faces;
    }



    // The triangles that belong to one cell, and those between two cells, each
    // with its vertices and the whole list in ascending order.
    struct Triangles
    {
      std::vector<Triangle> surface;
      std::vector<Triangle> interior;
    };



    Triangles
    check_neighbours(const SerialMesh &mesh)
    {
      const std::vector<CellFace> faces = sorted_cell_faces(mesh);
      Triangles                   triangles;
      for (std::size_t i = 0, end = 0; i < faces.size(); i = end)
        {
          for (end = i;
               end < faces.size() && faces[end].vertices == faces[i].vertices;)
            ++end;
          if (end - i == 1)
            triangles.surface.push_back(faces[i].vertices);
          else if (end - i == 2 && faces[i].even != faces[i + 1].even)
            triangles.interior.push_back(faces[i].vertices);
          else
            refuse_mesh(mesh,
                        fmt::format("cells overlap: the triangle with the "
                                    "centre {} is a face of {} cells{}; at "
                                    "most two may share it, one on each side",
                                    position(centre(mesh, faces[i].vertices)),
                                    end - i,
                                    end - i == 2 ? " on the same side" : ""));
        }
      return triangles;
    }



    // Keeps the faces on the surface, once each.
    void
    check_faces(SerialMesh &mesh, const Triangles &triangles)
    {
      for (SerialMesh::Face &face : mesh.faces)
        std::sort(face.vertices.begin(), face.vertices.end());
      std::sort(mesh.faces.begin(),
                mesh.faces.end(),
                [](const SerialMesh::Face &a, const SerialMesh::Face &b) {
                  return std::tie(a.vertices, a.boundary) <
                         std::tie(b.vertices, b.boundary);
                });

      std::vector<SerialMesh::Face>       kept;
      std::map<unsigned int, std::size_t> n_inside;
      for (const SerialMesh::Face &face : mesh.faces)
        {
          const auto is_one_of = [&](const std::vector<Triangle> &list) {
            return std::binary_search(list.begin(), list.end(), face.vertices);
          };
          if (is_one_of(triangles.interior))
            ++n_inside[face.boundary];
          else if (!is_one_of(triangles.surface))
            refuse_mesh(mesh,
                        fmt::format("boundary {} has the triangle with the "
                                    "centre {}, which is no face of a cell",
                                    boundary_name(mesh, face.boundary),
                                    position(centre(mesh, face.vertices))));
          else if (kept.empty() || kept.back().vertices != face.vertices)
            kept.push_back(face);
          else if (kept.back().boundary != face.boundary)
            refuse_mesh(mesh,
                        fmt::format("the face with the centre {} belongs to "
                                    "the boundaries {} and {}; a face has "
                                    "one boundary at most",
                                    position(centre(mesh, face.vertices)),
                                    boundary_name(mesh, kept.back().boundary),
                                    boundary_name(mesh, face.boundary)));
        }
      mesh.faces = std::move(kept);
      for (const auto &[boundary, n] : n_inside)
        mesh.remarks.push_back(
          fmt::format("boundary {} has {} faces inside the body; they are "
                      "ignored",
                      boundary_name(mesh, boundary),
                      n));
    }
  } // namespace



  std::string
  position(const dealii::Point<3> &p)
  {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]);
  }



  dealii::Point<3>
  centre(const SerialMesh &mesh, const Triangle &triangle)
  {
    dealii::Point<3> sum;
    for (const unsigned int v : triangle)
      sum += mesh.vertices[v];
    return sum / 3.;
  }



  double
  largest_number_of_cells(const unsigned int n_refinements)
  {
    return max_n_cells / std::pow(8., n_refinements);
  }



  void
  check_number_of_cells(const std::size_t  n_cells,
                        const unsigned int n_refinements)
  {
    const double n_refined = n_cells * std::pow(8., n_refinements);
    if (n_refined > max_n_cells)
      throw InputError("Mesh/Refinements",
                       fmt::format("too many cells: found {} refinements, "
                                   "which make {:.3g} cells of {}; at most "
                                   "{:.3g} are allowed",
                                   n_refinements,
                                   n_refined,
                                   n_cells,
                                   max_n_cells));
  }



  void
  refuse_mesh(const SerialMesh &mesh, const std::string &message)
  {
    if (mesh.origin.empty())
      throw InputError("Mesh/Type", message);
    throw InputError("", mesh.origin + ": " + message);
  }



  void
  check_cells(const SerialMesh &mesh, const unsigned int element_degree)
  {
    check_volumes(mesh);
    check_curved_cells(mesh, element_degree);
  }



  void
  check_mesh(SerialMesh &mesh, const unsigned int element_degree)
  {
    check_vertices(mesh);
    check_cells(mesh, element_degree);
    const Triangles triangles = check_neighbours(mesh);
    check_surface(mesh, triangles.surface);
    check_faces(mesh, triangles);
    check_edges_and_corners(mesh);
  }
} // namespace corotet
