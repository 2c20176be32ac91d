// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/smoothed_aggregation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  namespace
  {
    /// The pattern of matrices whose nodes come in twos, from that of the twos.
    NodeGraph
    split_in_two(const NodeGraph &twos)
    {
      NodeGraph result;
      for (int i = 0; i < 2 * twos.n_rows(); ++i)
        {
          for (int k = twos.starts[i / 2]; k < twos.starts[i / 2 + 1]; ++k)
            for (int part = 0; part < 2; ++part)
              result.columns.push_back(2 * twos.columns[k] + part);
          result.starts.push_back(result.columns.size());
        }
      return result;
    }
  } // namespace

  /// Aggregates that stay within the rank, numbered from zero.
  void
  SmoothedAggregation::aggregate_nodes()
  {
    const NodeGraph &graph         = pattern->graph();
    const auto       size_of_block = [&](const int k) {
      double sum = 0;
      for (int l = 9 * k; l < 9 * k + 9; ++l)
        sum += static_cast<double>(blocks[l]) * blocks[l];
      return std::sqrt(sum);
    };
    const auto for_each_block = [&](const auto &action) {
      for (int i = 0; i < n_nodes; ++i)
        for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
          if (graph.columns[k] < n_nodes)
            action(i, graph.columns[k], k);
    };
    std::vector<double> diagonal(n_nodes), strongest(n_nodes);
    for_each_block([&](const int i, const int j, const int k) {
      if (i == j)
        diagonal[i] = size_of_block(k);
    });
    // Those with other ranks are none.
    std::vector<double> strength(graph.columns.size(), -1);
    for_each_block([&](const int i, const int j, const int k) {
      strength[k] = size_of_block(k) / std::sqrt(diagonal[i] * diagonal[j]);
      if (i != j)
        strongest[i] = std::max(strongest[i], strength[k]);
    });
    std::vector<unsigned char> is_strong(graph.columns.size());
    for_each_block([&](const int i, const int j, const int k) {
      is_strong[k] =
        strength[k] >= least_strength * std::min(strongest[i], strongest[j]);
    });
    aggregates = aggregate(graph, [&](const int k) { return is_strong[k]; });
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
    for (int i = 0; i < pattern->exchange().n_items(); ++i)
      tentative.starts.push_back(std::min(i + 1, n_nodes));
    nodes_of_aggregates  = transpose(tentative, n_own);
    prolongation_pattern = corotet::product(pattern->graph(), tentative, n_own);
    const NodeGraph restriction = transpose(prolongation_pattern, n_own);

    // From here on, aggregates are numbered through all ranks.
    const auto [before, n_all] =
      dealii::Utilities::MPI::partial_and_total_sum(n_own,
                                                    pattern->communicator());
    first_aggregate = before;
    for (auto *columns : {&aggregates, &prolongation_pattern.columns})
      for (int &column : *columns)
        column += first_aggregate;
    prolongation_ghosts = pattern->exchange().append_rows(prolongation_pattern);
    product_pattern =
      corotet::product(pattern->graph(), prolongation_pattern, n_all);
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
    coarse_matrix = std::make_unique<BlockMatrix>(
      std::make_shared<const BlockPattern>(split_in_two(coarse_pattern),
                                           pattern->communicator()));
  }
} // namespace corotet
