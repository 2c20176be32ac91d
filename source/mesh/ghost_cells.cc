// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/ghost_cells.h>

#include <map>

#include "shared_vertices.h"

namespace corotet
{
  GhostCells::GhostCells(const LocalMesh &mesh)
    : comm(mesh.communicator)
  {
    const SharedVertices shared(mesh.cells, mesh.owners, mesh.vertices.size());
    std::map<unsigned int, Neighbor> by_rank;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (!mesh.is_owned(c))
        by_rank[mesh.owners[c]].ghosts.push_back(c);
      else
        shared.for_each_rank_at(mesh.cells[c], [&](const unsigned int rank) {
          if (rank == mesh.rank)
            return;
          std::vector<unsigned int> &owned = by_rank[rank].owned;
          if (owned.empty() || owned.back() != c)
            owned.push_back(c);
        });
    for (auto &[rank, neighbor] : by_rank)
      {
        neighbor.rank = rank;
        neighbors.push_back(std::move(neighbor));
      }
  }
} // namespace corotet
