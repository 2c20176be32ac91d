// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_msh_file_h
#define corotet_mesh_msh_file_h

#include <corotet/mesh/serial_mesh.h>

#include <string>

namespace corotet
{
  /**
   * The text of a file of gmsh (version 4.1, ASCII) with a mesh: with its
   * curved cells, and a physical group for each name. FileMesh makes the same
   * mesh of it, to the last digit. Each id of a region is an entity of its own,
   * and so is each id of a boundary and of edges, and each corner.
   */
  std::string
  msh_text(const SerialMesh &mesh);

  /**
   * Throws InputError unless a mesh that was read from the file @p origin may
   * be written to @p path: a file that is there is replaced if it is one of
   * gmsh, and another one.
   */
  void
  check_msh_target(const std::string &path, const std::string &origin);

  /// Writes it to a file that is complete or absent. Throws what
  /// check_msh_target() throws, and MachineError if it cannot be written.
  void
  write_msh_file(const std::string &path, const SerialMesh &mesh);
} // namespace corotet

#endif
