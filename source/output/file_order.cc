// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/output/file_order.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace corotet
{
  namespace
  {
    std::vector<int>
    offsets(const std::vector<int> &sizes)
    {
      std::vector<int> result(sizes.size());
      std::exclusive_scan(sizes.begin(), sizes.end(), result.begin(), 0);
      return result;
    }

  } // namespace

  FileOrder
  FileOrder::of_cells(const Discretization &discretization)
  {
    std::vector<std::int64_t> keys(discretization.n_owned_cells());
    for (unsigned int c = 0; c < keys.size(); ++c)
      keys[c] = discretization.mesh_cell(c);
    return {discretization.communicator(),
            keys,
            static_cast<std::int64_t>(discretization.n_global_cells())};
  }

  FileOrder
  FileOrder::of_nodes(const Discretization &discretization, const Nodes &nodes)
  {
    // The key of a node: the number of the first cell with this node, all of
    // which its owner knows, and the node's number there.
    const std::int64_t        n = nodes.n_nodes_per_cell();
    std::vector<std::int64_t> keys(nodes.n_local_nodes(),
                                   std::numeric_limits<std::int64_t>::max());
    for (unsigned int c = 0; c < nodes.n_local_cells(); ++c)
      {
        const std::int64_t cell       = discretization.mesh_cell(c);
        const auto         cell_nodes = nodes.cell_nodes(c);
        for (unsigned int i = 0; i < n; ++i)
          keys[cell_nodes[i]] = std::min(keys[cell_nodes[i]], n * cell + i);
      }
    keys.resize(nodes.n_owned_nodes());
    return {discretization.communicator(),
            keys,
            n * static_cast<std::int64_t>(discretization.n_global_cells())};
  }

  FileOrder::FileOrder(const MPI_Comm                   comm,
                       const std::vector<std::int64_t> &keys,
                       const std::int64_t               n_keys)
    : comm(comm)
    , by_rank(keys.size())
  {
    // All keys are divided evenly among the ranks; each has the rows of its
    // keys.
    const std::int64_t n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
    std::iota(by_rank.begin(), by_rank.end(), 0u);
    std::sort(by_rank.begin(),
              by_rank.end(),
              [&](const unsigned int a, const unsigned int b) {
                return keys[a] < keys[b];
              });
    n_sent.resize(n_ranks);
    n_received.resize(n_ranks);
    std::vector<std::int64_t> sent(keys.size());
    for (std::size_t k = 0; k < keys.size(); ++k)
      {
        sent[k] = keys[by_rank[k]];
        ++n_sent[sent[k] / ((n_keys + n_ranks - 1) / n_ranks)];
      }
    MPI_Alltoall(
      n_sent.data(), 1, MPI_INT, n_received.data(), 1, MPI_INT, comm);
    const std::vector<std::int64_t> received =
      exchange(std::move(sent), n_sent, n_received, 1);

    std::vector<unsigned int> order(received.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(),
              order.end(),
              [&](const unsigned int a, const unsigned int b) {
                return received[a] < received[b];
              });
    row_of_received.resize(order.size());
    for (unsigned int row = 0; row < order.size(); ++row)
      row_of_received[order[row]] = row;
    n_rows = order.size();
    std::tie(first, n_global_rows) =
      dealii::Utilities::MPI::partial_and_total_sum(n_rows, comm);
  }

  template <typename Number>
  std::vector<Number>
  FileOrder::exchange(std::vector<Number>     source,
                      const std::vector<int> &n_to,
                      const std::vector<int> &n_from,
                      const std::size_t       n_columns) const
  {
    if (n_to.size() == 1)
      return source;
    const std::size_t n =
      std::accumulate(n_from.begin(), n_from.end(), std::size_t(0));
    std::vector<Number> target(n * n_columns);
    // A row is one MPI type, so that counts fit into MPI's int.
    MPI_Datatype row = MPI_DATATYPE_NULL;
    MPI_Type_contiguous(n_columns * sizeof(Number), MPI_BYTE, &row);
    MPI_Type_commit(&row);
    MPI_Alltoallv(source.data(),
                  n_to.data(),
                  offsets(n_to).data(),
                  row,
                  target.data(),
                  n_from.data(),
                  offsets(n_from).data(),
                  row,
                  comm);
    MPI_Type_free(&row);
    return target;
  }

  template <typename Number>
  std::vector<Number>
  FileOrder::to_file(const Number *values, const std::size_t n_columns) const
  {
    std::vector<Number> rows(n_rows * n_columns);
    if (n_sent.size() == 1)
      {
        for (std::size_t k = 0; k < by_rank.size(); ++k)
          std::copy_n(values + by_rank[k] * n_columns,
                      n_columns,
                      rows.begin() + row_of_received[k] * n_columns);
        return rows;
      }
    std::vector<Number> sent;
    sent.reserve(by_rank.size() * n_columns);
    for (const unsigned int i : by_rank)
      sent.insert(sent.end(),
                  values + i * n_columns,
                  values + (i + 1) * n_columns);
    const std::vector<Number> received =
      exchange(std::move(sent), n_sent, n_received, n_columns);
    for (std::size_t k = 0; k < row_of_received.size(); ++k)
      std::copy_n(received.begin() + k * n_columns,
                  n_columns,
                  rows.begin() + row_of_received[k] * n_columns);
    return rows;
  }

  template <typename Number>
  void
  FileOrder::from_file(const Number     *rows,
                       Number           *values,
                       const std::size_t n_columns) const
  {
    std::vector<Number> sent;
    sent.reserve(row_of_received.size() * n_columns);
    for (const unsigned int row : row_of_received)
      sent.insert(sent.end(),
                  rows + row * n_columns,
                  rows + (row + 1) * n_columns);
    const std::vector<Number> received =
      exchange(std::move(sent), n_received, n_sent, n_columns);
    for (std::size_t k = 0; k < by_rank.size(); ++k)
      std::copy_n(received.begin() + k * n_columns,
                  n_columns,
                  values + by_rank[k] * n_columns);
  }

  std::vector<std::int64_t>
  FileOrder::row_numbers() const
  {
    std::vector<std::int64_t> rows(n_rows);
    std::iota(rows.begin(), rows.end(), static_cast<std::int64_t>(first));
    std::vector<std::int64_t> numbers(by_rank.size());
    from_file(rows.data(), numbers.data());
    return numbers;
  }

  template std::vector<double>
  FileOrder::to_file(const double *, const std::size_t) const;
  template std::vector<std::int32_t>
  FileOrder::to_file(const std::int32_t *, const std::size_t) const;
  template std::vector<std::int64_t>
  FileOrder::to_file(const std::int64_t *, const std::size_t) const;
  template void
  FileOrder::from_file(const double *, double *, const std::size_t) const;
} // namespace corotet
