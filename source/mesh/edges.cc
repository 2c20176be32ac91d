// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/edges.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace corotet
{
  namespace
  {
    using Ends = std::array<unsigned int, 2>;



    void
    remark_left_out(SerialMesh                                &mesh,
                    const std::string                         &kind,
                    const NamedSets                           &named,
                    const std::map<unsigned int, std::size_t> &n_left_out,
                    const std::string                         &part)
    {
      for (const auto &[id, n] : n_left_out)
        mesh.remarks.push_back(
          fmt::format("{} {}s of '{}' are no {} of a tetrahedron; they are "
                      "left out",
                      n,
                      kind,
                      MeshNames(kind, named).name(id),
                      part));
    }



    std::array<unsigned int, 3>
    ascending_vertices(std::array<unsigned int, 3> vertices)
    {
      std::sort(vertices.begin(), vertices.end());
      return vertices;
    }



    // The line and what it was cut into, to the last.
    void
    add_parts(std::vector<SerialMesh::Edge>                 &edges,
              const dealii::Triangulation<3>::line_iterator &line,
              const std::vector<unsigned int>               &ids)
    {
      if (line->has_children())
        for (unsigned int i = 0; i < line->n_children(); ++i)
          add_parts(edges, line->child(i), ids);
      else
        for (const unsigned int id : ids)
          edges.push_back(
            {{{line->vertex_index(0), line->vertex_index(1)}}, id});
    }
  } // namespace



  std::array<unsigned int, 2>
  ascending_ends(const unsigned int a, const unsigned int b)
  {
    return {{std::min(a, b), std::max(a, b)}};
  }



  PartsOfCells::PartsOfCells(const SerialMesh &mesh)
    : mesh(mesh)
    , is_on_face(mesh.vertices.size())
    , is_end(mesh.vertices.size())
  {
    faces.reserve(mesh.faces.size());
    for (const SerialMesh::Face &face : mesh.faces)
      {
        faces.emplace_back(ascending_vertices(face.vertices), face.boundary);
        for (const unsigned int v : face.vertices)
          is_on_face[v] = true;
      }
    std::sort(faces.begin(), faces.end());
    edges.reserve(mesh.edges.size());
    for (std::size_t i = 0; i < mesh.edges.size(); ++i)
      {
        const auto [a, b] = mesh.edges[i].vertices;
        edges.emplace_back(ascending_ends(a, b), i);
        is_end[a] = is_end[b] = true;
      }
    std::sort(edges.begin(), edges.end());
    for (const SerialMesh::Corner &corner : mesh.corners)
      corners.push_back({{corner.vertex, corner.id}});
    std::sort(corners.begin(), corners.end());
  }



  std::vector<std::size_t>
  PartsOfCells::edges_between(const unsigned int a, const unsigned int b) const
  {
    std::vector<std::size_t> result;
    if (edges.empty() || !is_end[a] || !is_end[b])
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
    std::array<bool, 4>                is_on{};
    for (unsigned int i = 0; i < 4; ++i)
      is_on[i] = is_on_face[v[i]];
    if (std::count(is_on.begin(), is_on.end(), true) < 3)
      return;
    for (unsigned int f = 0; f < 4; ++f)
      {
        const auto [a, b, c] = corners_of_faces[f];
        if (!is_on[a] || !is_on[b] || !is_on[c])
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



  void
  check_edges_and_corners(SerialMesh &mesh)
  {
    if (mesh.edges.empty() && mesh.corners.empty())
      return;
    std::vector<bool> is_vertex(mesh.vertices.size()),
      is_edge(mesh.edges.size());
    {
      const PartsOfCells known(mesh);
      for (const SerialMesh::Cell &cell : mesh.cells)
        {
          for (const unsigned int v : cell.vertices)
            is_vertex[v] = true;
          for (const auto &[a, b] : ends_of_edges)
            for (const std::size_t i :
                 known.edges_between(cell.vertices[a], cell.vertices[b]))
              is_edge[i] = true;
        }
    }

    std::map<unsigned int, std::size_t>     n_left_out;
    std::vector<std::tuple<Ends, unsigned>> edges;
    for (std::size_t i = 0; i < mesh.edges.size(); ++i)
      if (const auto &[vertices, id] = mesh.edges[i]; is_edge[i])
        edges.emplace_back(ascending_ends(vertices[0], vertices[1]), id);
      else
        ++n_left_out[id];
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    mesh.edges.clear();
    for (const auto &[ends, id] : edges)
      mesh.edges.push_back({ends, id});
    remark_left_out(mesh, "line", mesh.edge_names, n_left_out, "edge");

    n_left_out.clear();
    std::vector<Ends> corners;
    for (const auto &[vertex, id] : mesh.corners)
      if (is_vertex[vertex])
        corners.push_back({{vertex, id}});
      else
        ++n_left_out[id];
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    mesh.corners.clear();
    for (const auto &[vertex, id] : corners)
      mesh.corners.push_back({vertex, id});
    remark_left_out(mesh, "point", mesh.corner_names, n_left_out, "corner");
  }



  std::vector<SerialMesh::Edge>
  parts_of_edges(const SerialMesh &coarse, const dealii::Triangulation<3> &tria)
  {
    std::vector<SerialMesh::Edge> result;
    if (coarse.edges.empty())
      return result;
    const PartsOfCells known(coarse);
    std::vector<bool>  is_done(coarse.edges.size());
    for (const auto &cell : tria.cell_iterators_on_level(0))
      for (const unsigned int l : cell->line_indices())
        {
          const auto                line = cell->line(l);
          std::vector<unsigned int> ids;
          for (const std::size_t i : known.edges_between(line->vertex_index(0),
                                                         line->vertex_index(1)))
            if (!is_done[i])
              {
                is_done[i] = true;
                ids.push_back(coarse.edges[i].id);
              }
          if (!ids.empty())
            add_parts(result, line, ids);
        }
    return result;
  }
} // namespace corotet
