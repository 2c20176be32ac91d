// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_gmsh_mesh_h
#define corotet_mesh_gmsh_mesh_h

#include <corotet/mesh/file_mesh.h>
#include <corotet/mesh/gmsh_model.h>

namespace corotet
{
  /// The mesh source "gmsh": the name that FileMesh had before it read other
  /// formats.
  class GmshMesh : public FileMesh
  {
  public:
    GmshMesh()
      : FileMesh("gmsh")
    {}
  };

  /**
   * The mesh of a model whose parts fit together: physical volumes become
   * regions, physical surfaces boundaries, and physical curves and points names
   * of edges and corners, with gmsh's names and ids. Groups with the same
   * dimension and name are united, with the id of the first. Without any
   * physical volume all cells belong to region 0; if there are some, tetrahedra
   * outside of them are left out with a remark, as gmsh does when it writes a
   * file. Nodes that no element uses are dropped.
   *
   * Throws InputError that blames the file @p path if the model has other cells
   * than tetrahedra of one degree, or nodes without coordinates. @p
   * has_geometry tells that gmsh knows which of its surfaces are curved.
   */
  SerialMesh
  mesh_of_model(const GmshModel   &model,
                const std::string &path,
                const bool         has_geometry);
} // namespace corotet

#endif
