// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/node_graph.h>

#include <algorithm>
#include <utility>

namespace corotet
{
  NodeGraph
  transpose(const NodeGraph &graph, const int n_columns)
  {
    NodeGraph result;
    result.starts.assign(n_columns + 1, 0);
    for (const int column : graph.columns)
      ++result.starts[column + 1];
    for (int i = 0; i < n_columns; ++i)
      result.starts[i + 1] += result.starts[i];
    result.columns.resize(graph.columns.size());
    std::vector<int> next(result.starts);
    for (int row = 0; row < graph.n_rows(); ++row)
      for (int k = graph.starts[row]; k < graph.starts[row + 1]; ++k)
        result.columns[next[graph.columns[k]]++] = row;
    return result;
  }

  NodeGraph
  product(const NodeGraph &a, const NodeGraph &b, const int n_columns)
  {
    NodeGraph        result;
    std::vector<int> last_seen(n_columns, -1);
    for (int row = 0; row < a.n_rows(); ++row)
      {
        for (int k = a.starts[row]; k < a.starts[row + 1]; ++k)
          for (int l = b.starts[a.columns[k]]; l < b.starts[a.columns[k] + 1];
               ++l)
            if (std::exchange(last_seen[b.columns[l]], row) != row)
              result.columns.push_back(b.columns[l]);
        std::sort(result.columns.begin() + result.starts.back(),
                  result.columns.end());
        result.starts.push_back(result.columns.size());
      }
    return result;
  }

  std::vector<int>
  aggregate(const NodeGraph &graph, const std::function<bool(int)> &is_strong)
  {
    const int        n = graph.n_rows();
    std::vector<int> aggregates(n, -1);
    int              n_aggregates = 0;
    NodeGraph        strong;
    for (int node = 0; node < n; ++node)
      {
        for (int k = graph.starts[node]; k < graph.starts[node + 1]; ++k)
          if (graph.columns[k] == node || is_strong(k))
            strong.columns.push_back(graph.columns[k]);
        strong.starts.push_back(strong.columns.size());
      }
    const auto neighbours = [&](const int node) {
      return std::make_pair(strong.columns.begin() + strong.starts[node],
                            strong.columns.begin() + strong.starts[node + 1]);
    };
    const auto is_free = [&](const int node) { return aggregates[node] < 0; };
    for (int node = 0; node < n; ++node)
      {
        const auto [begin, end] = neighbours(node);
        if (end - begin > 1 && std::all_of(begin, end, is_free))
          {
            std::for_each(begin, end, [&](const int other) {
              aggregates[other] = n_aggregates;
            });
            ++n_aggregates;
          }
      }

    const std::vector<int> first(aggregates);
    std::vector<int>       votes(n_aggregates, 0);
    for (int node = 0; node < n; ++node)
      if (first[node] < 0)
        {
          const auto [begin, end] = neighbours(node);
          int best                = -1;
          for (auto other = begin; other != end; ++other)
            if (const int candidate = first[*other]; candidate >= 0)
              if (++votes[candidate] > (best < 0 ? 0 : votes[best]))
                best = candidate;
          for (auto other = begin; other != end; ++other)
            if (first[*other] >= 0)
              votes[first[*other]] = 0;
          aggregates[node] = best < 0 ? n_aggregates++ : best;
        }
    return aggregates;
  }
} // namespace corotet
