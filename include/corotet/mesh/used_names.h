// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_used_names_h
#define corotet_mesh_used_names_h

#include <corotet/mesh/serial_mesh.h>

#include <mpi.h>

namespace corotet
{
  /// What the parts of a mesh are called: every id that they have, and names of
  /// these.
  struct UsedNames
  {
    UsedNames() = default;

    /// Without names that nothing has.
    explicit UsedNames(const SerialMesh &mesh);

    /// Gives all ranks what rank 0 has. Collective.
    void
    broadcast(const MPI_Comm comm);

    NamedSets regions;
    NamedSets boundaries;
    NamedSets edges;
    NamedSets corners;
  };
} // namespace corotet

#endif
