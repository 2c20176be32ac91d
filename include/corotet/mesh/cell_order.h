// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_cell_order_h
#define corotet_mesh_cell_order_h

#include <corotet/mesh/mesh_part.h>

namespace corotet
{
  /// Work of a cell, if that of a straight one is 1: on a curved one the
  /// matrix-free product takes about three times as long, that with the exact
  /// tangent as long as on a straight one.
  inline unsigned int
  work_of(const MeshCells::Cell &cell)
  {
    return cell.curve == MeshCells::straight ? 1 : 2;
  }

  /**
   * Sorts the cells of all ranks along a Hilbert curve, so that neighbours are
   * close in memory, and gives each rank a piece of the sequence, all with
   * equal work up to one percent (that of curved cells is larger): pieces end
   * between cubes of space, as large ones as that allows. Cells at the same
   * place are sorted by their numbers. Then cells have the numbers of their
   * places in the sequence, which depend on nothing but the mesh. Vertices of
   * no cell are dropped. No rank is without a cell if there are as many as
   * ranks. Collective.
   */
  void
  sort_along_curve(MeshPart &part, const MPI_Comm comm);

  /**
   * The cells of a mesh in pieces as sort_along_curve() would make them, but
   * for some near the ends of a piece: from the places of vertices, and a
   * sample of cells, in a tenth of the time. In the order of the mesh.
   */
  std::vector<std::vector<unsigned int>>
  pieces_of_curve(const MeshPart &part, const unsigned int n_pieces);
} // namespace corotet

#endif
