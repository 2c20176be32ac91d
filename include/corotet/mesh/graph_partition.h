// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_graph_partition_h
#define corotet_mesh_graph_partition_h

#include <corotet/base/enumeration.h>
#include <corotet/mesh/local_mesh.h>

namespace corotet
{
  /**
   * The methods to distribute the cells of a mesh to the ranks.
   */
  enum class Partitioner
  {
    /// Pieces of the curve that cells are sorted along.
    hilbert_curve,
    /// Parts of the graph of cells and faces.
    pt_scotch
  };

  /// The partitioners that the library was built with.
  const Enumeration<Partitioner> &
  partitioners();

  /// The number of faces between cells of different ranks, in the whole mesh.
  /// Each face is counted once. Collective.
  std::uint64_t
  n_faces_between_ranks(const LocalMesh &mesh);

  /**
   * Gives each rank the cells that PT-Scotch [chevalier2008] finds for it, so
   * that ranks have equal work up to one percent, and few faces are between
   * them. @p mesh must come from sort_along_curve() and with_cells_beside().
   * Cells keep their numbers, and those of a rank are in ascending order. The
   * result is the same at each call. If PT-Scotch would leave a rank without
   * cells, cells stay where they are. Throws InputError if there are too many
   * cells for PT-Scotch's numbers, ComputationError if it fails or is not
   * available. Collective.
   */
  MeshPart
  partition_graph(const LocalMesh &mesh);
} // namespace corotet

#endif
