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
  /// A mesh that is spread over the ranks: the part of one of them, and what is
  /// said of the whole.
  struct SpreadMesh
  {
    MeshPart  part;
    UsedNames names;

    /// As in SerialMesh.
    std::string origin;
    double      read_time = 0;
    /// Wall time [s] of sharing it out, if one rank had it before.
    double                   scatter_time = 0;
    std::vector<std::string> remarks;
    std::set<unsigned int>   faceted;
  };
} // namespace corotet

#endif
