// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_used_names_h
#define corotet_mesh_used_names_h

#include <corotet/mesh/serial_mesh.h>

#include <mpi.h>

namespace corotet
{
  /// The names of the parts of a mesh: all ids that they have, and the names of
  /// these ids.
  struct UsedNames
  {
    UsedNames() = default;

    /// The names of @p mesh, without those that no part has.
    explicit UsedNames(const SerialMesh &mesh);

    /// Gives all ranks the names that rank 0 has. Collective.
    void
    broadcast(const MPI_Comm comm);

    NamedSets regions;
    NamedSets boundaries;
    NamedSets edges;
    NamedSets corners;
  };
} // namespace corotet

#endif
