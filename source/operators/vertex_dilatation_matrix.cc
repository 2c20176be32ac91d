// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/operators/vertex_dilatation.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

namespace corotet
{
  void
  VertexDilatation::make_rows()
  {
    if (are_rows_made)
      return;
    are_rows_made = true;
    // Pairs of owned copies and nodes that share a cell.
    std::vector<std::pair<unsigned int, int>> pairs;
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      for (const unsigned int copy : copies->cell_nodes(c))
        if (copy < copies->n_owned())
          for (const unsigned int node : discretization.cell_nodes(c))
            pairs.emplace_back(copy, discretization.global_node(node));
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    auto pair = pairs.begin();
    for (unsigned int copy = 0; copy < copies->n_owned(); ++copy)
      {
        for (; pair != pairs.end() && pair->first == copy; ++pair)
          rows.columns.push_back(pair->second);
        rows.starts.push_back(rows.columns.size());
      }
    exchange_of_rows = exchange.append_rows(rows);
    entries.resize(3 * rows.columns.size());
  }

  void
  VertexDilatation::update_rows(const ElasticData &data)
  {
    // Without rotations the rows never change.
    if (are_entries_known && !data.has_rotations())
      return;
    are_entries_known = true;
    make_rows();
    std::fill(entries.begin(), entries.end(), 0.);
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      {
        const auto nodes         = discretization.cell_nodes(c);
        const auto own           = copies->cell_nodes(c);
        const auto [batch, lane] = data.batches.place(c);
        const auto  &constants   = data.constants[batch];
        const double factor =
          constants.volume[lane] / (4 * constants.scale[lane]);
        // The gradients of the four nodes.
        double gradients[4][3] = {};
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int a = 0; a < 3; ++a)
            {
              gradients[k + 1][a] =
                factor * data.coefficients[batch].gradients[3 * k + a][lane];
              gradients[0][a] -= gradients[k + 1][a];
            }
        for (const unsigned int copy : own)
          if (copy < copies->n_owned())
            for (unsigned int i = 0; i < 4; ++i)
              {
                const auto begin = rows.columns.begin() + rows.starts[copy];
                const auto place =
                  std::lower_bound(begin,
                                   rows.columns.begin() + rows.starts[copy + 1],
                                   static_cast<int>(
                                     discretization.global_node(nodes[i])));
                double *const entry =
                  &entries[3 * std::size_t(place - rows.columns.begin())];
                for (unsigned int a = 0; a < 3; ++a)
                  entry[a] += gradients[i][a];
              }
      }
    exchange_of_rows.update(entries.data(), 3);
  }

  template <typename Function>
  void
  VertexDilatation::for_owned_columns(const Function &function) const
  {
    const int n_owned = discretization.n_owned_nodes();
    if (n_owned == 0)
      return;
    const int first = discretization.global_node(0);
    for (int copy = 0; copy < rows.n_rows(); ++copy)
      for (int k = rows.starts[copy]; k < rows.starts[copy + 1]; ++k)
        if (const int i = rows.columns[k] - first; i >= 0 && i < n_owned)
          function(copy, k, i);
  }

  void
  VertexDilatation::add_diagonal(Vector            &diagonal,
                                 const double       factor,
                                 const ElasticData &data)
  {
    update_rows(data);
    for_owned_columns([&](const int copy, const int k, const int i) {
      for (unsigned int a = 0; a < 3; ++a)
        {
          const double entry = entries[3 * std::size_t(k) + a];
          diagonal.local_element(3 * i + a) +=
            factor * moduli[copy] * entry * entry;
        }
    });
  }

  const std::shared_ptr<const BlockPattern> &
  VertexDilatation::block_pattern()
  {
    if (pattern)
      return pattern;
    make_rows();
    const int n_owned = discretization.n_owned_nodes();
    copies_of_nodes.starts.assign(n_owned + 1, 0);
    for_owned_columns([&](const int, const int, const int i) {
      ++copies_of_nodes.starts[i + 1];
    });
    for (int i = 0; i < n_owned; ++i)
      copies_of_nodes.starts[i + 1] += copies_of_nodes.starts[i];
    copies_of_nodes.columns.resize(copies_of_nodes.starts.back());
    std::vector<int> next(copies_of_nodes.starts);
    for_owned_columns([&](const int copy, const int, const int i) {
      copies_of_nodes.columns[next[i]++] = copy;
    });

    NodeGraph      graph;
    const MPI_Comm comm = discretization.communicator();
    on_all_ranks(comm, [&] {
      std::vector<int> neighbours;
      for (int i = 0; i < n_owned; ++i)
        {
          neighbours.clear();
          for (int c = copies_of_nodes.starts[i];
               c < copies_of_nodes.starts[i + 1];
               ++c)
            {
              const int copy = copies_of_nodes.columns[c];
              neighbours.insert(neighbours.end(),
                                rows.columns.begin() + rows.starts[copy],
                                rows.columns.begin() + rows.starts[copy + 1]);
            }
          std::sort(neighbours.begin(), neighbours.end());
          graph.columns.insert(graph.columns.end(),
                               neighbours.begin(),
                               std::unique(neighbours.begin(),
                                           neighbours.end()));
          if (graph.columns.size() >
              std::size_t(std::numeric_limits<int>::max()))
            throw ComputationError(
              "a matrix with " +
              std::to_string(3 * discretization.n_global_nodes()) +
              " unknowns and dilatations of vertices has too many entries for "
              "one rank");
          graph.starts.push_back(graph.columns.size());
        }
    });
    pattern = std::make_shared<const BlockPattern>(graph, comm);
    return pattern;
  }

  void
  VertexDilatation::add_to_matrix(
    BlockMatrix                      &A,
    const std::vector<unsigned char> &is_prescribed,
    const double                      factor,
    const ElasticData                &data)
  {
    update_rows(data);
    Assert(pattern && A.pattern() == pattern, dealii::ExcInternalError());
    const NodeNumbers         &numbers = pattern->nodes();
    const int                  n_owned = numbers.n_owned();
    std::vector<unsigned char> prescribed(3 * std::size_t(numbers.n_local()));
    std::copy_n(is_prescribed.begin(),
                3 * std::size_t(n_owned),
                prescribed.begin());
    pattern->exchange().update(prescribed.data(), 3);

    // Columns, in local numbers, of the rows that have an owned node.
    std::vector<int> columns(rows.columns.size(), -1);
    for_owned_columns([&](const int copy, const int, const int) {
      for (int k = rows.starts[copy]; k < rows.starts[copy + 1]; ++k)
        if (columns[k] < 0)
          columns[k] = numbers.local_node(rows.columns[k]);
    });
    const NodeGraph &graph = pattern->graph();
    std::vector<int> places(numbers.n_local());
    for (int i = 0; i < n_owned; ++i)
      {
        for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
          places[graph.columns[k]] = k - graph.starts[i];
        for (int c = copies_of_nodes.starts[i];
             c < copies_of_nodes.starts[i + 1];
             ++c)
          {
            const int     copy = copies_of_nodes.columns[c];
            const double *own  = nullptr;
            for (int k = rows.starts[copy]; k < rows.starts[copy + 1]; ++k)
              if (columns[k] == i)
                own = &entries[3 * std::size_t(k)];
            for (int k = rows.starts[copy]; k < rows.starts[copy + 1]; ++k)
              {
                const int     j     = columns[k];
                const double *other = &entries[3 * std::size_t(k)];
                for (int a = 0; a < 3; ++a)
                  {
                    double *const row =
                      A.row(i, a) + std::size_t(3) * places[j];
                    for (int b = 0; b < 3; ++b)
                      if ((i == j && a == b) ||
                          (!prescribed[3 * i + a] && !prescribed[3 * j + b]))
                        row[b] += factor * moduli[copy] * own[a] * other[b];
                  }
              }
          }
      }
  }
} // namespace corotet
