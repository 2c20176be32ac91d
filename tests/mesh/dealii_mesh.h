// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_mesh_dealii_mesh_h
#define corotet_tests_mesh_dealii_mesh_h

#include <corotet/mesh/serial_mesh.h>

#include <deal.II/grid/tria.h>

namespace corotet::tests
{
  // deal.II gives the boundary id 0 to all faces of the surface without an id,
  // which may be the id of a named boundary. So deal.II gets 0 and
  // unnamed_boundary swapped.
  inline dealii::types::boundary_id
  swapped(const dealii::types::boundary_id id)
  {
    if (id == 0)
      return unnamed_boundary;
    return id == unnamed_boundary ? 0 : id;
  }

  /// Makes deal.II's triangulation of a mesh, with the cells in the same order.
  inline void
  make_triangulation(const SerialMesh &mesh, dealii::Triangulation<3> &tria)
  {
    std::vector<dealii::CellData<3>> cells;
    for (const SerialMesh::Cell &cell : mesh.cells)
      {
        dealii::CellData<3> &data = cells.emplace_back(4);
        data.vertices.assign(cell.vertices.begin(), cell.vertices.end());
        data.material_id = cell.region;
      }
    dealii::SubCellData surface;
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

  /// The active cells of a triangulation, and its faces on named boundaries.
  inline SerialMesh
  make_serial_mesh(const dealii::Triangulation<3> &tria)
  {
    SerialMesh mesh;
    mesh.vertices = tria.get_vertices();
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
} // namespace corotet::tests

#endif
