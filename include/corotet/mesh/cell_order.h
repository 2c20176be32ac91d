// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_cell_order_h
#define corotet_mesh_cell_order_h

#include <corotet/mesh/mesh_part.h>

namespace corotet
{
  /// The relative work of a cell, 1 for a straight one. For a curved cell the
  /// matrix-free product takes about three times as long; the product with the
  /// exact tangent takes as long as for a straight one.
  inline unsigned int
  work_of(const MeshCells::Cell &cell)
  {
    return cell.curve == MeshCells::straight ? 1 : 2;
  }

  /**
   * Sorts the cells of all ranks along a Hilbert curve, so that neighbours are
   * close in memory, and gives each rank a piece of the sequence, all with
   * equal work up to one percent (curved cells count more): pieces end between
   * cubes of space that are as large as this tolerance allows. Cells at the
   * same place are sorted by their numbers. Then each cell gets the number of
   * its place in the sequence, which depends on nothing but the mesh. Vertices
   * without a cell are dropped. Each rank has a cell if there are as many cells
   * as ranks. Collective.
   */
  void
  sort_along_curve(MeshPart &part, const MPI_Comm comm);

  /**
   * The cells of a mesh in pieces as sort_along_curve() would make them, except
   * for some cells near the ends of pieces: they are found from the positions
   * of vertices and a sample of the cells, in a tenth of the time. The cells of
   * a piece are in the order of the mesh.
   */
  std::vector<std::vector<unsigned int>>
  pieces_of_curve(const MeshPart &part, const unsigned int n_pieces);
} // namespace corotet

#endif
