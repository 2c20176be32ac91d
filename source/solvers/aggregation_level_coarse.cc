// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exchange.h>
#include <corotet/base/memory.h>
#include <corotet/solvers/aggregation_level.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>

namespace corotet
{
  namespace
  {
    std::span<const int>
    entries_of(const NodeGraph &graph, const int row)
    {
      return {graph.columns.data() + graph.starts[row],
              graph.columns.data() + graph.starts[row + 1]};
    }

    Modes
    load(const double *source)
    {
      Modes result;
      std::memcpy(&result.first, source, sizeof(result.first));
      std::memcpy(&result.last, source + 4, sizeof(result.last));
      return result;
    }

    void
    store(double *target, const Modes &modes)
    {
      std::memcpy(target, &modes.first, sizeof(modes.first));
      std::memcpy(target + 4, &modes.last, sizeof(modes.last));
    }

    /// Adds the products p^T b to the six rows of an aggregate, for blocks b in
    /// the columns @p numbers; the row has @p entries. Both ascend.
    template <int d>
    void
    add_to_row(const std::array<double *, 6>           &row,
               const std::span<const int>               entries,
               const std::array<Modes, d>              &p,
               const std::vector<std::array<Modes, d>> &blocks,
               const int                               *numbers)
    {
      auto entry = entries.begin();
      for (std::size_t k = 0; k < blocks.size(); ++k)
        {
          while (entry != entries.end() && *entry < numbers[k])
            ++entry;
          if (entry == entries.end())
            return;
          if (*entry != numbers[k])
            continue;
          const auto column = 6 * (entry - entries.begin());
          for (int m = 0; m < 6; ++m)
            {
              Modes sum = load(row[m] + column);
              for (int a = 0; a < d; ++a)
                sum.add(p[a][m], blocks[k][a]);
              store(row[m] + column, sum);
            }
        }
    }

    /// The starts of the six rows of an aggregate in @p values, which have 36
    /// numbers for each entry, row by row.
    std::array<double *, 6>
    six_rows(std::vector<double> &values, const NodeGraph &graph, const int row)
    {
      const std::size_t       begin = graph.starts[row];
      const std::size_t       n     = graph.starts[row + 1] - begin;
      std::array<double *, 6> result;
      for (std::size_t m = 0; m < 6; ++m)
        result[m] = values.data() + 36 * begin + 6 * n * m;
      return result;
    }
  } // namespace

  template <int d>
  void
  AggregationLevel<d>::build_coarse(const BlockMatrix                &A,
                                    const std::vector<PointFrame<d>> &frames)
  {
    // There is room for one of the two arrays at a time. The larger one comes
    // first and takes the place of the blocks: a smaller one there would leave
    // it no room.
    std::vector<FloatModes>().swap(prolongation);
    std::vector<ModeBlock> exact(prolongation_pattern.columns.size());
    smooth_motions(exact, A, rigid_motions(frames));
    fill_coarse(A, exact);
    const std::size_t n_entries = prolongation_pattern.starts[n_points];
    prolongation.reserve(n_entries);
    LastReading reading(exact.data());
    for (std::size_t k = 0; k < n_entries; ++k)
      {
        reading.passed(&exact[k]);
        FloatModes &values = prolongation.emplace_back();
        for (int a = 0; a < d; ++a)
          for (int m = 0; m < 6; ++m)
            values[a][m] = exact[k][a][m];
      }
  }

  /// Numbers of the known aggregates in the coarse matrix, in the same order;
  /// -1 for those that it does not have.
  template <int d>
  std::vector<int>
  AggregationLevel<d>::coarse_numbers() const
  {
    const int        n_own  = known_aggregates.n_owned();
    const auto      &ghosts = coarse_pattern->nodes().ghosts();
    std::vector<int> result(known_aggregates.n_local(), -1);
    std::iota(result.begin(), result.begin() + n_own, 0);
    auto ghost = ghosts.begin();
    for (int k = n_own; k < known_aggregates.n_local(); ++k)
      {
        const int number = known_aggregates.global_node(k);
        ghost            = std::lower_bound(ghost, ghosts.end(), number);
        if (ghost != ghosts.end() && *ghost == number)
          result[k] = n_own + (ghost - ghosts.begin());
      }
    return result;
  }

