// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_check_surface_h
#define corotet_mesh_check_surface_h

#include <corotet/mesh/check_mesh.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace corotet
{
  /// The triangles that belong to only one cell, and their vertices.
  struct CellSurface
  {
    std::vector<dealii::Point<3>> vertices;
    /// The number by which all ranks know each vertex.
    std::vector<std::uint64_t> vertex_numbers;
    std::vector<Triangle>      triangles;
    /// The number of triangles of this rank's cells, which come first; the
    /// others belong to other ranks.
    std::size_t n_own = 0;
  };

  /**
   * The surface of the cells for which @p is_owned is true: faces without a
   * neighbor, as find_neighbors() gives them. @p number gives the number by
   * which all ranks know a vertex.
   */
  CellSurface
  cell_surface(
    const MeshCells                                          &mesh,
    const std::vector<std::array<unsigned int, 4>>           &neighbors,
    const unsigned int                                        none,
    const std::function<bool(const unsigned int c)>          &is_owned,
    const std::function<std::uint64_t(const unsigned int v)> &number);

  /// Adds the triangles of other ranks that are near those of @p surface.
  /// Collective.
  void
  add_triangles_nearby(CellSurface &surface, const MPI_Comm comm);

  /**
   * The part of check_mesh() that checks the surface: throws an InputError if
   * one of this rank's triangles touches another elsewhere than in shared
   * vertices and edges.
   *
   * This finds every place where cells do not fit together. The surface has two
   * layers there, and a vertex of one lies on a triangle of the other or, at
   * crossing diagonals, the centre of a triangle does.
   */
  void
  check_surface(const CellSurface &surface, const std::string &origin);
} // namespace corotet

#endif
