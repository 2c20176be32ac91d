// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_target_h
#define corotet_mesh_mesh_target_h

#include <corotet/mesh/serial_mesh.h>

#include <string>

namespace corotet
{
  /**
   * Throws InputError unless a mesh that was read from the file @p origin may
   * be written to @p path, a .msh or an .h5: an existing file is replaced only
   * if it is a mesh of that kind and not @p origin itself.
   */
  void
  check_mesh_target(const std::string &path, const std::string &origin);

  /// Writes a checked mesh in the format that the name's ending tells: for gmsh
  /// (write_msh_file()) or for runs on many ranks (write_hdf5_mesh()). Throws
  /// what check_mesh_target() throws, and MachineError if the file cannot be
  /// written.
  void
  write_mesh(const std::string &path, const SerialMesh &mesh);
} // namespace corotet

#endif