  /// Computes P^T A P / unit. Motions that an aggregate lacks get a 1 on the
  /// diagonal.
  template <int d>
  void
  AggregationLevel<d>::fill_coarse(const BlockMatrix            &A,
                                   const std::vector<ModeBlock> &exact)
  {
    problem.matrix = std::make_unique<BlockMatrix>(coarse_matrix_pattern);
    const NodeGraph &graph  = points->graph();
    BlockMatrix     &coarse = *problem.matrix;
    const int        n_own  = known_aggregates.n_owned();
    const auto       number = coarse_numbers();
    // Six rows for each row, one after the other, as in the matrix.
    std::vector<double>    of_others(36 * rows_of_others.columns.size());
    std::vector<int>       place(known_aggregates.n_local()), numbers;
    std::vector<ModeBlock> row_blocks;
    for (int i = 0; i < n_points; ++i)
      {
        const int *columns =
          &product_pattern.columns[product_pattern.starts[i]];
        const int n = product_pattern.starts[i + 1] - product_pattern.starts[i];
        row_blocks.assign(n, ModeBlock());
        numbers.resize(n);
        for (int k = 0; k < n; ++k)
          {
            place[columns[k]] = k;
            numbers[k]        = number[columns[k]];
          }
        const auto rows = A.template rows_of<d>(i);
        for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
          {
            const int j = graph.columns[k];
            for (int l = prolongation_pattern.starts[j];
                 l < prolongation_pattern.starts[j + 1];
                 ++l)
              add_product(row_blocks[place[prolongation_pattern.columns[l]]],
                          rows,
                          d * (k - graph.starts[i]),
                          exact[l]);
          }
        for (int l = prolongation_pattern.starts[i];
             l < prolongation_pattern.starts[i + 1];
             ++l)
          {
            ModeBlock p = exact[l];
            for (Modes &row : p)
              row *= 1 / the_unit;
            const int I = prolongation_columns[l];
            if (I < n_own)
              add_to_row<d>(coarse.template rows_of<6>(I),
                            entries_of(coarse_pattern->graph(), I),
                            p,
                            row_blocks,
                            numbers.data());
            else
              add_to_row<d>(six_rows(of_others, rows_of_others, I - n_own),
                            entries_of(rows_of_others, I - n_own),
                            p,
                            row_blocks,
                            columns);
          }
      }
    add_received_rows(coarse, of_others);
    for (int I = 0; I < n_own; ++I)
      for (int m = 0; m < 6; ++m)
        if (double &diagonal = coarse.template rows_of<6>(
              I)[m][6 * coarse_pattern->place(I, I) + m];
            diagonal == 0)
          diagonal = 1;
  }

  /// @p of_others has the values to be sent, see @p rows_of_others.
  template <int d>
  void
  AggregationLevel<d>::add_received_rows(
    BlockMatrix               &coarse,
    const std::vector<double> &of_others) const
  {
    std::map<unsigned int, std::vector<double>> sent;
    for (int i = 0; i < rows_of_others.n_rows(); ++i)
      {
        const auto values = of_others.begin();
        const auto rank =
          used_aggregates.owner(used_aggregates.ghosts()[i]).first;
        sent[rank].insert(sent[rank].end(),
                          values +
                            std::ptrdiff_t(36) * rows_of_others.starts[i],
                          values +
                            std::ptrdiff_t(36) * rows_of_others.starts[i + 1]);
      }
    for (const auto &[rank, values] :
         exchange_arrays(sent, points->communicator()))
      {
        const RowParts &parts = received_rows.at(rank);
        const double   *value = values.data();
        for (int r = 0; r < parts.entries.n_rows(); ++r)
          for (double *const row : coarse.template rows_of<6>(parts.rows[r]))
            for (const int place : entries_of(parts.entries, r))
              for (int b = 0; b < 6; ++b)
                row[6 * place + b] += *value++;
      }
  }

  template void
  AggregationLevel<3>::build_coarse(const BlockMatrix &,
                                    const std::vector<PointFrame<3>> &);
  template void
  AggregationLevel<6>::build_coarse(const BlockMatrix &,
                                    const std::vector<PointFrame<6>> &);
} // namespace corotet
