// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/edges.h>
#include <corotet/mesh/facets.h>
#include <corotet/mesh/imported_mesh.h>

#include <deal.II/base/numbers.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace corotet
{
  namespace
  {
    using ImportedFace = ImportedMesh::Face;

    // The corners of the face opposite to vertex k of a tetrahedron.
    constexpr std::array<std::array<unsigned int, 3>, 4> corners_without{
      {{{1, 2, 3}}, {{0, 2, 3}}, {{0, 1, 3}}, {{0, 1, 2}}}};

    ImportedFace
    ascending(ImportedFace face)
    {
      std::sort(face.begin(), face.end());
      return face;
    }

    // The nodes of cell @p c.
    const unsigned int *
    nodes_of(const ImportedMesh &imported,
             const std::size_t   n_nodes,
             const std::size_t   c)
    {
      return imported.cells.data() + n_nodes * c;
    }

    // A face that belongs to only one cell.
    struct SurfaceFace
    {
      ImportedFace corners;
      std::size_t  cell;
      unsigned int number;
    };

    std::vector<SurfaceFace>
    surface_of(const ImportedMesh &imported, const std::size_t n_nodes)
    {
      std::vector<SurfaceFace> faces;
      const std::size_t        n_cells = imported.cells.size() / n_nodes;
      faces.reserve(4 * n_cells);
      for (std::size_t c = 0; c < n_cells; ++c)
        for (unsigned int k = 0; k < 4; ++k)
          {
            const unsigned int *nodes = nodes_of(imported, n_nodes, c);
            ImportedFace        corners;
            for (unsigned int i = 0; i < 3; ++i)
              corners[i] = nodes[corners_without[k][i]];
            faces.push_back({ascending(corners), c, k});
          }
      std::sort(faces.begin(),
                faces.end(),
                [](const SurfaceFace &a, const SurfaceFace &b) {
                  return a.corners < b.corners;
                });
      std::vector<SurfaceFace> surface;
      for (std::size_t i = 0; i < faces.size();)
        {
          std::size_t end = i + 1;
          while (end < faces.size() && faces[end].corners == faces[i].corners)
            ++end;
          if (end == i + 1)
            surface.push_back(faces[i]);
          i = end;
        }
      return surface;
    }

    // The nodes on each face and on each edge of a tetrahedron.
    struct NodePlaces
    {
      explicit NodePlaces(const unsigned int degree)
        : points(map_points(degree))
      {
        for (unsigned int i = 0; i < points.size(); ++i)
          {
            const dealii::Point<3> &x = points[i];
            // The barycentric coordinates; each is zero on the opposite face.
            const double b[] = {1 - x[0] - x[1] - x[2], x[0], x[1], x[2]};
            for (unsigned int k = 0; k < 4; ++k)
              if (std::abs(b[k]) < 1e-10)
                faces[k].push_back(i);
            for (unsigned int e = 0; e < 6; ++e)
              if (b[ends_of_edges[e][0]] + b[ends_of_edges[e][1]] > 1 - 1e-10)
                edges[e].push_back(i);
          }
      }

      std::vector<dealii::Point<3>>            points;
      std::array<std::vector<unsigned int>, 4> faces;
      std::array<std::vector<unsigned int>, 6> edges;
    };

    // The parts of the surface that a set of nodes consists of: faces with all
    // their nodes in the set; edges with all their nodes in the set that are
    // not on such faces; and remaining vertices.
    struct PartsOfSet
    {
      std::vector<ImportedFace>             faces;
      std::set<std::array<unsigned int, 2>> edges;
      std::set<unsigned int>                vertices;
    };

    PartsOfSet
    parts_of_set(const ImportedMesh              &imported,
                 const std::string               &name,
                 const std::vector<unsigned int> &set,
                 const std::vector<SurfaceFace>  &surface,
                 std::vector<std::string>        &remarks)
    {
      enum State : unsigned char
      {
        outside,
        inside,
        on_edge,
        on_face,
        vertex
      };
      const NodePlaces           places(imported.degree);
      const std::size_t          n_nodes = places.points.size();
      std::vector<unsigned char> state(imported.nodes.size(), outside);
      for (const unsigned int node : set)
        state[node] = inside;
      const auto is_whole = [&](const unsigned int              *nodes,
                                const std::vector<unsigned int> &of_part) {
        return std::all_of(of_part.begin(),
                           of_part.end(),
                           [&](const unsigned int i) {
                             return state[nodes[i]] != outside;
                           });
      };
      PartsOfSet result;
      for (const SurfaceFace &face : surface)
        {
          const unsigned int *nodes = nodes_of(imported, n_nodes, face.cell);
          if (!is_whole(nodes, places.faces[face.number]))
            continue;
          result.faces.push_back(face.corners);
          for (const unsigned int i : places.faces[face.number])
            state[nodes[i]] = on_face;
        }
      std::set<std::array<unsigned int, 2>> edges_of_faces;
      for (const ImportedFace &face : result.faces)
        for (unsigned int k = 0; k < 3; ++k)
          edges_of_faces.insert(ascending_ends(face[k], face[(k + 1) % 3]));
      for (const SurfaceFace &face : surface)
        for (unsigned int e = 0; e < 6; ++e)
          {
            const auto &[a, b]        = ends_of_edges[e];
            const unsigned int *nodes = nodes_of(imported, n_nodes, face.cell);
            const auto         &of_edge = places.edges[e];
            if (a == face.number || b == face.number ||
                !is_whole(nodes, of_edge) ||
                edges_of_faces.contains(ascending_ends(nodes[a], nodes[b])))
              continue;
            result.edges.insert(ascending_ends(nodes[a], nodes[b]));
            for (const unsigned int i : of_edge)
              if (state[nodes[i]] == inside)
                state[nodes[i]] = on_edge;
          }
      for (const SurfaceFace &face : surface)
        for (const unsigned int node : face.corners)
          if (state[node] == inside)
            {
              result.vertices.insert(node);
              state[node] = vertex;
            }
      const auto n_left_out = std::count(state.begin(), state.end(), inside);
      if (n_left_out > 0)
        remarks.push_back(
          fmt::format("{} nodes of the set '{}' are no corners of tetrahedra "
                      "on the surface, and on no face or edge there that has "
                      "all its nodes in the set; they are left out",
                      n_left_out,
                      name));
      return result;
    }

    // Names the edges and vertices of a set of nodes, if there are any.
    void
    add_edges_and_corners(SerialMesh                      &mesh,
                          const std::string               &name,
                          const PartsOfSet                &parts,
                          const std::vector<unsigned int> &vertex_of_node)
    {
      if (!parts.edges.empty())
        {
          const unsigned int id     = mesh.edge_names.names.size();
          mesh.edge_names.names[id] = name;
          for (const auto &[a, b] : parts.edges)
            mesh.edges.push_back(
              {{{vertex_of_node[a], vertex_of_node[b]}}, id});
        }
      if (!parts.vertices.empty())
        {
          const unsigned int id       = mesh.corner_names.names.size();
          mesh.corner_names.names[id] = name;
          for (const unsigned int node : parts.vertices)
            mesh.corners.push_back({vertex_of_node[node], id});
        }
    }

    // Adds the cells; returns the vertex of each node, if it is one.
    std::vector<unsigned int>
    add_cells(SerialMesh &mesh, const ImportedMesh &imported)
    {
      const std::size_t         n = map_points(imported.degree).size();
      std::vector<unsigned int> vertex_of_node(
        imported.nodes.size(), dealii::numbers::invalid_unsigned_int);
      mesh.geometry_degree = imported.degree;
      for (std::size_t c = 0; c < imported.cells.size() / n; ++c)
        {
          const unsigned int *nodes = nodes_of(imported, n, c);
          SerialMesh::Cell    cell{{}, 0};
          for (unsigned int k = 0; k < 4; ++k)
            {
              unsigned int &vertex = vertex_of_node[nodes[k]];
              if (vertex == dealii::numbers::invalid_unsigned_int)
                {
                  vertex = mesh.vertices.size();
                  mesh.vertices.push_back(imported.nodes[nodes[k]]);
                }
              cell.vertices[k] = vertex;
            }
          if (imported.degree > 1)
            {
              cell.curve = mesh.curved_nodes.size() / n;
              for (unsigned int i = 0; i < n; ++i)
                mesh.curved_nodes.push_back(imported.nodes[nodes[i]]);
            }
          mesh.cells.push_back(cell);
        }
      if (const std::string remark = remove_written_straight_maps(mesh);
          !remark.empty())
        mesh.remarks.push_back(remark);
      return vertex_of_node;
    }

    void
    add_regions(SerialMesh &mesh, const ImportedMesh &imported)
    {
      std::vector<unsigned int *> regions;
      regions.reserve(mesh.cells.size());
      for (SerialMesh::Cell &cell : mesh.cells)
        regions.push_back(&cell.region);
      for (const auto &[name, cells] : imported.cell_sets)
        mesh.regions.add(name, cells, regions);
    }

    void
    add_boundaries(SerialMesh                      &mesh,
                   const std::vector<unsigned int> &vertex_of_node,
                   const std::map<std::string, std::vector<ImportedFace>> &sets)
    {
      std::map<ImportedFace, std::size_t>             numbers;
      std::map<std::string, std::vector<std::size_t>> members;
      std::map<std::string, std::size_t>              n_left_out;
      for (const auto &[name, faces] : sets)
        for (const ImportedFace &face : faces)
          {
            ImportedFace vertices;
            for (unsigned int k = 0; k < 3; ++k)
              vertices[k] = vertex_of_node[face[k]];
            if (std::count(vertices.begin(),
                           vertices.end(),
                           dealii::numbers::invalid_unsigned_int) > 0)
              {
                ++n_left_out[name];
                continue;
              }
            const auto [number, is_new] =
              numbers.emplace(ascending(vertices), mesh.faces.size());
            if (is_new)
              mesh.faces.push_back({vertices, 0});
            members[name].push_back(number->second);
          }
      std::vector<unsigned int *> boundaries;
      for (SerialMesh::Face &face : mesh.faces)
        boundaries.push_back(&face.boundary);
      for (const auto &[name, faces] : members)
        mesh.boundaries.add(name, faces, boundaries);
      for (const auto &[name, n_faces] : n_left_out)
        mesh.remarks.push_back(
          fmt::format("{} triangles of '{}' have corners that no tetrahedron "
                      "has; they are left out",
                      n_faces,
                      name));
    }
  } // namespace



  SerialMesh
  serial_mesh(const ImportedMesh &imported)
  {
    SerialMesh mesh;
    mesh.origin                                    = imported.origin;
    mesh.remarks                                   = imported.remarks;
    const std::vector<unsigned int> vertex_of_node = add_cells(mesh, imported);
    add_regions(mesh, imported);

    auto sets = imported.face_sets;
    if (!imported.node_sets.empty())
      {
        const auto surface =
          surface_of(imported, map_points(imported.degree).size());
        for (const auto &[name, nodes] : imported.node_sets)
          if (sets.contains(name))
            mesh.remarks.push_back("the set of nodes '" + name +
                                   "' is left out, as a set of faces has that "
                                   "name");
          else
            {
              PartsOfSet parts =
                parts_of_set(imported, name, nodes, surface, mesh.remarks);
              add_edges_and_corners(mesh, name, parts, vertex_of_node);
              if (!parts.faces.empty())
                sets[name] = std::move(parts.faces);
            }
      }
    add_boundaries(mesh, vertex_of_node, sets);
    // Straight cells may have additional nodes in the file.
    if (mesh.geometry_degree == 1)
      remark_facets(mesh, faceted_boundaries(mesh));
    return mesh;
  }
} // namespace corotet
