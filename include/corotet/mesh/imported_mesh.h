// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_imported_mesh_h
#define corotet_mesh_imported_mesh_h

#include <corotet/mesh/serial_mesh.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * A mesh as other programs' files have it: tetrahedra, and sets of them, of
   * faces and of nodes, which may overlap.
   */
  struct ImportedMesh
  {
    /// Corners of a triangle, in any order.
    using Face = std::array<unsigned int, 3>;

    std::vector<dealii::Point<3>> nodes;

    /// Of the tetrahedra: 1 (four nodes), 2 (ten) or 3 (twenty).
    unsigned int degree = 1;
    /// Nodes of one tetrahedron after another, in the order of the support
    /// points of FE_SimplexP(degree).
    std::vector<unsigned int> cells;

    /// Numbers of tetrahedra.
    std::map<std::string, std::vector<std::size_t>>  cell_sets;
    std::map<std::string, std::vector<Face>>         face_sets;
    std::map<std::string, std::vector<unsigned int>> node_sets;

    /// The file, and what the user should know about how it was read.
    std::string              origin;
    std::vector<std::string> remarks;
  };

  /**
   * The mesh that corotet computes on. Sets of tetrahedra become regions, sets
   * of faces boundaries, and sets of nodes the boundaries that consist of the
   * faces of the surface whose nodes are all in the set. What they have besides
   * on the surface are edges whose nodes are all in the set, and corners, with
   * the same name; other nodes are left out with a remark. Tetrahedra whose
   * nodes are off the straight position become curved cells.
   */
  SerialMesh
  serial_mesh(const ImportedMesh &imported);
} // namespace corotet

#endif
