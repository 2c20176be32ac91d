// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/aggregation_level.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstddef>

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

    /// The entries that @p is_wanted(row, k) chooses.
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
    /// With one entry in each row.
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

    /// Of a node, or the mean one of an aggregate: the first three of its
    /// motions are the translations, and the others are orthogonal to them.
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

  /// They see what is coupled strongly whatever the signs in A are. The sizes
  /// of its blocks do not: on flat cells, large ones cancel each other.
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

  /// Aggregates are numbered from zero.
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
    // Lines of points make aggregates of three, and so hardly fewer of them:
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
  AggregationLevel<d>::set_up_pattern(const Coarsening &coarsening,
                                      const std::vector<PointFrame<d>> &frames)
  {
    aggregate_points(coarsening, frames);
    const int n_own      = number_of(aggregates);
    const int n_ghosts   = points->exchange().n_items() - n_points;
    NodeGraph tentative  = one_entry_each(aggregates);
    points_of_aggregates = transpose(tentative, n_own);
    tentative.starts.insert(tentative.starts.end(), n_ghosts, n_points);
    prolongation_pattern = corotet::product(points->graph(), tentative, n_own);
    if (coarsening.least_similarity > 0)
      {
        // D couples all points of an aggregate.
        const NodeGraph of_aggregates =
          corotet::product(points_of_aggregates, prolongation_pattern, n_own);
        prolongation_pattern =
          corotet::product(one_entry_each(aggregates), of_aggregates, n_own);
      }
    const NodeGraph restriction = transpose(prolongation_pattern, n_own);

    // From here on, aggregates are numbered through all ranks.
    const auto [before, n_all] =
      dealii::Utilities::MPI::partial_and_total_sum(n_own,
                                                    points->communicator());
    first_aggregate  = before;
    n_all_aggregates = n_all;
    for (auto *columns : {&aggregates, &prolongation_pattern.columns})
      for (int &column : *columns)
        column += first_aggregate;
    prolongation_ghosts = points->exchange().append_rows(prolongation_pattern);
    product_pattern =
      corotet::product(points->graph(), prolongation_pattern, n_all);
    coarse_pattern = corotet::product(restriction, product_pattern, n_all);
    problem        = AggregateProblem();
    // Points without neighbours, as those of many small bodies, stay as many.
    constexpr double almost_all = 0.8;
    if (n_all > coarsening.most_aggregates &&
        n_all < almost_all * points->n_global())
      problem.aggregates =
        std::make_shared<const BlockPattern>(coarse_pattern,
                                             points->communicator());
    else
      coarse_pattern = part_of(coarse_pattern, [&](const int i, const int k) {
        return coarse_pattern.columns[k] <= first_aggregate + i;
      });
    coarse_matrix_pattern =
      std::make_shared<const BlockPattern>(split_in_two(coarse_pattern),
                                           points->communicator());
  }

  template void
  AggregationLevel<3>::set_up_pattern(const Coarsening &,
                                      const std::vector<PointFrame<3>> &);
  template void
  AggregationLevel<6>::set_up_pattern(const Coarsening &,
                                      const std::vector<PointFrame<6>> &);
} // namespace corotet
