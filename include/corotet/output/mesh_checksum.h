// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_mesh_checksum_h
#define corotet_output_mesh_checksum_h

#include <corotet/mesh/mesh.h>

#include <string>

namespace corotet
{
  /// The checksum of all cells: their vertices, curved maps, and names, with
  /// those of their faces, edges and corners; the same on any number of ranks.
  /// Collective.
  std::string
  mesh_checksum(const Mesh &mesh);
} // namespace corotet

#endif
