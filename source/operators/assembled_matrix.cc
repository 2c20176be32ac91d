// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/operators/assembled_matrix.h>
#include <corotet/operators/frozen_cell_matrices.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace corotet
{
  AssembledMatrix::AssembledMatrix(
    const Nodes                               &nodes,
    const std::vector<unsigned char>          &is_prescribed,
    const std::shared_ptr<const BlockPattern> &pattern)
    : nodes(nodes)
    , reference(ReferenceElement::of(nodes.element()))
    , prescribed(is_prescribed)
  {
    block_matrix     = std::make_unique<BlockMatrix>(pattern);
    places_of_blocks = BlockPlaces(nodes, *pattern);
    touches_prescribed.resize(nodes.n_local_cells());
    for (unsigned int c = 0; c < nodes.n_local_cells(); ++c)
      for (const unsigned int node : nodes.cell_nodes(c))
        for (unsigned int a = 0; a < 3; ++a)
          touches_prescribed[c] |= prescribed[3 * node + a];
  }

  namespace
  {
    using V = Simd<double>;

    // Limit of the numbers of nodes and of blocks.
    constexpr std::size_t largest_int = std::numeric_limits<int>::max();
  } // namespace

  std::shared_ptr<const BlockPattern>
  block_pattern(const Nodes &nodes)
  {
    const unsigned int n_owned = nodes.n_owned_nodes();
    // The cells around each owned node.
    std::vector<unsigned int> starts(n_owned + 1), cells;
    const auto                for_owned_nodes = [&](const auto &action) {
      for (unsigned int c = 0; c < nodes.n_local_cells(); ++c)
        for (const unsigned int node : nodes.cell_nodes(c))
          if (node < n_owned)
            action(node, c);
    };
    for_owned_nodes(
      [&](const unsigned int node, const unsigned int) { ++starts[node + 1]; });
    for (unsigned int node = 0; node < n_owned; ++node)
      starts[node + 1] += starts[node];
    cells.resize(starts.back());
    std::vector<unsigned int> next(starts);
    for_owned_nodes([&](const unsigned int node, const unsigned int c) {
      cells[next[node]++] = c;
    });

    NodeGraph rows;
    on_all_ranks(nodes.communicator(), [&] {
      std::vector<unsigned int> last_seen(nodes.n_local_nodes(), n_owned);
      for (unsigned int node = 0; node < n_owned; ++node)
        {
          for (unsigned int k = starts[node]; k < starts[node + 1]; ++k)
            for (const unsigned int other : nodes.cell_nodes(cells[k]))
              if (std::exchange(last_seen[other], node) != node)
                rows.columns.push_back(nodes.global_node(other));
          if (std::max<std::size_t>(rows.columns.size(),
                                    nodes.n_global_nodes()) > largest_int)
            throw ComputationError("a matrix with " +
                                   std::to_string(3 * nodes.n_global_nodes()) +
                                   " unknowns has too many entries for one "
                                   "rank");
          rows.starts.push_back(rows.columns.size());
        }
    });
    return std::make_shared<const BlockPattern>(rows, nodes.communicator());
  }

  BlockPlaces::BlockPlaces(const Nodes &nodes, const BlockPattern &pattern)
  {
    const unsigned int n_owned = nodes.n_owned_nodes();
    const std::size_t  n       = nodes.n_nodes_per_cell();
    low.resize(n * n * nodes.n_local_cells());
    std::size_t next = 0;
    for (unsigned int c = 0; c < nodes.n_local_cells(); ++c)
      for (const unsigned int i : nodes.cell_nodes(c))
        for (const unsigned int j : nodes.cell_nodes(c))
          {
            if (i < n_owned)
              {
                const int column =
                  j < n_owned ?
                    j :
                    pattern.nodes().local_node(nodes.global_node(j));
                const int place = pattern.place(i, column);
                AssertThrow(place <= std::numeric_limits<std::uint16_t>::max(),
                            dealii::ExcMessage(
                              "A row of the matrix is too long."));
                if (place >= 256 && high.empty())
                  high.resize(low.size());
                low[next] = place % 256;
                if (!high.empty())
                  high[next] = place / 256;
              }
            ++next;
          }
  }

  void
  AssembledMatrix::add_block(const unsigned int cell,
                             const unsigned int i,
                             const unsigned int j,
                             double (&block)[3][3])
  {
    const std::size_t n     = reference.n_nodes;
    const auto        nodes = this->nodes.cell_nodes(cell);
    if (touches_prescribed[cell])
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          if ((prescribed[3 * nodes[i] + a] || prescribed[3 * nodes[j] + b]) &&
              (i != j || a != b))
            block[a][b] = 0;
    const std::size_t first = n * n * cell;
    if (nodes[i] < this->nodes.n_owned_nodes())
      {
        double *row = block_matrix->row(nodes[i], 0) +
                      std::size_t(3) * places_of_blocks[first + n * i + j];
        const int length = block_matrix->row_length(nodes[i]);
        for (unsigned int a = 0; a < 3; ++a, row += length)
          for (unsigned int b = 0; b < 3; ++b)
            row[b] += block[a][b];
      }
    if (i != j && nodes[j] < this->nodes.n_owned_nodes())
      {
        double *row = block_matrix->row(nodes[j], 0) +
                      std::size_t(3) * places_of_blocks[first + n * j + i];
        const int length = block_matrix->row_length(nodes[j]);
        for (unsigned int a = 0; a < 3; ++a, row += length)
          for (unsigned int b = 0; b < 3; ++b)
            row[b] += block[b][a];
      }
  }

  void
  AssembledMatrix::add_lanes(const unsigned int first,
                             const unsigned int n_cells,
                             const unsigned int i,
                             const unsigned int j,
                             const V (&K)[3][3])
  {
    alignas(sizeof(V)) double lanes[9][batch_size];
    for (unsigned int ab = 0; ab < 9; ++ab)
      store_aligned(K[ab / 3][ab % 3], lanes[ab]);
    for (unsigned int lane = 0; lane < n_cells; ++lane)
      {
        double block[3][3];
        for (unsigned int ab = 0; ab < 9; ++ab)
          block[ab / 3][ab % 3] = lanes[ab][lane];
        add_block(first + lane, i, j, block);
      }
  }

  void
  AssembledMatrix::update(
    const double                                           c_K,
    const dealii::AlignedVector<CellCoefficients<double>> &coefficients,
    const double                                           c_M,
    const dealii::AlignedVector<CellMasses<double>>       &masses,
    const Vector                                          *lumped_mass,
    const SurfaceOperator<double>                         *surface)
  {
    block_matrix->set_zero();
    const double       consistent = lumped_mass == nullptr ? c_M : 0.;
    FrozenCellMatrices cells(nodes);
    cells.for_each_batch([&](const unsigned int first,
                             const unsigned int n_cells) {
      const unsigned int batch = nodes.batches().place(first).first;
      const V mass = consistent * load_aligned<batch_size>(masses[batch].mass);
      cells.for_each_block(first,
                           coefficients[batch],
                           mass,
                           [&](const unsigned int i,
                               const unsigned int j,
                               const auto        &K,
                               const V            m) {
                             V block[3][3];
                             for (unsigned int ab = 0; ab < 9; ++ab)
                               {
                                 block[ab / 3][ab % 3] =
                                   K[ab / 3][ab % 3] * c_K;
                                 if (ab % 4 == 0)
                                   block[ab / 3][ab % 3] += m;
                               }
                             add_lanes(first, n_cells, i, j, block);
                           });
    });
    add_others(c_M, lumped_mass, surface);
  }

  void
  AssembledMatrix::update(
    const std::function<
      void(const std::function<void(const unsigned int, const double *)> &)>
                                  &hand_over,
    const double                   c_M,
    const Vector                  *lumped_mass,
    const SurfaceOperator<double> *surface)
  {
    block_matrix->set_zero();
    const unsigned int n    = reference.n_nodes;
    const std::size_t  size = std::size_t(4) * batch_size * n;
    hand_over([&](const unsigned int batch, const double *columns) {
      const auto [first, n_cells] = nodes.batches().cells(batch);
      for (unsigned int lane = 0; lane < n_cells; ++lane)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = i; j < n; ++j)
            {
              const double *const entries = columns +
                                            std::size_t(3) * j * size +
                                            std::size_t(4) * (lane * n + i);
              const double *const transposed = columns +
                                               std::size_t(3) * i * size +
                                               std::size_t(4) * (lane * n + j);
              double block[3][3];
              for (unsigned int a = 0; a < 3; ++a)
                for (unsigned int b = 0; b < 3; ++b)
                  block[a][b] =
                    (entries[b * size + a] + transposed[a * size + b]) / 2;
              add_block(first + lane, i, j, block);
            }
    });
    add_others(c_M, lumped_mass, surface);
  }

  void
  AssembledMatrix::add_others(const double                   c_M,
                              const Vector                  *lumped_mass,
                              const SurfaceOperator<double> *surface)
  {
    if (lumped_mass != nullptr)
      for (unsigned int row = 0; row < 3 * nodes.n_owned_nodes(); ++row)
        block_matrix->diagonal(row) += c_M * lumped_mass->local_element(row);
    if (surface != nullptr)
      surface->for_each_block([&](const unsigned int cell,
                                  const unsigned int i,
                                  const unsigned int j,
                                  const auto        &S) {
        double block[3][3];
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            block[a][b] = S[a][b];
        add_block(cell, i, j, block);
      });
  }
} // namespace corotet
