// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_shared_vertices_h
#define corotet_mesh_shared_vertices_h

#include <corotet/mesh/serial_mesh.h>

#include <deal.II/base/types.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * The vertices whose cells are owned by several ranks.
   */
  class SharedVertices
  {
  public:
    /// Cells, and the rank that owns each of them.
    SharedVertices(const std::vector<SerialMesh::Cell>            &cells,
                   const std::vector<dealii::types::subdomain_id> &owners,
                   const std::size_t                               n_vertices);

    /// Calls action(rank) for each rank that owns a cell with vertices of
    /// @p cell; of all its vertices, so perhaps several times for one rank.
    template <typename Action>
    void
    for_each_rank_at(const SerialMesh::Cell &cell, const Action &action) const
    {
      for (const unsigned int v : cell.vertices)
        if (is_shared[v])
          for (auto pair =
                 std::lower_bound(ranks.begin(), ranks.end(), std::pair(v, 0u));
               pair != ranks.end() && pair->first == v;
               ++pair)
            action(pair->second);
    }

  private:
    std::vector<bool> is_shared;
    /// A shared vertex and one of its ranks, sorted.
    std::vector<std::pair<unsigned int, unsigned int>> ranks;
  };
} // namespace corotet

#endif
