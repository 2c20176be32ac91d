// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/edges.h>

#include <algorithm>
#include <utility>

namespace corotet
{
  namespace
  {
    using Ends = std::array<unsigned int, 2>;

    // The bits of PartsOfCells::is_on.
    constexpr unsigned char face_bit = 1, edge_bit = 2, corner_bit = 4;
  } // namespace



  std::array<unsigned int, 2>
  ascending_ends(const unsigned int a, const unsigned int b)
  {
    return {{std::min(a, b), std::max(a, b)}};
  }



  std::array<unsigned int, 3>
  ascending_vertices(std::array<unsigned int, 3> vertices)
  {
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  }



  PartsOfCells::PartsOfCells(const SerialMesh &mesh)
    : mesh(mesh)
    , is_on(mesh.vertices.size(), 0)
  {
    faces.reserve(mesh.faces.size());
    for (const SerialMesh::Face &face : mesh.faces)
      {
        faces.emplace_back(ascending_vertices(face.vertices), face.boundary);
        for (const unsigned int v : face.vertices)
          is_on[v] |= face_bit;
      }
    std::sort(faces.begin(), faces.end());
    edges.reserve(mesh.edges.size());
    for (std::size_t i = 0; i < mesh.edges.size(); ++i)
      {
        const auto [a, b] = mesh.edges[i].vertices;
        edges.emplace_back(ascending_ends(a, b), i);
        is_on[a] |= edge_bit;
        is_on[b] |= edge_bit;
      }
    std::sort(edges.begin(), edges.end());
    for (const SerialMesh::Corner &corner : mesh.corners)
      {
        corners.push_back({{corner.vertex, corner.id}});
        is_on[corner.vertex] |= corner_bit;
      }
    std::sort(corners.begin(), corners.end());
  }



  std::vector<std::size_t>
  PartsOfCells::edges_between(const unsigned int a, const unsigned int b) const
  {
    std::vector<std::size_t> result;
    if ((is_on[a] & is_on[b] & edge_bit) == 0)
      return result;
    const Ends ends = ascending_ends(a, b);
    for (auto edge = std::lower_bound(edges.begin(),
                                      edges.end(),
                                      std::pair(ends, std::size_t(0)));
         edge != edges.end() && edge->first == ends;
         ++edge)
      result.push_back(edge->second);
    return result;
  }



  void
  PartsOfCells::add_faces(std::vector<CellPart>  &parts,
                          const SerialMesh::Cell &cell,
                          const unsigned int      name) const
  {
    const std::array<unsigned int, 4> &v = cell.vertices;
    for (unsigned int f = 0; f < 4; ++f)
      {
        const auto [a, b, c] = corners_of_faces[f];
        if ((is_on[v[a]] & is_on[v[b]] & is_on[v[c]] & face_bit) == 0)
          continue;
        const auto vertices = ascending_vertices({{v[a], v[b], v[c]}});
        const auto face =
          std::lower_bound(faces.begin(), faces.end(), std::pair(vertices, 0u));
        if (face != faces.end() && face->first == vertices)
          parts.push_back({name, f, face->second});
      }
  }



  void
  PartsOfCells::add_edges(std::vector<CellPart>  &parts,
                          const SerialMesh::Cell &cell,
                          const unsigned int      name) const
  {
    for (unsigned int e = 0; e < ends_of_edges.size(); ++e)
      for (const std::size_t i :
           edges_between(cell.vertices[ends_of_edges[e][0]],
                         cell.vertices[ends_of_edges[e][1]]))
        parts.push_back({name, e, mesh.edges[i].id});
  }



  void
  PartsOfCells::add_corners(std::vector<CellPart>  &parts,
                            const SerialMesh::Cell &cell,
                            const unsigned int      name) const
  {
    for (unsigned int k = 0; k < 4; ++k)
      for (auto corner = std::lower_bound(corners.begin(),
                                          corners.end(),
                                          Ends{{cell.vertices[k], 0}});
           corner != corners.end() && (*corner)[0] == cell.vertices[k];
           ++corner)
        parts.push_back({name, k, (*corner)[1]});
  }



  NamedParts
  named_parts(const SerialMesh &mesh)
  {
    const PartsOfCells known(mesh);
    NamedParts         result;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        if (!known.may_have_names(mesh.cells[c]))
          continue;
        known.add_faces(result.faces, mesh.cells[c], c);
        known.add_edges(result.edges, mesh.cells[c], c);
        known.add_corners(result.corners, mesh.cells[c], c);
      }
    return result;
  }
} // namespace corotet
