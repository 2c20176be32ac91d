// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/block_matrix.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace corotet
{
  BlockPattern::BlockPattern(const NodeGraph &rows, const MPI_Comm comm)
    : comm(comm)
    , first_nodes(dealii::Utilities::MPI::all_gather(comm, rows.n_rows()))
  {
    first_nodes.push_back(0);
    std::exclusive_scan(first_nodes.begin(),
                        first_nodes.end(),
                        first_nodes.begin(),
                        0);
    first        = first_nodes[dealii::Utilities::MPI::this_mpi_process(comm)];
    const int  n = rows.n_rows();
    const auto owns = [this, n](const int node) {
      return node >= first && node < first + n;
    };
    for (const int column : rows.columns)
      if (!owns(column))
        ghost_nodes.push_back(column);
    std::sort(ghost_nodes.begin(), ghost_nodes.end());
    ghost_nodes.erase(std::unique(ghost_nodes.begin(), ghost_nodes.end()),
                      ghost_nodes.end());
    ghost_nodes.shrink_to_fit();

    local_graph.starts = rows.starts;
    local_graph.columns.resize(rows.columns.size());
    for (std::size_t k = 0; k < rows.columns.size(); ++k)
      {
        const int column = rows.columns[k];
        local_graph.columns[k] =
          owns(column) ?
            column - first :
            n +
              std::lower_bound(ghost_nodes.begin(), ghost_nodes.end(), column) -
              ghost_nodes.begin();
      }
    for (int node = 0; node < n; ++node)
      std::sort(local_graph.columns.begin() + rows.starts[node],
                local_graph.columns.begin() + rows.starts[node + 1]);
    ghost_exchange = GhostExchange(comm, first_nodes, ghost_nodes);
  }

  int
  BlockPattern::local_node(const int global) const
  {
    if (global >= first && global < first + n_owned())
      return global - first;
    const auto found =
      std::lower_bound(ghost_nodes.begin(), ghost_nodes.end(), global);
    Assert(found != ghost_nodes.end() && *found == global,
           dealii::ExcInternalError());
    return n_owned() + (found - ghost_nodes.begin());
  }

  int
  BlockPattern::place(const int node, const int column) const
  {
    const auto begin = local_graph.columns.begin() + local_graph.starts[node];
    const auto end = local_graph.columns.begin() + local_graph.starts[node + 1];
    const auto found = std::lower_bound(begin, end, column);
    Assert(found != end && *found == column, dealii::ExcInternalError());
    return found - begin;
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
    std::fill(values.begin(), values.end(), 0.);
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
    // Also a rank without ghosts may have to send.
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
