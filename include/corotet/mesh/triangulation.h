// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_triangulation_h
#define corotet_mesh_triangulation_h

#include <corotet/mesh/serial_mesh.h>

#include <deal.II/grid/tria.h>

namespace corotet
{
  /**
   * The boundary id of faces of the surface that belong to no boundary. No mesh
   * source uses it and no name selects it.
   */
  constexpr dealii::types::boundary_id unnamed_boundary =
    dealii::numbers::internal_face_boundary_id - 1;

  /// Makes @p tria of a checked mesh, with the cells in their order.
  void
  make_triangulation(const SerialMesh &mesh, dealii::Triangulation<3> &tria);

  /**
   * The active cells of @p tria and its faces on boundaries other than
   * unnamed_boundary. Without names.
   */
  SerialMesh
  make_serial_mesh(const dealii::Triangulation<3> &tria);

  /// Cuts every cell into eight, @p n_refinements times. Parts of curved cells
  /// are curved as these are, and parts of edges have the edges' names.
  void
  refine_uniformly(SerialMesh &mesh, const unsigned int n_refinements);

  /**
   * Sorts the cells along a Hilbert curve and the vertices in the order in
   * which the cells meet them, so that neighbours are close in memory.
   * Vertices of no cell are dropped.
   */
  void
  sort_along_curve(SerialMesh &mesh);
} // namespace corotet

#endif
