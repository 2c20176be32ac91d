// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/smoothed_aggregation.h>

#include <Epetra_Comm.h>
#include <Epetra_Map.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  namespace
  {
    /// The entries of blocks of n x n in these rows. Columns of other ranks are
    /// in ascending order behind the owned ones.
    std::unique_ptr<Epetra_CrsGraph>
    graph_of_blocks(const NodeGraph  &blocks,
                    const int         n,
                    const Epetra_Map &rows)
    {
      std::vector<int> columns, n_columns;
      for (int i = 0; i < blocks.n_rows(); ++i)
        n_columns.insert(n_columns.end(),
                         n,
                         n * (blocks.starts[i + 1] - blocks.starts[i]));
      auto result =
        std::make_unique<Epetra_CrsGraph>(Copy, rows, n_columns.data(), true);
      for (int i = 0; i < blocks.n_rows(); ++i)
        {
          columns.clear();
          for (int k = blocks.starts[i]; k < blocks.starts[i + 1]; ++k)
            for (int m = 0; m < n; ++m)
              columns.push_back(n * blocks.columns[k] + m);
          for (int m = 0; m < n; ++m)
            result->InsertGlobalIndices(rows.GID(n * i + m),
                                        columns.size(),
                                        columns.data());
        }
      result->SortGhostsAssociatedWithEachProcessor(true);
      result->FillComplete();
      result->OptimizeStorage();
      return result;
    }
  } // namespace

  /// Aggregates that stay within the rank, numbered from zero.
  void
  SmoothedAggregation::aggregate_nodes()
  {
    const NodeGraph &pattern     = node_rows.graph();
    const auto       norm_square = [&](const int k) {
      double sum = 0;
      for (int l = 9 * k; l < 9 * k + 9; ++l)
        sum += static_cast<double>(blocks[l]) * blocks[l];
      return sum;
    };
    std::vector<double> size(n_nodes);
    std::vector<int>    row_of(pattern.columns.size());
    for (int i = 0; i < n_nodes; ++i)
      for (int k = pattern.starts[i]; k < pattern.starts[i + 1]; ++k)
        {
          row_of[k] = i;
          if (pattern.columns[k] == i)
            size[i] = std::sqrt(norm_square(k));
        }
    aggregates = aggregate(pattern, [&](const int k) {
      const int j = pattern.columns[k];
      return j < n_nodes && norm_square(k) >=
                              threshold * threshold * size[row_of[k]] * size[j];
    });
  }

  void
  SmoothedAggregation::set_up_pattern()
  {
    aggregate_nodes();
    int n_own = 0;
    for (const int i : aggregates)
      n_own = std::max(n_own, i + 1);
    coarse.resize(6 * n_own);
    NodeGraph tentative;
    tentative.columns = aggregates;
    for (int i = 0; i < ghosts.n_items(); ++i)
      tentative.starts.push_back(std::min(i + 1, n_nodes));
    nodes_of_aggregates = transpose(tentative, n_own);
    prolongation_pattern =
      corotet::product(node_rows.graph(), tentative, n_own);
    const NodeGraph restriction = transpose(prolongation_pattern, n_own);

    // From here on, aggregates are numbered through all ranks.
    const Epetra_Map rows(-1, 6 * n_own, 0, graph->Comm());
    const int        n_all = rows.NumGlobalElements() / 6;
    first_aggregate        = n_own > 0 ? rows.GID(0) / 6 : 0;
    for (auto *columns : {&aggregates, &prolongation_pattern.columns})
      for (int &column : *columns)
        column += first_aggregate;
    prolongation_ghosts = ghosts.append_rows(prolongation_pattern);
    product_pattern =
      corotet::product(node_rows.graph(), prolongation_pattern, n_all);
    const NodeGraph full =
      corotet::product(restriction, product_pattern, n_all);
    coarse_pattern = NodeGraph();
    for (int i = 0; i < n_own; ++i)
      {
        for (int k = full.starts[i]; k < full.starts[i + 1]; ++k)
          if (full.columns[k] <= first_aggregate + i)
            coarse_pattern.columns.push_back(full.columns[k]);
        coarse_pattern.starts.push_back(coarse_pattern.columns.size());
      }
    coarse_graph = graph_of_blocks(coarse_pattern, 6, rows);
  }
} // namespace corotet
