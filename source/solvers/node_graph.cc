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

  std::vector<int>
  join(const NodeGraph        &graph,
       const std::vector<int> &aggregates,
       const unsigned int      most)
  {
    const int        n_rows = graph.n_rows();
    const int        n      = n_rows == 0 ?
                                0 :
                                *std::max_element(aggregates.begin(), aggregates.end()) + 1;
    std::vector<int> joined(n, -1), n_entries(n, 0), beside;
    // The rows of each aggregate.
    NodeGraph of_rows;
    of_rows.columns = aggregates;
    for (int row = 0; row < n_rows; ++row)
      of_rows.starts.push_back(row + 1);
    const NodeGraph rows     = transpose(of_rows, n);
    int             n_joined = 0;
    for (int first = 0; first < n; ++first)
      {
        if (joined[first] >= 0)
          continue;
        beside.clear();
        int next = first;
        for (unsigned int size = 1; next >= 0; ++size)
          {
            joined[next] = n_joined;
            if (size == most)
              break;
            for (int r = rows.starts[next]; r < rows.starts[next + 1]; ++r)
              for (int k = graph.starts[rows.columns[r]];
                   k < graph.starts[rows.columns[r] + 1];
                   ++k)
                if (const int column = graph.columns[k];
                    column < n_rows && joined[aggregates[column]] < 0)
                  if (n_entries[aggregates[column]]++ == 0)
                    beside.push_back(aggregates[column]);
            next = -1;
            for (const int candidate : beside)
              if (joined[candidate] < 0 &&
                  (next < 0 || n_entries[candidate] > n_entries[next]))
                next = candidate;
          }
        for (const int candidate : beside)
          n_entries[candidate] = 0;
        ++n_joined;
      }
    std::vector<int> result(n_rows);
    for (int row = 0; row < n_rows; ++row)
      result[row] = joined[aggregates[row]];
    return result;
  }
} // namespace corotet
