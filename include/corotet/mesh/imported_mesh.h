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
   * A mesh as it is in files of other programs: tetrahedra, and sets of them,
   * of faces and of nodes, which may overlap.
   */
  struct ImportedMesh
  {
    /// The corners of a triangle, in any order.
    using Face = std::array<unsigned int, 3>;

    std::vector<dealii::Point<3>> nodes;

    /// The degree of the tetrahedra: 1 (four nodes), 2 (ten) or 3 (twenty).
    unsigned int degree = 1;
    /// Nodes of one tetrahedron after another, in the order of the support
    /// points of FE_SimplexP(degree).
    std::vector<unsigned int> cells;

    /// Sets of tetrahedra (by their numbers), of faces and of nodes, by name.
    std::map<std::string, std::vector<std::size_t>>  cell_sets;
    std::map<std::string, std::vector<Face>>         face_sets;
    std::map<std::string, std::vector<unsigned int>> node_sets;

    /// The file, and remarks for the user about how it was read.
    std::string              origin;
    std::vector<std::string> remarks;
  };

  /**
   * Converts to the mesh that corotet computes on. Sets of tetrahedra become
   * regions, and sets of faces boundaries. A set of nodes becomes the boundary
   * of the faces of the surface whose nodes are all in the set; other edges of
   * the surface whose nodes are all in the set become named edges, and its
   * remaining vertices on the surface corners, with the same name; other nodes
   * are left out with a remark. Tetrahedra whose nodes are off the straight
   * position become curved cells.
   */
  SerialMesh
  serial_mesh(const ImportedMesh &imported);
} // namespace corotet

#endif
