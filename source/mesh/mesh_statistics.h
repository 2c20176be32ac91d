// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_statistics_h
#define corotet_mesh_mesh_statistics_h

#include <corotet/base/log.h>
#include <corotet/mesh/local_mesh.h>
#include <corotet/mesh/mesh_quality.h>

namespace corotet
{
  /// The figures of a mesh for the log, computed from the parts of all ranks,
  /// without the number of vertices.
  struct MeshStatistics
  {
    /// Computes the figures. Collective.
    MeshStatistics(const MeshCells   &part,
                   const double       least_determinant,
                   const unsigned int element_degree,
                   const MPI_Comm     comm);

    void
    log_lines(const std::uint64_t n_vertices, Log &log) const;

    MeshQuality  quality;
    std::size_t  n_cells, n_curved = 0;
    unsigned int geometry_degree, element_degree;
    /// The result of check_cells_on_ranks().
    double least_determinant;
  };

  /// The number of vertices of the mesh on all ranks. Collective.
  std::uint64_t
  number_of_vertices(const LocalMesh &mesh);
} // namespace corotet

#endif
