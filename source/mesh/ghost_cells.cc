// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/ghost_cells.h>

#include <map>
#include <utility>

namespace corotet
{
  GhostCells::GhostCells(const LocalMesh &mesh)
    : comm(mesh.communicator)
  {
    std::map<unsigned int, Neighbor> by_rank;
    // Vertices of ghosts, and the ranks that own cells with them.
    std::vector<bool> has_ghosts(mesh.vertices.size());
    std::vector<std::pair<unsigned int, unsigned int>> ranks;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (!mesh.is_owned(c))
        {
          by_rank[mesh.owners[c]].ghosts.push_back(c);
          for (const unsigned int v : mesh.cells[c].vertices)
            {
              has_ghosts[v] = true;
              ranks.emplace_back(v, mesh.owners[c]);
            }
        }
    std::sort(ranks.begin(), ranks.end());
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.is_owned(c))
        for (const unsigned int v : mesh.cells[c].vertices)
          if (has_ghosts[v])
            for (auto pair = std::lower_bound(ranks.begin(),
                                              ranks.end(),
                                              std::pair(v, 0u));
                 pair != ranks.end() && pair->first == v;
                 ++pair)
              {
                std::vector<unsigned int> &owned = by_rank[pair->second].owned;
                if (owned.empty() || owned.back() != c)
                  owned.push_back(c);
              }
    for (auto &[rank, neighbor] : by_rank)
      {
        neighbor.rank = rank;
        neighbors.push_back(std::move(neighbor));
      }
  }
} // namespace corotet
