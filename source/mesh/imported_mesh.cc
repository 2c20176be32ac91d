// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/imported_mesh.h>

#include <deal.II/base/numbers.h>

#include <fmt/format.h>

#include <algorithm>

namespace corotet
{
  namespace
  {
    using ImportedFace = ImportedMesh::Face;

    // The corners of the face of a tetrahedron that does not have its vertex k.
    constexpr std::array<std::array<unsigned int, 3>, 4> corners_of_faces{
      {{{1, 2, 3}}, {{0, 2, 3}}, {{0, 1, 3}}, {{0, 1, 2}}}};

    ImportedFace
    ascending(ImportedFace face)
    {
      std::sort(face.begin(), face.end());
      return face;
    }

    // Nodes of the cell @p c.
    const unsigned int *
    nodes_of(const ImportedMesh &imported,
             const std::size_t   n_nodes,
             const std::size_t   c)
    {
      return imported.cells.data() + n_nodes * c;
    }

    // A face of only one cell.
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
              corners[i] = nodes[corners_of_faces[k][i]];
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

    // Places of the nodes on the faces of a tetrahedron.
    std::array<std::vector<unsigned int>, 4>
    nodes_of_faces(const unsigned int degree)
    {
      std::array<std::vector<unsigned int>, 4> result;
      const std::vector<dealii::Point<3>>      points = map_points(degree);
      for (unsigned int i = 0; i < points.size(); ++i)
        {
          const dealii::Point<3> &x = points[i];
          // Barycentric coordinates, which are zero on the opposite face.
          const double coordinates[] = {1 - x[0] - x[1] - x[2],
                                        x[0],
                                        x[1],
                                        x[2]};
          for (unsigned int k = 0; k < 4; ++k)
            if (std::abs(coordinates[k]) < 1e-10)
              result[k].push_back(i);
        }
      return result;
    }

    // The faces of the surface whose nodes are all in the set; others are
    // counted by a remark.
    std::vector<ImportedFace>
    faces_of_nodes(const ImportedMesh              &imported,
                   const std::string               &name,
                   const std::vector<unsigned int> &set,
                   const std::vector<SurfaceFace>  &surface,
                   std::vector<std::string>        &remarks)
    {
      const auto                 places  = nodes_of_faces(imported.degree);
      const std::size_t          n_nodes = map_points(imported.degree).size();
      std::vector<unsigned char> state(imported.nodes.size());
      for (const unsigned int node : set)
        state[node] = 1;
      std::vector<ImportedFace> result;
      for (const SurfaceFace &face : surface)
        {
          const unsigned int *nodes = nodes_of(imported, n_nodes, face.cell);
          const std::vector<unsigned int> &of_face = places[face.number];
          if (!std::all_of(of_face.begin(),
                           of_face.end(),
                           [&](const unsigned int i) {
                             return state[nodes[i]] > 0;
                           }))
            continue;
          result.push_back(face.corners);
          for (const unsigned int i : of_face)
            state[nodes[i]] = 2;
        }
      const auto n_left_out = std::count(state.begin(), state.end(), 1);
      if (n_left_out > 0)
        remarks.push_back(
          fmt::format("{} nodes of the set '{}' are on no face of the surface "
                      "that has all its nodes in the set; they are left out",
                      n_left_out,
                      name));
      return result;
    }

    // Returns the vertex that each node is, if any.
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
      remove_straight_maps(mesh);
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
          if (sets.count(name) > 0)
            mesh.remarks.push_back("the set of nodes '" + name +
                                   "' is left out, as a set of faces has that "
                                   "name");
          else if (auto faces = faces_of_nodes(
                     imported, name, nodes, surface, mesh.remarks);
                   !faces.empty())
            sets[name] = std::move(faces);
      }
    add_boundaries(mesh, vertex_of_node, sets);
    return mesh;
  }
} // namespace corotet
