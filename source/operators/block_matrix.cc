// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/block_matrix.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  BlockPattern::BlockPattern(const NodeGraph &rows, const MPI_Comm comm)
    : comm(comm)
    , numbers(comm, rows.n_rows())
  {
    numbers.set_ghosts(rows.columns);
    local_graph.starts = rows.starts;
    local_graph.columns.resize(rows.columns.size());
    for (std::size_t k = 0; k < rows.columns.size(); ++k)
      local_graph.columns[k] = numbers.local_node(rows.columns[k]);
    for (int node = 0; node < n_owned(); ++node)
      std::sort(local_graph.columns.begin() + rows.starts[node],
                local_graph.columns.begin() + rows.starts[node + 1]);
    ghost_exchange = GhostExchange(comm, numbers);
  }

  int
  BlockPattern::place(const int node, const int column) const
  {
    const int *begin = &local_graph.columns[local_graph.starts[node]];
    const int  n     = local_graph.starts[node + 1] - local_graph.starts[node];
    // In short rows, counting takes less time than a search, in which the
    // processor predicts branches wrongly.
    constexpr int longest_to_count = 64;
    int           place            = 0;
    if (n <= longest_to_count)
      for (int k = 0; k < n; ++k)
        place += begin[k] < column ? 1 : 0;
    else
      place = std::lower_bound(begin, begin + n, column) - begin;
    Assert(place < n && begin[place] == column, dealii::ExcInternalError());
    return place;
  }

  BlockMatrix::BlockMatrix(const std::shared_ptr<const BlockPattern> &pattern)
    : the_pattern(pattern)
    , values(9 * pattern->graph().columns.size())
  {}

  double &
  BlockMatrix::diagonal(const int row)
  {
    const int node = row / 3, component = row % 3;
    return this->row(node,
                     component)[3 * the_pattern->place(node, node) + component];
  }

  double
  BlockMatrix::diagonal(const int row) const
  {
    const int node = row / 3, component = row % 3;
    return this->row(node,
                     component)[3 * the_pattern->place(node, node) + component];
  }

  double
  BlockMatrix::largest_value() const
  {
    double largest = 0;
    for (const double value : values)
      largest = std::max(largest, std::abs(value));
    return largest;
  }

  void
  BlockMatrix::set_zero()
  {
    values.assign(9 * the_pattern->graph().columns.size(), 0.);
  }

  void
  BlockMatrix::scale(const double factor)
  {
    for (double &value : values)
      value *= factor;
  }

  void
  BlockMatrix::vmult(double *dst, const double *src) const
  {
    const BlockPattern &pattern = *the_pattern;
    const NodeGraph    &graph   = pattern.graph();
    const int           n       = pattern.n_owned();
    // A rank without ghosts may have to send, too.
    if (dealii::Utilities::MPI::n_mpi_processes(pattern.communicator()) > 1)
      {
        source.resize(3 *
                      static_cast<std::size_t>(pattern.exchange().n_items()));
        std::copy_n(src, 3 * static_cast<std::size_t>(n), source.data());
        pattern.exchange().update(source.data(), 3);
        src = source.data();
      }
    for (int node = 0; node < n; ++node)
      {
        const auto row    = rows(node);
        double     sum[3] = {};
        const int *column = &graph.columns[graph.starts[node]];
        const int  length = row_length(node);
        for (int k = 0; k < length; k += 3, ++column)
          {
            const double *x = src + 3 * static_cast<std::size_t>(*column);
            for (int a = 0; a < 3; ++a)
              sum[a] +=
                row[a][k] * x[0] + row[a][k + 1] * x[1] + row[a][k + 2] * x[2];
          }
        std::copy_n(sum, 3, dst + 3 * static_cast<std::size_t>(node));
      }
  }

  void
  BlockMatrix::vmult(Vector &dst, const Vector &src) const
  {
    vmult(dst.begin(), src.begin());
  }
} // namespace corotet
