// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/assembled_matrix.h>
#include <corotet/operators/curved_kernel.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>
#include <limits>

namespace corotet
{
  using dealii::types::global_dof_index;

  AssembledMatrix::AssembledMatrix(
    const Nodes                      &nodes,
    const std::vector<unsigned char> &is_prescribed)
    : nodes(nodes)
    , reference(nodes.element())
    , prescribed(is_prescribed)
  {
    make_sparsity();
    locate_blocks();
  }

  namespace
  {
    using V     = Simd<double>;
    using Block = V[3][3];

    // mu (lambda / mu D + D^T + tr D I).
    COROTET_ALWAYS_INLINE void
    isotropic_block(const Block &D, const V lame_ratio, Block &K)
    {
      const V trace = D[0][0] + D[1][1] + D[2][2];
      static_for<9>([&](auto ab) {
        constexpr int a = ab / 3, b = ab % 3;
        K[a][b] = lame_ratio * D[a][b] + D[b][a];
        if constexpr (a == b)
          K[a][b] += trace;
      });
    }

    // The block of nodes i, j, with D the integral of grad N_i (x) grad N_j,
    // from the means of products of
    // derivatives of N_i and N_j and from the gradients of the kernel.
    COROTET_ALWAYS_INLINE void
    stiffness_block(const double *products,
                    const V (&g)[9],
                    const V lame_ratio,
                    Block  &K)
    {
      Block half, D;
      static_for<9>([&](auto kb) {
        constexpr int k = kb / 3, b = kb % 3;
        half[k][b] = products[3 * k] * g[b] + products[3 * k + 1] * g[3 + b] +
                     products[3 * k + 2] * g[6 + b];
      });
      static_for<9>([&](auto ab) {
        constexpr int a = ab / 3, b = ab % 3;
        D[a][b] =
          g[a] * half[0][b] + g[3 + a] * half[1][b] + g[6 + a] * half[2][b];
      });
      isotropic_block(D, lame_ratio, K);
    }
  } // namespace

  void
  AssembledMatrix::make_sparsity()
  {
    const dealii::IndexSet &owned = nodes.partitioner()->locally_owned_range();
    dealii::DynamicSparsityPattern pattern(owned.size(), owned.size(), owned);
    std::vector<global_dof_index>  columns(3 * reference.n_nodes);
    for (unsigned int c = 0; c < nodes.n_local_cells(); ++c)
      {
        const auto cell_nodes = nodes.cell_nodes(c);
        for (unsigned int i = 0; i < reference.n_nodes; ++i)
          for (unsigned int a = 0; a < 3; ++a)
            columns[3 * i + a] = 3 * nodes.global_node(cell_nodes[i]) + a;
        std::sort(columns.begin(), columns.end());
        for (const unsigned int node : cell_nodes)
          if (node < nodes.n_owned_nodes())
            for (unsigned int a = 0; a < 3; ++a)
              pattern.add_entries(3 * nodes.global_node(node) + a,
                                  columns.begin(),
                                  columns.end(),
                                  true);
      }
    sparse_matrix.reinit(owned, pattern, nodes.communicator(), false);
  }

