// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/check_names.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace corotet
{
  namespace
  {
    using Counts = std::map<unsigned int, std::size_t>;



    bool
    operator<(const SerialMesh::Face &a, const SerialMesh::Face &b)
    {
      return std::tie(a.vertices, a.boundary) <
             std::tie(b.vertices, b.boundary);
    }



    bool
    operator<(const SerialMesh::Edge &a, const SerialMesh::Edge &b)
    {
      return std::tie(a.vertices, a.id) < std::tie(b.vertices, b.id);
    }



    bool
    operator<(const SerialMesh::Corner &a, const SerialMesh::Corner &b)
    {
      return std::tie(a.vertex, a.id) < std::tie(b.vertex, b.id);
    }



    // Sorts parts and removes repeated ones.
    template <typename Part>
    void
    sort(std::vector<Part> &parts)
    {
      std::sort(parts.begin(), parts.end(), [](const Part &a, const Part &b) {
        return a < b;
      });
      parts.erase(std::unique(parts.begin(),
                              parts.end(),
                              [](const Part &a, const Part &b) {
                                return !(a < b) && !(b < a);
                              }),
                  parts.end());
    }



    // Keeps the parts that cells have; counts the others by their ids.
    template <typename Part>
    Counts
    keep(std::vector<Part> &parts, std::vector<Part> &&of_cells)
    {
      sort(of_cells);
      Counts n_left_out;
      std::erase_if(parts, [&](const Part &part) {
        const auto place =
          std::lower_bound(of_cells.begin(),
                           of_cells.end(),
                           part,
                           [](const Part &a, const Part &b) { return a < b; });
        const bool is_there = place != of_cells.end() && !(part < *place);
        n_left_out[part.id] += is_there ? 0 : 1;
        return !is_there;
      });
      sort(parts);
      return n_left_out;
    }



    void
    remark_left_out(SerialMesh        &mesh,
                    const std::string &kind,
                    const NamedSets   &named,
                    const Counts      &n_left_out,
                    const std::string &part)
    {
      for (const auto &[id, n] : n_left_out)
        if (n > 0)
          mesh.remarks.push_back(
            fmt::format("{} {}s of '{}' are no {} of a tetrahedron; they are "
                        "left out",
                        n,
                        kind,
                        MeshNames(kind, named).name(id),
                        part));
    }



    void
    check_edges(SerialMesh &mesh, const NamedParts &parts)
    {
      for (SerialMesh::Edge &edge : mesh.edges)
        edge.vertices = ascending_ends(edge.vertices[0], edge.vertices[1]);
      std::vector<SerialMesh::Edge> of_cells;
      for (const auto &[c, e, id] : parts.edges)
        {
          const auto &v = mesh.cells[c].vertices;
          of_cells.push_back(
            {ascending_ends(v[ends_of_edges[e][0]], v[ends_of_edges[e][1]]),
             id});
        }
      remark_left_out(mesh,
                      "line",
                      mesh.edge_names,
                      keep(mesh.edges, std::move(of_cells)),
                      "edge");
    }



    void
    check_corners(SerialMesh &mesh, const NamedParts &parts)
    {
      std::vector<SerialMesh::Corner> of_cells;
      for (const auto &[c, k, id] : parts.corners)
        of_cells.push_back({mesh.cells[c].vertices[k], id});
      remark_left_out(mesh,
                      "point",
                      mesh.corner_names,
                      keep(mesh.corners, std::move(of_cells)),
                      "corner");
    }



    // The corners of the face of a cell, in ascending order.
    std::array<unsigned int, 3>
    face_of(const SerialMesh &mesh, const CellPart &part)
    {
      std::array<unsigned int, 3> v;
      for (unsigned int i = 0; i < 3; ++i)
        v[i] = mesh.cells[part.cell].vertices[corners_of_faces[part.number][i]];
      return ascending_vertices(v);
    }



    // The listed faces of cells, sorted, to count the cells that have a face.
    class CellsOfFaces
    {
    public:
      CellsOfFaces(const SerialMesh &mesh, const std::vector<CellPart> &parts)
      {
        faces.reserve(parts.size());
        for (const CellPart &part : parts)
          faces.push_back(face_of(mesh, part));
        std::sort(faces.begin(), faces.end());
      }

      std::size_t
      n_cells(const std::array<unsigned int, 3> &face) const
      {
        const auto [begin, end] =
          std::equal_range(faces.begin(), faces.end(), face);
        return end - begin;
      }

    private:
      std::vector<std::array<unsigned int, 3>> faces;
    };



    void
    check_faces(SerialMesh &mesh, NamedParts &parts)
    {
      const CellsOfFaces            cells(mesh, parts.faces);
      std::vector<SerialMesh::Face> kept;
      Counts                        n_inside;
      for (const SerialMesh::Face &face : mesh.faces)
        {
          const std::size_t n = cells.n_cells(face.vertices);
          if (n > 1)
            ++n_inside[face.boundary];
          else if (n == 0)
            refuse_mesh(mesh.origin,
                        fmt::format("boundary {} has the triangle with the "
                                    "centre {}, which is no face of a cell",
                                    boundary_name(mesh, face.boundary),
                                    position(centre(mesh, face.vertices))));
          else if (kept.empty() || kept.back().vertices != face.vertices)
            kept.push_back(face);
          else
            refuse_mesh(mesh.origin,
                        fmt::format("the face with the centre {} belongs to "
                                    "the boundaries {} and {}; a face has "
                                    "one boundary at most",
                                    position(centre(mesh, face.vertices)),
                                    boundary_name(mesh, kept.back().boundary),
                                    boundary_name(mesh, face.boundary)));
        }
      mesh.faces = std::move(kept);
      std::erase_if(parts.faces, [&](const CellPart &part) {
        return cells.n_cells(face_of(mesh, part)) > 1;
      });
      for (const auto &[boundary, n] : n_inside)
        mesh.remarks.push_back(
          fmt::format("boundary {} has {} faces inside the body; they are "
                      "ignored",
                      boundary_name(mesh, boundary),
                      n));
    }
  } // namespace



  NamedParts
  check_names(SerialMesh &mesh)
  {
    for (SerialMesh::Face &face : mesh.faces)
      face.vertices = ascending_vertices(face.vertices);
    sort(mesh.faces);
    NamedParts parts = named_parts(mesh);
    check_faces(mesh, parts);
    check_edges(mesh, parts);
    check_corners(mesh, parts);
    // Parts that were listed twice are here twice.
    const auto sort_list = [](std::vector<CellPart> &list) {
      const auto key = [](const CellPart &p) {
        return std::tie(p.cell, p.number, p.id);
      };
      std::sort(list.begin(),
                list.end(),
                [&](const CellPart &a, const CellPart &b) {
                  return key(a) < key(b);
                });
      list.erase(std::unique(list.begin(),
                             list.end(),
                             [&](const CellPart &a, const CellPart &b) {
                               return key(a) == key(b);
                             }),
                 list.end());
    };
    sort_list(parts.edges);
    sort_list(parts.corners);
    return parts;
  }
} // namespace corotet
