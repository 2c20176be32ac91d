// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_spread_mesh_h
#define corotet_mesh_spread_mesh_h

#include <corotet/mesh/mesh_part.h>
#include <corotet/mesh/used_names.h>

#include <set>
#include <string>
#include <vector>

namespace corotet
{
  /// A mesh that is spread over the ranks: one rank's part, and information
  /// about the whole mesh.
  struct SpreadMesh
  {
    MeshPart  part;
    UsedNames names;

    /// Like the members of SerialMesh with these names.
    std::string origin;
    double      read_time = 0;
    /// The wall time of distributing the mesh, if one rank had it before [s].
    double                   scatter_time = 0;
    std::vector<std::string> remarks;
    std::set<unsigned int>   faceted;
  };
} // namespace corotet

#endif
