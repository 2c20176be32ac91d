// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/with_degree.h>
#include <corotet/operators/assembled_matrix.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>
#include <limits>

namespace corotet
{
  using dealii::Tensor;
  using dealii::types::global_dof_index;

  AssembledMatrix::AssembledMatrix(
    const Nodes                      &nodes,
    const std::vector<unsigned char> &is_prescribed)
    : nodes(nodes)
    , reference(nodes.degree())
    , prescribed(is_prescribed)
  {
    make_sparsity();
    locate_blocks();
  }

  namespace
  {
    // The block of nodes i, j of mu (lambda / mu D + D^T + tr D I), with D the
    // integral of grad N_i (x) grad N_j, from the means of products of
    // derivatives of N_i and N_j and from the gradients of the kernel.
    Tensor<2, 3>
    stiffness_block(const double       *products,
                    const Tensor<2, 3> &gradients,
                    const double        lame_ratio)
    {
      Tensor<2, 3> half;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int l = 0; l < 3; ++l)
          for (unsigned int b = 0; b < 3; ++b)
            half[k][b] += products[3 * k + l] * gradients[l][b];
      Tensor<2, 3> D;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            D[a][b] += gradients[k][a] * half[k][b];
      const double trace_D = trace(D);
      Tensor<2, 3> K;
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          K[a][b] = lame_ratio * D[a][b] + D[b][a] + (a == b) * trace_D;
      return K;
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

  template <int p>
  void
  AssembledMatrix::add_cell(const unsigned int              cell,
                            const CellCoefficients<double> &coefficients,
                            const unsigned int              lane,
                            const double                    c_K,
                            const double                    cell_mass)
  {
    constexpr unsigned int n = bernstein::size<p>;
    // Rows: sqrt(mu volume) R grad xi_k.
    Tensor<2, 3> gradients;
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int a = 0; a < 3; ++a)
        gradients[k][a] = coefficients.gradients[3 * k + a][lane];
    const double         lame_ratio = coefficients.lame_ratio[lane];
    const auto           cell_nodes = nodes.cell_nodes(cell);
    const bool           has_fixed  = touches_prescribed[cell];
    const std::uint16_t *positions =
      block_positions.data() + 3 * static_cast<std::size_t>(n) * n * cell;

    const auto add = [&](const unsigned int  i,
                         const unsigned int  j,
                         const Tensor<2, 3> &block) {
      if (cell_nodes[i] >= nodes.n_owned_nodes())
        return;
      const std::uint16_t *position = positions + 3 * (n * i + j);
      for (unsigned int a = 0; a < 3; ++a)
        {
          double *values = row_values[3 * cell_nodes[i] + a];
          for (unsigned int b = 0; b < 3; ++b)
            values[position[b]] += block[a][b];
        }
    };

    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i; j < n; ++j)
        {
          Tensor<2, 3> block =
            c_K * stiffness_block(&reference.gradient_products(i, j, 0),
                                  gradients,
                                  lame_ratio);
          for (unsigned int a = 0; a < 3; ++a)
            block[a][a] += cell_mass * reference.mass[i][j];
          if (has_fixed)
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int b = 0; b < 3; ++b)
                if ((prescribed[3 * cell_nodes[i] + a] ||
                     prescribed[3 * cell_nodes[j] + b]) &&
                    !(i == j && a == b))
                  block[a][b] = 0;
          add(i, j, block);
          if (i != j)
            add(j, i, transpose(block));
        }
  }

  void
  AssembledMatrix::update(
    const double                                           c_K,
    const dealii::AlignedVector<CellCoefficients<double>> &coefficients,
    const double                                           c_M,
    const dealii::AlignedVector<CellMasses<double>>       &masses,
    const Vector                                          *lumped_mass)
  {
    for (unsigned int row = 0; row < row_values.size(); ++row)
      std::fill_n(row_values[row], row_lengths[row], 0.);
    const double consistent = lumped_mass == nullptr ? c_M : 0.;
    with_degree(nodes.degree(), [&](const auto p) {
      for (unsigned int c = 0; c < nodes.n_local_cells(); ++c)
        {
          const auto [batch, lane] = nodes.batches().place(c);
          add_cell<decltype(p)::value>(c,
                                       coefficients[batch],
                                       lane,
                                       c_K,
                                       consistent * masses[batch].mass[lane]);
        }
    });
    if (lumped_mass != nullptr)
      for (unsigned int row = 0; row < row_values.size(); ++row)
        row_values[row][diagonal_positions[row]] +=
          c_M * lumped_mass->local_element(row);
  }
} // namespace corotet