  void
  AssembledMatrix::locate_blocks()
  {
    const Epetra_CrsMatrix &matrix = sparse_matrix.trilinos_matrix();
    const unsigned int      n_rows = 3 * nodes.n_owned_nodes();
    std::vector<int *>      row_columns(n_rows);
    row_values.resize(n_rows);
    row_lengths.resize(n_rows);
    diagonal_positions.resize(n_rows);

    const auto position = [&](const unsigned int row, const int column) {
      const int *begin = row_columns[row];
      const int *found =
        std::lower_bound(begin, begin + row_lengths[row], column);
      Assert(*found == column, dealii::ExcInternalError());
      AssertThrow(found - begin <= std::numeric_limits<std::uint16_t>::max(),
                  dealii::ExcMessage("A row of the matrix is too long."));
      return static_cast<std::uint16_t>(found - begin);
    };
    // Epetra numbers the columns of other ranks in an order of its own: even
    // the three of a node may be apart.
    const auto column = [&](const unsigned int unknown) {
      return matrix.ColMap().LID(
        static_cast<int>(3 * nodes.global_node(unknown / 3) + unknown % 3));
    };

    for (unsigned int row = 0; row < n_rows; ++row)
      matrix.ExtractMyRowView(row,
                              row_lengths[row],
                              row_values[row],
                              row_columns[row]);
    for (unsigned int row = 0; row < n_rows; ++row)
      diagonal_positions[row] = position(row, column(row));

    const unsigned int n = reference.n_nodes;
    block_positions.resize(3 * static_cast<std::size_t>(n) * n *
                           nodes.n_local_cells());
    touches_prescribed.resize(nodes.n_local_cells());
    std::vector<int> columns(3 * n);
    std::uint16_t   *next = block_positions.data();
    for (unsigned int c = 0; c < nodes.n_local_cells(); ++c)
      {
        const auto cell_nodes = nodes.cell_nodes(c);
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int a = 0; a < 3; ++a)
            {
              columns[3 * j + a] = column(3 * cell_nodes[j] + a);
              touches_prescribed[c] |= prescribed[3 * cell_nodes[j] + a];
            }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < 3 * n; ++j, ++next)
            if (cell_nodes[i] < nodes.n_owned_nodes())
              *next = position(3 * cell_nodes[i], columns[j]);
      }
  }

  void
  AssembledMatrix::add_block(const unsigned int cell,
                             const unsigned int i,
                             const unsigned int j,
                             double (&block)[3][3])
  {
    const unsigned int n     = reference.n_nodes;
    const auto         nodes = this->nodes.cell_nodes(cell);
    if (touches_prescribed[cell])
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          if ((prescribed[3 * nodes[i] + a] || prescribed[3 * nodes[j] + b]) &&
              !(i == j && a == b))
            block[a][b] = 0;
    const std::uint16_t *const positions =
      block_positions.data() + 3 * static_cast<std::size_t>(n) * n * cell;
    if (nodes[i] < this->nodes.n_owned_nodes())
      {
        const std::uint16_t *const position = positions + 3 * (n * i + j);
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            row_values[3 * nodes[i] + a][position[b]] += block[a][b];
      }
    if (i != j && nodes[j] < this->nodes.n_owned_nodes())
      {
        const std::uint16_t *const position = positions + 3 * (n * j + i);
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            row_values[3 * nodes[j] + a][position[b]] += block[b][a];
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
  AssembledMatrix::add_batch(const unsigned int              first,
                             const unsigned int              n_cells,
                             const CellCoefficients<double> &coefficients,
                             const double                    c_K,
                             const V                         masses)
  {
    V g[9];
    for (unsigned int i = 0; i < 9; ++i)
      g[i] = load_aligned<batch_size>(coefficients.gradients[i]);
    const V ratio = load_aligned<batch_size>(coefficients.lame_ratio);
    for (unsigned int i = 0; i < reference.n_nodes; ++i)
      for (unsigned int j = i; j < reference.n_nodes; ++j)
        {
          Block K;
          stiffness_block(&reference.gradient_products(i, j, 0), g, ratio, K);
          for (unsigned int ab = 0; ab < 9; ++ab)
            {
              K[ab / 3][ab % 3] *= c_K;
              if (ab % 4 == 0)
                K[ab / 3][ab % 3] += masses * reference.mass(i, j);
            }
          add_lanes(first, n_cells, i, j, K);
        }
  }

  void
  AssembledMatrix::add_curved_batch(
    const unsigned int              first,
    const unsigned int              n_cells,
    const CellCoefficients<double> &coefficients,
    const double                    c_K,
    const V                         masses)
  {
    const CurvedBatches &curved = *nodes.batches().curved();
    const unsigned int   n = reference.n_nodes, n_points = curved.n_points();
    const unsigned int   batch  = nodes.batches().place(first).first;
    const auto          &values = curved.shapes().values;
    const V ratio = load_aligned<batch_size>(coefficients.lame_ratio);

    // Gradients of the shape functions at the points, [q][node], and weights.
    point_gradients.resize(n_points * n);
    point_weights.resize(n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        using Kernel = CurvedKernel<1, double>;
        const Kernel::Point point(curved, batch, q);
        V                   g[3][3];
        Kernel::gradients(point, coefficients, g);
        point_weights[q] = point.number(9);
        const double *dN = &curved.shapes().gradients(q, 0, 0);
        for (unsigned int i = 0; i < n; ++i, dN += 3)
          for (unsigned int a = 0; a < 3; ++a)
            point_gradients[q * n + i][a] =
              dN[0] * g[0][a] + dN[1] * g[1][a] + dN[2] * g[2][a];
      }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i; j < n; ++j)
        {
          Block D{}, K;
          V     mass{};
          for (unsigned int q = 0; q < n_points; ++q)
            {
              const auto &gi = point_gradients[q * n + i];
              const auto &gj = point_gradients[q * n + j];
              static_for<9>([&](auto ab) {
                D[ab / 3][ab % 3] +=
                  c_K * point_weights[q] * gi[ab / 3] * gj[ab % 3];
              });
              mass += masses * point_weights[q] * (values[q][i] * values[q][j]);
            }
          isotropic_block(D, ratio, K);
          static_for<3>([&](auto a) { K[a][a] += mass; });
          add_lanes(first, n_cells, i, j, K);
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
    for (unsigned int row = 0; row < row_values.size(); ++row)
      std::fill_n(row_values[row], row_lengths[row], 0.);
    const double consistent = lumped_mass == nullptr ? c_M : 0.;
    const auto   add = [&](const unsigned int begin, const unsigned int end) {
      for (unsigned int first = begin; first < end; first += batch_size)
        {
          const unsigned int batch  = nodes.batches().place(first).first;
          const auto        *curved = nodes.batches().curved();
          const auto function = curved != nullptr && curved->has(batch) ?
                                    &AssembledMatrix::add_curved_batch :
                                    &AssembledMatrix::add_batch;
          (this->*function)(first,
                            std::min(batch_size, end - first),
                            coefficients[batch],
                            c_K,
                            consistent *
                              load_aligned<batch_size>(masses[batch].mass));
        }
    };
    add(0, nodes.n_owned_cells());
    add(nodes.n_owned_cells(), nodes.n_local_cells());
    if (lumped_mass != nullptr)
      for (unsigned int row = 0; row < row_values.size(); ++row)
        row_values[row][diagonal_positions[row]] +=
          c_M * lumped_mass->local_element(row);
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
