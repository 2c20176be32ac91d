// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_serial_meshes_h
#define corotet_tests_serial_meshes_h

#include <corotet/mesh/mesh_part.h>
#include <corotet/mesh/refinement.h>
#include <corotet/mesh/selections.h>
#include <corotet/mesh/used_names.h>

#include <utility>

namespace corotet::tests
{
  /// Refines a mesh that one rank has. Vertices keep their numbers.
  inline void
  refine_uniformly(SerialMesh &mesh, const unsigned int n_refinements)
  {
    NamedParts names = named_parts(mesh);
    MeshPart   part  = whole_part(mesh, std::move(names));
    corotet::refine_uniformly(part, n_refinements, MPI_COMM_SELF);
    SerialMesh refined = serial_mesh(std::move(part));
    mesh.faces         = std::move(refined.faces);
    mesh.edges         = std::move(refined.edges);
    static_cast<MeshCells &>(mesh) =
      std::move(static_cast<MeshCells &>(refined));
  }

  /// A mesh that one rank has, with the names of selections added.
  inline SerialMesh
  with_selections(const SerialMesh &mesh, const SelectionParameters &selections)
  {
    Log       log(MPI_COMM_SELF, true);
    UsedNames names(mesh);
    LocalMesh local = distribute(mesh, MPI_COMM_SELF);
    select(local, names, selections, log);
    SerialMesh result   = serial_mesh(std::move(local));
    result.regions      = names.regions;
    result.boundaries   = names.boundaries;
    result.edge_names   = names.edges;
    result.corner_names = names.corners;
    result.origin       = mesh.origin;
    return result;
  }
} // namespace corotet::tests

#endif
