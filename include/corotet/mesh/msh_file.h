// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_msh_file_h
#define corotet_mesh_msh_file_h

#include <corotet/mesh/serial_mesh.h>

#include <string>

namespace corotet
{
  /**
   * The text of a gmsh file (version 4.1, ASCII) with a mesh, including its
   * curved cells, and a physical group for each name. FileMesh reads the same
   * mesh from it, to the last digit. Each id of a region, a boundary and an
   * edge is an entity of its own, and so is each corner.
   */
  std::string
  msh_text(const SerialMesh &mesh);

  /// Writes msh_text() to a file that is complete or absent. Throws
  /// MachineError if it cannot be written.
  void
  write_msh_file(const std::string &path, const SerialMesh &mesh);
} // namespace corotet

#endif
