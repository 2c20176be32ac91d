// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "shared_vertices.h"

namespace corotet
{
  SharedVertices::SharedVertices(
    const std::vector<SerialMesh::Cell>            &cells,
    const std::vector<dealii::types::subdomain_id> &owners,
    const std::size_t                               n_vertices)
    : is_shared(n_vertices, false)
  {
    constexpr unsigned int    none = dealii::numbers::invalid_unsigned_int;
    std::vector<unsigned int> first_rank(n_vertices, none);
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (const unsigned int v : cells[c].vertices)
        if (first_rank[v] == none)
          first_rank[v] = owners[c];
        else if (first_rank[v] != owners[c])
          {
            ranks.emplace_back(v, first_rank[v]);
            ranks.emplace_back(v, owners[c]);
            is_shared[v] = true;
          }
    std::sort(ranks.begin(), ranks.end());
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  }
} // namespace corotet
