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
  /// Of each face of each cell, as corners_of_faces numbers them, the cell
  /// behind it.
  using CellNeighbors = std::vector<std::array<unsigned int, 4>>;

  /**
   * The neighbors of cells, @p none where no other cell has the face. Throws an
   * InputError if a triangle belongs to more than two cells, or to two on the
   * same side of it; unless @p is_owned says of all of them that they are
   * others' (another rank finds it then). Faces with a neighbor in @p known,
   * those of undisputed_neighbors(), are not looked at again.
   */
  CellNeighbors
  find_neighbors(const MeshCells                                 &mesh,
                 const unsigned int                               none,
                 const std::string                               &origin,
                 const std::function<bool(const unsigned int c)> &is_owned,
                 CellNeighbors                                    known = {});

  /// The same of a part of a mesh, where a wrong face has @p none: so
  /// find_neighbors() looks at it, which knows more of its cells.
  CellNeighbors
  undisputed_neighbors(const MeshCells &mesh, const unsigned int none);
} // namespace corotet

#endif
