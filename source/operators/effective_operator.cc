// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/cell_kernel.h>
#include <corotet/operators/effective_operator.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>
#include <limits>

namespace corotet
{
  using dealii::Tensor;
  using dealii::types::global_dof_index;

  EffectiveOperator::EffectiveOperator(
    const Discretization             &discretization,
    const ReferenceElement           &reference,
    const Elasticity                 &elasticity,
    const Mass                       &mass,
    const std::vector<unsigned char> &is_prescribed)
    : disc(discretization)
    , reference(reference)
    , elasticity(elasticity)
    , mass(mass)
    , prescribed(is_prescribed)
  {
    make_sparsity();
    locate_blocks();
  }

  void
  EffectiveOperator::make_sparsity()
  {
    const dealii::IndexSet &owned = disc.partitioner()->locally_owned_range();
    dealii::DynamicSparsityPattern pattern(owned.size(), owned.size(), owned);
    std::vector<global_dof_index>  columns(3 * reference.n_nodes);
    for (unsigned int c = 0; c < disc.n_local_cells(); ++c)
      {
        const auto nodes = disc.cell_nodes(c);
        for (unsigned int i = 0; i < reference.n_nodes; ++i)
          for (unsigned int a = 0; a < 3; ++a)
            columns[3 * i + a] = 3 * disc.global_node(nodes[i]) + a;
        std::sort(columns.begin(), columns.end());
        for (const unsigned int node : nodes)
          if (node < disc.n_owned_nodes())
            for (unsigned int a = 0; a < 3; ++a)
              pattern.add_entries(3 * disc.global_node(node) + a,
                                  columns.begin(),
                                  columns.end(),
                                  true);
      }
    sparse_matrix.reinit(owned, pattern, disc.communicator(), false);
  }

  void
  EffectiveOperator::locate_blocks()
  {
    const Epetra_CrsMatrix &matrix = sparse_matrix.trilinos_matrix();
    const unsigned int      n_rows = 3 * disc.n_owned_nodes();
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
    const auto column = [&](const unsigned int node) {
      return matrix.ColMap().LID(static_cast<int>(3 * disc.global_node(node)));
    };

    for (unsigned int row = 0; row < n_rows; ++row)
      matrix.ExtractMyRowView(row,
                              row_lengths[row],
                              row_values[row],
                              row_columns[row]);
    for (unsigned int row = 0; row < n_rows; ++row)
      diagonal_positions[row] = position(row, column(row / 3)) + row % 3;

    const unsigned int n = reference.n_nodes;
    block_positions.resize(static_cast<std::size_t>(n) * n *
                           disc.n_local_cells());
    touches_prescribed.resize(disc.n_local_cells());
    std::vector<int> columns(n);
    std::uint16_t   *next = block_positions.data();
    for (unsigned int c = 0; c < disc.n_local_cells(); ++c)
      {
        const auto nodes = disc.cell_nodes(c);
        for (unsigned int j = 0; j < n; ++j)
          {
            columns[j] = column(nodes[j]);
            for (unsigned int a = 0; a < 3; ++a)
              touches_prescribed[c] |= prescribed[3 * nodes[j] + a];
          }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j, ++next)
            if (nodes[i] < disc.n_owned_nodes())
              *next = position(3 * nodes[i], columns[j]);
      }
  }

  template <int p>
  void
  EffectiveOperator::add_cell(const unsigned int cell,
                              const double       c_K,
                              const double       c_M)
  {
    using Kernel             = CellKernel<p>;
    constexpr unsigned int n = Kernel::n_nodes;

    const CellGeometry &geometry = disc.geometry(cell);
    const auto          nodes    = disc.cell_nodes(cell);
    // Rows: R grad xi_k.
    const Tensor<2, 3> gradients =
      geometry.inverse_jacobian * transpose(elasticity.rotation(cell));
    const double mass_factor =
      mass.is_lumped() ? 0. : c_M * mass.cell_mass(cell);
    const std::uint16_t *positions =
      block_positions.data() + static_cast<std::size_t>(n) * n * cell;

    const auto add = [&](const unsigned int  i,
                         const unsigned int  j,
                         const Tensor<2, 3> &block) {
      if (nodes[i] >= disc.n_owned_nodes())
        return;
      const std::uint16_t position = positions[n * i + j];
      for (unsigned int a = 0; a < 3; ++a)
        {
          double *values = row_values[3 * nodes[i] + a] + position;
          for (unsigned int b = 0; b < 3; ++b)
            values[b] += block[a][b];
        }
    };

    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i; j < n; ++j)
        {
          Tensor<2, 3> block =
            c_K * Kernel::stiffness_block(reference,
                                          elasticity.material(cell),
                                          gradients,
                                          geometry.volume,
                                          i,
                                          j);
          for (unsigned int a = 0; a < 3; ++a)
            block[a][a] += mass_factor * reference.mass[i][j];
          if (touches_prescribed[cell])
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int b = 0; b < 3; ++b)
                if ((prescribed[3 * nodes[i] + a] ||
                     prescribed[3 * nodes[j] + b]) &&
                    !(i == j && a == b))
                  block[a][b] = 0;
          add(i, j, block);
          if (i != j)
            add(j, i, transpose(block));
        }
  }

  void
  EffectiveOperator::update(const double c_K, const double c_M)
  {
    ratio = c_M / c_K;
    for (unsigned int row = 0; row < row_values.size(); ++row)
      std::fill_n(row_values[row], row_lengths[row], 0.);
    with_degree(disc.degree(), [&](const auto p) {
      for (unsigned int c = 0; c < disc.n_local_cells(); ++c)
        add_cell<decltype(p)::value>(c, c_K, c_M);
    });
    if (mass.is_lumped())
      for (unsigned int row = 0; row < row_values.size(); ++row)
        row_values[row][diagonal_positions[row]] +=
          c_M * mass.diagonal().local_element(row);
  }
} // namespace corotet
