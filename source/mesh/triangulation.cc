// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/edges.h>
#include <corotet/mesh/hilbert_curve.h>
#include <corotet/mesh/triangulation.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace corotet
{
  namespace
  {
    // deal.II gives faces of the surface that nobody mentions the boundary id
    // 0, which may be a named boundary's. So ids travel with these two swapped.
    dealii::types::boundary_id
    swapped(const dealii::types::boundary_id id)
    {
      if (id == 0)
        return unnamed_boundary;
      return id == unnamed_boundary ? 0 : id;
    }



    // The order of the vertices in which the cells meet them; invalid for
    // others.
    std::vector<unsigned int>
    number_vertices_by_cells(const SerialMesh &mesh)
    {
      std::vector<unsigned int> new_number(
        mesh.vertices.size(), dealii::numbers::invalid_unsigned_int);
      unsigned int n = 0;
      for (const SerialMesh::Cell &cell : mesh.cells)
        for (const unsigned int v : cell.vertices)
          if (new_number[v] == dealii::numbers::invalid_unsigned_int)
            new_number[v] = n++;
      return new_number;
    }



    // Cells by their place on the curve through their centres.
    std::vector<unsigned int>
    order_along_curve(const SerialMesh &mesh)
    {
      std::vector<dealii::Point<3>> centres(mesh.cells.size());
      for (unsigned int c = 0; c < centres.size(); ++c)
        for (const unsigned int v : mesh.cells[c].vertices)
          centres[c] += mesh.vertices[v] / 4.;
      const dealii::BoundingBox<3> box(centres);
      double                       extent = 0;
      for (unsigned int d = 0; d < 3; ++d)
        extent = std::max(extent, box.side_length(d));

      // The same unit of length in all directions: stretching a slender body
      // to a cube would make far cells neighbours on the curve.
      const double unit = extent > 0 ? ((1 << hilbert_bits) - 1) / extent : 0;
      std::vector<std::array<std::uint32_t, 3>> coordinates(centres.size());
      for (unsigned int c = 0; c < centres.size(); ++c)
        for (unsigned int d = 0; d < 3; ++d)
          coordinates[c][d] = static_cast<std::uint32_t>(
            unit * (centres[c][d] - box.lower_bound(d)));
      const std::vector<std::uint64_t> on_curve =
        places_on_hilbert_curve(coordinates);

      // Cells at the same place keep their order.
      std::vector<std::pair<std::uint64_t, unsigned int>> places;
      places.reserve(centres.size());
      for (unsigned int c = 0; c < centres.size(); ++c)
        places.emplace_back(on_curve[c], c);
      std::sort(places.begin(), places.end());
      std::vector<unsigned int> order;
      order.reserve(centres.size());
      for (const auto &[key, c] : places)
        order.push_back(c);
      return order;
    }
  } // namespace



  void
  make_triangulation(const SerialMesh &mesh, dealii::Triangulation<3> &tria)
  {
    std::vector<dealii::CellData<3>> cells;
    cells.reserve(mesh.cells.size());
    for (const SerialMesh::Cell &cell : mesh.cells)
      {
        dealii::CellData<3> &data = cells.emplace_back(4);
        data.vertices.assign(cell.vertices.begin(), cell.vertices.end());
        data.material_id = cell.region;
      }

    dealii::SubCellData surface;
    surface.boundary_quads.reserve(mesh.faces.size());
    for (const SerialMesh::Face &face : mesh.faces)
      {
        dealii::CellData<2> &data = surface.boundary_quads.emplace_back(3);
        data.vertices.assign(face.vertices.begin(), face.vertices.end());
        data.boundary_id = swapped(face.boundary);
      }

    tria.create_triangulation(mesh.vertices, cells, surface);
    for (const auto &face : tria.active_face_iterators())
      if (face->at_boundary())
        face->set_boundary_id(swapped(face->boundary_id()));
  }



  SerialMesh
  make_serial_mesh(const dealii::Triangulation<3> &tria)
  {
    SerialMesh mesh;
    mesh.vertices = tria.get_vertices();
    mesh.cells.reserve(tria.n_active_cells());
    for (const auto &cell : tria.active_cell_iterators())
      mesh.cells.push_back({{{cell->vertex_index(0),
                              cell->vertex_index(1),
                              cell->vertex_index(2),
                              cell->vertex_index(3)}},
                            cell->material_id()});
    for (const auto &face : tria.active_face_iterators())
      if (face->at_boundary() && face->boundary_id() != unnamed_boundary)
        mesh.faces.push_back({{{face->vertex_index(0),
                                face->vertex_index(1),
                                face->vertex_index(2)}},
                              face->boundary_id()});
    return mesh;
  }



  void
  refine_uniformly(SerialMesh &mesh, const unsigned int n_refinements)
  {
    if (n_refinements == 0)
      return;
    dealii::Triangulation<3> tria;
    make_triangulation(mesh, tria);
    tria.refine_global(n_refinements);
    SerialMesh refined = make_serial_mesh(tria);
    if (mesh.geometry_degree > 1)
      inherit_curves(mesh, tria, refined);
    // Vertices keep their numbers, so corners stay as they are.
    mesh.edges        = parts_of_edges(mesh, tria);
    mesh.vertices     = std::move(refined.vertices);
    mesh.cells        = std::move(refined.cells);
    mesh.faces        = std::move(refined.faces);
    mesh.curved_nodes = std::move(refined.curved_nodes);
  }



  void
  sort_along_curve(SerialMesh &mesh)
  {
    std::vector<SerialMesh::Cell> cells;
    cells.reserve(mesh.cells.size());
    for (const unsigned int c : order_along_curve(mesh))
      cells.push_back(mesh.cells[c]);
    mesh.cells = std::move(cells);

    const std::vector<unsigned int> new_number = number_vertices_by_cells(mesh);
    std::vector<dealii::Point<3>>   vertices(mesh.vertices.size());
    unsigned int                    n_used = 0;
    for (unsigned int v = 0; v < new_number.size(); ++v)
      if (new_number[v] != dealii::numbers::invalid_unsigned_int)
        {
          vertices[new_number[v]] = mesh.vertices[v];
          ++n_used;
        }
    vertices.resize(n_used);
    mesh.vertices = std::move(vertices);
    for (SerialMesh::Cell &cell : mesh.cells)
      for (unsigned int &v : cell.vertices)
        v = new_number[v];
    for (SerialMesh::Face &face : mesh.faces)
      for (unsigned int &v : face.vertices)
        v = new_number[v];
    for (SerialMesh::Edge &edge : mesh.edges)
      for (unsigned int &v : edge.vertices)
        v = new_number[v];
    for (SerialMesh::Corner &corner : mesh.corners)
      corner.vertex = new_number[corner.vertex];
  }

} // namespace corotet
