// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exchange.h>
#include <corotet/solvers/aggregation_level.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace corotet
{
  namespace
  {
    /// The pattern of matrices with two nodes for each row of @p twos.
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

    /// The graph of the entries for which @p is_wanted(row, k) is true.
    template <typename Predicate>
    NodeGraph
    part_of(const NodeGraph &graph, const Predicate &is_wanted)
    {
      NodeGraph result;
      for (int i = 0; i < graph.n_rows(); ++i)
        {
          for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
            if (is_wanted(i, k))
              result.columns.push_back(graph.columns[k]);
          result.starts.push_back(result.columns.size());
        }
      return result;
    }
    /// The graph with one entry in each row.
    NodeGraph
    one_entry_each(const std::vector<int> &columns)
    {
      NodeGraph result;
      result.columns = columns;
      for (unsigned int i = 0; i < columns.size(); ++i)
        result.starts.push_back(i + 1);
      return result;
    }

    int
    number_of(const std::vector<int> &aggregates)
    {
      int result = 0;
      for (const int g : aggregates)
        result = std::max(result, g + 1);
      return result;
    }

    using PointVector = dealii::Tensor<1, 3>;

    /// The displacement of a node, or the mean one of an aggregate: the first
    /// three of its motions are the translations, and the others are orthogonal
    /// to them.
    template <int d>
    PointVector
    displacement(const PointFrame<d> &frame, const float *unknowns)
    {
      PointVector result;
      for (int a = 0; a < 3; ++a)
        if constexpr (d == 3)
          result[a] = unknowns[a];
        else if (frame.motions[a][a] != 0)
          result[a] = unknowns[a] / frame.motions[a][a];
      return result;
    }
  } // namespace

  /// Similarities find strong couplings whatever the signs in A are. The sizes
  /// of its blocks do not: on flat cells, large blocks cancel each other.
  template <int d>
  std::vector<double>
  AggregationLevel<d>::similarities(const std::vector<PointFrame<d>> &frames)
  {
    constexpr int            n_motions = 6, n_smoothings = 4;
    const NodeGraph         &graph = points->graph();
    std::vector<double>      differences(graph.columns.size());
    std::vector<double>      sizes(n_points);
    std::vector<double>      result(graph.columns.size());
    std::vector<PointVector> displacements(n_points);
    std::fill(rhs.begin(), rhs.end(), 0.f);
    for (int motion = 1; motion <= n_motions; ++motion)
      {
        fill_without_pattern(x, motion);
        for (int n = 0; n < n_smoothings; ++n)
          smooth(false);
        for (int i = 0; i < n_points; ++i)
          {
            displacements[i] = displacement(frames[i], &x[offset(i)]);
            sizes[i] += displacements[i].norm_square();
          }
        for (int i = 0; i < n_points; ++i)
          for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
            if (const int j = graph.columns[k]; j < n_points)
              differences[k] +=
                (displacements[i] - displacements[j]).norm_square();
      }
    for (int i = 0; i < n_points; ++i)
      for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
        if (differences[k] > 0)
          result[k] = (sizes[i] + sizes[graph.columns[k]]) / differences[k];
    return result;
  }

  /// Aggregates get numbers from zero on.
  template <int d>
  void
  AggregationLevel<d>::aggregate_points(
    const Coarsening                 &coarsening,
    const std::vector<PointFrame<d>> &frames)
  {
    const double               threshold = coarsening.least_similarity;
    const NodeGraph           &graph     = points->graph();
    std::vector<unsigned char> is_joined(graph.columns.size());
    for (std::size_t k = 0; k < is_joined.size(); ++k)
      is_joined[k] = graph.columns[k] < n_points ? 1 : 0;
    if (threshold > 0)
      {
        const std::vector<double> similarity = similarities(frames);
        std::vector<double>       largest(n_points);
        for (int i = 0; i < n_points; ++i)
          for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
            largest[i] = std::max(largest[i], similarity[k]);
        for (int i = 0; i < n_points; ++i)
          for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
            if (const int j = graph.columns[k]; j < n_points)
              is_joined[k] =
                i == j || similarity[k] >=
                            threshold * std::min(largest[i], largest[j]) ?
                  1 :
                  0;
      }
    aggregates = aggregate(graph, [&](const int k) { return is_joined[k]; });
    if (threshold == 0)
      {
        if (coarsening.n_joined > 1 &&
            dealii::Utilities::MPI::sum(number_of(aggregates),
                                        points->communicator()) >
              coarsening.most_aggregates)
          aggregates = join(graph, aggregates, coarsening.n_joined);
        return;
      }
    // Lines of points make aggregates of three points, so hardly fewer points:
    // these are aggregated once more.
    constexpr int   few = 12, most_passes = 2;
    const NodeGraph joined =
      part_of(graph, [&](int, const int k) { return is_joined[k]; });
    for (int pass = 0; pass < most_passes; ++pass)
      {
        const int n = number_of(aggregates);
        if (n_points >= few * n)
          return;
        const NodeGraph        members = one_entry_each(aggregates);
        const std::vector<int> larger =
          aggregate(corotet::product(transpose(members, n),
                                     corotet::product(joined, members, n),
                                     n),
                    [](int) { return true; });
        for (int &g : aggregates)
          g = larger[g];
      }
  }

  template <int d>
  void
  AggregationLevel<d>::set_up_prolongation(const bool has_blocks)
  {
    const auto renumber = [](std::vector<int> &numbers, const auto &number) {
      std::transform(numbers.begin(), numbers.end(), numbers.begin(), number);
    };
    const auto to_global = [this](const int g) {
      return used_aggregates.global_node(g);
    };
    const std::vector<int> of_owned = aggregates;
    used_aggregates =
      NodeNumbers(points->communicator(), points_of_aggregates.n_rows());
    renumber(aggregates, to_global);
    aggregates.resize(points->exchange().n_items());
    points->exchange().update(aggregates.data());
    used_aggregates.set_ghosts(aggregates);
    coarse_exchange  = GhostExchange(points->communicator(), used_aggregates);
    const int n_used = used_aggregates.n_local();
    coarse_values.resize(6 * static_cast<std::size_t>(n_used));

    std::vector<int> used(aggregates);
    renumber(used,
             [this](const int g) { return used_aggregates.local_node(g); });
    prolongation_pattern =
      corotet::product(points->graph(), one_entry_each(used), n_used);
    if (has_blocks)
      // D couples all points of an aggregate.
      prolongation_pattern = corotet::product(
        one_entry_each(of_owned),
        corotet::product(points_of_aggregates, prolongation_pattern, n_used),
        n_used);
    prolongation_columns = prolongation_pattern.columns;

    renumber(prolongation_pattern.columns, to_global);
    prolongation_ghosts = points->exchange().append_rows(prolongation_pattern);
    known_aggregates    = used_aggregates;
    known_aggregates.set_ghosts(prolongation_pattern.columns);
    for (auto *numbers : {&aggregates, &prolongation_pattern.columns})
      renumber(*numbers,
               [this](const int g) { return known_aggregates.local_node(g); });
  }

  template <int d>
  NodeGraph
  AggregationLevel<d>::set_up_coarse_rows(const bool is_last)
  {
    NodeGraph own_prolongation;
    own_prolongation.starts.assign(prolongation_pattern.starts.begin(),
                                   prolongation_pattern.starts.begin() +
                                     n_points + 1);
    own_prolongation.columns = prolongation_columns;
    const NodeGraph all =
      corotet::product(transpose(own_prolongation, used_aggregates.n_local()),
                       product_pattern,
                       known_aggregates.n_local());
    const NodeGraph wanted = part_of(all, [&](const int i, const int k) {
      return !is_last || known_aggregates.global_node(all.columns[k]) <=
                           used_aggregates.global_node(i);
    });
    // Pairs of a row and a column in the owned rows.
    std::vector<std::pair<int, int>> entries;
    std::map<unsigned int, RowParts> parts;
    rows_of_others = NodeGraph();
    for (int i = 0; i < wanted.n_rows(); ++i)
      {
        const auto [rank, row] =
          used_aggregates.owner(used_aggregates.global_node(i));
        const bool is_own = i < used_aggregates.n_owned();
        for (int k = wanted.starts[i]; k < wanted.starts[i + 1]; ++k)
          {
            const int column = known_aggregates.global_node(wanted.columns[k]);
            if (is_own)
              {
                entries.emplace_back(row, column);
                continue;
              }
            rows_of_others.columns.push_back(wanted.columns[k]);
            parts[rank].entries.columns.push_back(column);
          }
        if (is_own)
          continue;
        rows_of_others.starts.push_back(rows_of_others.columns.size());
        parts[rank].add_row(row);
      }
    exchange_row_parts(parts);
    for (const auto &[rank, part] : received_rows)
      for (int r = 0; r < part.entries.n_rows(); ++r)
        for (int k = part.entries.starts[r]; k < part.entries.starts[r + 1];
             ++k)
          entries.emplace_back(part.rows[r], part.entries.columns[k]);
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    NodeGraph rows;
    rows.starts.assign(used_aggregates.n_owned() + 1, 0);
    for (const auto &[row, column] : entries)
      {
        rows.columns.push_back(column);
        rows.starts[row + 1] = rows.columns.size();
      }
    return rows;
  }

  template <int d>
  void
  AggregationLevel<d>::exchange_row_parts(
    const std::map<unsigned int, RowParts> &parts)
  {
    Messages messages;
    for (const auto &[rank, part] : parts)
      for (const auto *array :
           {&part.rows, &part.entries.starts, &part.entries.columns})
        append_array(messages[rank], *array);
    received_rows.clear();
    for (const auto &[rank, message] :
         exchange_messages(std::move(messages), points->communicator()))
      {
        RowParts   &part     = received_rows[rank];
        std::size_t position = 0;
        for (auto *array :
             {&part.rows, &part.entries.starts, &part.entries.columns})
          read_array(message, position, *array);
      }
  }

  template <int d>
  void
  AggregationLevel<d>::set_up_pattern(const Coarsening &coarsening,
                                      const std::vector<PointFrame<d>> &frames)
  {
    aggregate_points(coarsening, frames);
    points_of_aggregates =
      transpose(one_entry_each(aggregates), number_of(aggregates));
    set_up_prolongation(coarsening.least_similarity > 0);
    product_pattern = corotet::product(points->graph(),
                                       prolongation_pattern,
                                       known_aggregates.n_local());
    // Points without neighbours, like those of many small bodies, cannot be
    // aggregated.
    constexpr double almost_all = 0.8;
    const int        n_all      = n_aggregates();
    const bool       is_last    = n_all <= coarsening.most_aggregates ||
                         n_all >= almost_all * points->nodes().n_global();
    const NodeGraph rows = set_up_coarse_rows(is_last);
    coarse_pattern =
      std::make_shared<const BlockPattern>(rows, points->communicator());
    for (auto &[rank, part] : received_rows)
      for (int r = 0; r < part.entries.n_rows(); ++r)
        for (int k = part.entries.starts[r]; k < part.entries.starts[r + 1];
             ++k)
          part.entries.columns[k] =
            coarse_pattern->place(part.rows[r],
                                  coarse_pattern->nodes().local_node(
                                    part.entries.columns[k]));
    problem = AggregateProblem();
    if (!is_last)
      problem.aggregates = coarse_pattern;
    coarse_matrix_pattern =
      std::make_shared<const BlockPattern>(split_in_two(rows),
                                           points->communicator());
  }

  template void
  AggregationLevel<3>::set_up_pattern(const Coarsening &,
                                      const std::vector<PointFrame<3>> &);
  template void
  AggregationLevel<6>::set_up_pattern(const Coarsening &,
                                      const std::vector<PointFrame<6>> &);
} // namespace corotet
