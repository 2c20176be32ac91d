// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_solvers_spring_box_h
#define corotet_tests_solvers_spring_box_h

#include <corotet/operators/block_matrix.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

namespace corotet::tests
{
  /// A box of nodes at unit distance, each joined to its 26 neighbours by
  /// springs of stiffness about 1: K has the six rigid body motions as its null
  /// space if no side is clamped.
  class SpringBox
  {
  public:
    SpringBox(const std::array<int, 3> &cells,
              const bool                clamped,
              const MPI_Comm            comm = MPI_COMM_WORLD)
      : cells(cells)
      , clamped(clamped)
    {
      const int n_nodes = (cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1);
      // Ranks have different numbers of nodes.
      const int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
      const int rank    = dealii::Utilities::MPI::this_mpi_process(comm);
      const int first   = n_nodes * rank * rank / (n_ranks * n_ranks);
      const int end = n_nodes * (rank + 1) * (rank + 1) / (n_ranks * n_ranks);
      owned.set_size(3 * n_nodes);
      owned.add_range(3 * first, 3 * end);
      NodeGraph rows;
      for (int node = first; node < end; ++node)
        {
          for (const auto &[column, block] : blocks_of(node))
            rows.columns.push_back(column);
          rows.starts.push_back(rows.columns.size());
        }
      pattern = std::make_shared<const BlockPattern>(rows, comm);
      matrix  = std::make_unique<BlockMatrix>(pattern);
      for (int i = 0; i < end - first; ++i)
        for (const auto &[column, block] : blocks_of(first + i))
          for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
              matrix->row(
                i,
                a)[3 * pattern->place(i, pattern->nodes().local_node(column)) +
                   b] = block[a][b];
    }

    /// Adds @p mass to the diagonal of the matrix.
    void
    add_mass(const double mass)
    {
      for (int row = 0; row < 3 * pattern->n_owned(); ++row)
        matrix->diagonal(row) += mass;
    }

    /// Three coordinates of each owned node.
    std::vector<double>
    positions() const
    {
      std::vector<double> result;
      for (int i = 0; i < pattern->n_owned(); ++i)
        for (const int x : position(pattern->nodes().global_node(i)))
          result.push_back(x);
      return result;
    }

    /// A vector with the rows of the matrix.
    Vector
    vector() const
    {
      return Vector(owned, pattern->communicator());
    }

    dealii::IndexSet                    owned;
    std::shared_ptr<const BlockPattern> pattern;
    std::unique_ptr<BlockMatrix>        matrix;

  private:
    std::array<int, 3>
    position(const int node) const
    {
      const int n_y = cells[1] + 1, n_z = cells[2] + 1;
      return {{node / (n_y * n_z), node / n_z % n_y, node % n_z}};
    }

    bool
    is_fixed(const std::array<int, 3> &x) const
    {
      return clamped && x[0] == 0;
    }

    /// The blocks in the row of a node, by global columns.
    std::map<int, dealii::Tensor<2, 3>>
    blocks_of(const int node) const
    {
      const auto                          x = position(node);
      std::map<int, dealii::Tensor<2, 3>> blocks;
      dealii::Tensor<2, 3>               &diagonal = blocks[node];
      for (int n = 0; n < 27; ++n)
        {
          const std::array<int, 3> y{
            {x[0] + n / 9 - 1, x[1] + n / 3 % 3 - 1, x[2] + n % 3 - 1}};
          if (n == 13 || y[0] < 0 || y[0] > cells[0] || y[1] < 0 ||
              y[1] > cells[1] || y[2] < 0 || y[2] > cells[2])
            continue;
          const int other =
            (y[0] * (cells[1] + 1) + y[1]) * (cells[2] + 1) + y[2];
          dealii::Tensor<1, 3> d;
          for (int a = 0; a < 3; ++a)
            d[a] = y[a] - x[a];
          const dealii::Tensor<2, 3> stiffness =
            (1 + 0.5 * std::sin(node + other)) / d.norm_square() *
            outer_product(d, d);
          blocks[other] =
            is_fixed(x) || is_fixed(y) ? 0. * stiffness : -1. * stiffness;
          diagonal += stiffness;
        }
      if (is_fixed(x))
        diagonal = dealii::unit_symmetric_tensor<3>();
      return blocks;
    }

    std::array<int, 3> cells;
    bool               clamped;
  };
} // namespace corotet::tests

#endif
