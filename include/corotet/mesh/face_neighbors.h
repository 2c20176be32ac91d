// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_face_neighbors_h
#define corotet_mesh_face_neighbors_h

#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/serial_mesh.h>

#include <array>
#include <functional>
#include <vector>

namespace corotet
{
  /// The cell behind each face of each cell; corners_of_faces numbers the
  /// faces.
  using CellNeighbors = std::vector<std::array<unsigned int, 4>>;

  /**
   * The neighbors of cells, @p none where no other cell has the face. Throws an
   * InputError if a triangle belongs to more than two cells, or to two on the
   * same side of it, unless none of these cells satisfies @p is_owned (then
   * another rank finds it). Faces that have a neighbor in @p known, a result of
   * undisputed_neighbors(), are not checked again.
   */
  CellNeighbors
  find_neighbors(const MeshCells                                 &mesh,
                 const unsigned int                               none,
                 const std::string                               &origin,
                 const std::function<bool(const unsigned int c)> &is_owned,
                 CellNeighbors                                    known = {});

  /// The neighbors in a part of a mesh. A wrong face has @p none, so that
  /// find_neighbors(), which knows more cells, checks it again.
  CellNeighbors
  undisputed_neighbors(const MeshCells &mesh, const unsigned int none);
} // namespace corotet

#endif
