// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_solvers_spring_box_h
#define corotet_tests_solvers_spring_box_h

#include <deal.II/base/index_set.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
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
      , communicator(comm)
    {
      const int n_nodes = (cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1);
      // Not the same number on all ranks.
      const int n_ranks = communicator.NumProc();
      const int rank    = communicator.MyPID();
      const int first   = n_nodes * rank * rank / (n_ranks * n_ranks);
      const int end = n_nodes * (rank + 1) * (rank + 1) / (n_ranks * n_ranks);
      const Epetra_Map rows(3 * n_nodes, 3 * (end - first), 0, communicator);
      owned.set_size(3 * n_nodes);
      owned.add_range(3 * first, 3 * end);
      matrix = std::make_unique<Epetra_CrsMatrix>(Copy, rows, 81);
      for (int node = first; node < end; ++node)
        add_rows(node);
      matrix->FillComplete();
    }

    /// Adds @p mass to the diagonal.
    void
    add_mass(const double mass)
    {
      Epetra_Vector diagonal(matrix->RowMap());
      matrix->ExtractDiagonalCopy(diagonal);
      for (int i = 0; i < diagonal.MyLength(); ++i)
        diagonal[i] += mass;
      matrix->ReplaceDiagonalValues(diagonal);
    }

    /// Three coordinates of each owned node.
    std::vector<double>
    positions() const
    {
      std::vector<double> result;
      for (int i = 0; i < matrix->NumMyRows(); i += 3)
        for (const int x : position(matrix->GRID(i) / 3))
          result.push_back(x);
      return result;
    }

    dealii::IndexSet                  owned;
    std::unique_ptr<Epetra_CrsMatrix> matrix;

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

    void
    add_rows(const int node)
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
      for (const auto &[other, block] : blocks)
        for (int a = 0; a < 3; ++a)
          {
            std::array<int, 3> columns;
            std::iota(columns.begin(), columns.end(), 3 * other);
            matrix->InsertGlobalValues(3 * node + a,
                                       3,
                                       &block[a][0],
                                       columns.data());
          }
    }

    std::array<int, 3> cells;
    bool               clamped;
    Epetra_MpiComm     communicator;
  };
} // namespace corotet::tests

#endif
