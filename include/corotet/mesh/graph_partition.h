// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_graph_partition_h
#define corotet_mesh_graph_partition_h

#include <corotet/base/enumeration.h>
#include <corotet/mesh/local_mesh.h>

namespace corotet
{
  /**
   * How the cells of a mesh are shared out among the ranks.
   */
  enum class Partitioner
  {
    /// In pieces of the curve that cells are sorted along.
    hilbert_curve,
    /// In parts of the graph of cells and faces.
    pt_scotch
  };

  /// Those that the library was built with.
  const Enumeration<Partitioner> &
  partitioners();

  /// Of all ranks, how many faces of cells have a cell of another rank behind
  /// them. Each is counted once. Collective.
  std::uint64_t
  n_faces_between_ranks(const LocalMesh &mesh);

  /**
   * Gives each rank the cells that PT-Scotch [chevalier2008] finds for it, so
   * that ranks have equal work up to one percent, and few faces are between
   * them. @p mesh is as sort_along_curve() and with_cells_beside() make it;
   * cells keep their numbers, and those of a rank are in ascending order. The
   * answer is the same at each call. Where PT-Scotch would leave a rank without
   * a cell, cells stay where they are. Throws InputError if it cannot count the
   * cells, ComputationError if it fails or is not there. Collective.
   */
  MeshPart
  partition_graph(const LocalMesh &mesh);
} // namespace corotet

#endif
