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
    // Pairs of a vertex of ghosts and a rank that owns cells with it; last_rank
    // is the last such rank found for each vertex.
    constexpr unsigned int    none = dealii::numbers::invalid_unsigned_int;
    std::vector<unsigned int> last_rank(mesh.vertices.size(), none);
    std::vector<std::pair<unsigned int, unsigned int>> ranks;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (!mesh.is_owned(c))
        {
          const unsigned int rank = mesh.owners[c];
          by_rank[rank].ghosts.push_back(c);
          for (const unsigned int v : mesh.cells[c].vertices)
            if (std::exchange(last_rank[v], rank) != rank)
              ranks.emplace_back(v, rank);
        }
    std::sort(ranks.begin(), ranks.end());
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        const auto &v = mesh.cells[c].vertices;
        // All bits of none are set, so the result is none only if all four are
        // none.
        if (!mesh.is_owned(c) || (last_rank[v[0]] & last_rank[v[1]] &
                                  last_rank[v[2]] & last_rank[v[3]]) == none)
          continue;
        for (const unsigned int vertex : v)
          for (auto pair = std::lower_bound(ranks.begin(),
                                            ranks.end(),
                                            std::pair(vertex, 0u));
               pair != ranks.end() && pair->first == vertex;
               ++pair)
            {
              std::vector<unsigned int> &owned = by_rank[pair->second].owned;
              if (owned.empty() || owned.back() != c)
                owned.push_back(c);
            }
      }
    for (auto &[rank, neighbor] : by_rank)
      {
        neighbor.rank = rank;
        neighbors.push_back(std::move(neighbor));
      }
  }
} // namespace corotet
