// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/box_mesh.h>
#include <corotet/mesh/file_mesh.h>
#include <corotet/mesh/gmsh_mesh.h>
#include <corotet/mesh/mesh_sources.h>

namespace corotet
{
  std::vector<Candidate<MeshSource>>
  mesh_sources()
  {
    return with_added<MeshSource>(
      {candidate<MeshSource, BoxMesh>("box"),
       candidate<MeshSource, FileMesh>("file", "file"),
       candidate<MeshSource, GmshMesh>("gmsh")});
  }
} // namespace corotet
