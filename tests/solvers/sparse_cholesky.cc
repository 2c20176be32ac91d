// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The factorisation inverts stiffness matrices up to round-off times the
// condition number, in both precisions, for vectors of both, on one rank and on
// two; it follows new values and new patterns; a body that can move is refused.

#include <corotet/base/exceptions.h>
#include <corotet/solvers/sparse_cholesky.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <string>

using namespace corotet;
using dealii::Tensor;
using Cells     = std::array<int, 3>;
using Precision = SparseCholesky::Precision;
template <typename Number>
using DistributedVector = dealii::LinearAlgebra::distributed::Vector<Number>;

namespace
{
  /// A box of nodes at unit distance, each joined to its 26 neighbours by
  /// springs of stiffness about 1: K has the six rigid body motions as its null
  /// space if no side is clamped.
  class SpringBox
  {
  public:
    SpringBox(const Cells &cells, const bool clamped)
      : cells(cells)
      , clamped(clamped)
      , communicator(MPI_COMM_WORLD)
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

    /// Largest error of @p inverse applied to K x, where x has entries of
    /// size 1.
    template <typename Number>
    double
    error(const SparseCholesky &inverse) const
    {
      Epetra_Vector x(matrix->RowMap()), b(matrix->RowMap());
      for (int i = 0; i < x.MyLength(); ++i)
        x[i] = std::cos(0.1 * matrix->GRID(i));
      matrix->Multiply(false, x, b);
      DistributedVector<Number> rhs(owned, MPI_COMM_WORLD), y(rhs);
      for (int i = 0; i < b.MyLength(); ++i)
        rhs.local_element(i) = b[i];
      inverse.vmult(y, rhs);
      double largest = 0;
      for (int i = 0; i < b.MyLength(); ++i)
        largest = std::max(largest, std::abs(x[i] - y.local_element(i)));
      return dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
    }

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
      const auto                  x = position(node);
      std::map<int, Tensor<2, 3>> blocks;
      Tensor<2, 3>               &diagonal = blocks[node];
      for (int n = 0; n < 27; ++n)
        {
          const std::array<int, 3> y{
            {x[0] + n / 9 - 1, x[1] + n / 3 % 3 - 1, x[2] + n % 3 - 1}};
          if (n == 13 || y[0] < 0 || y[0] > cells[0] || y[1] < 0 ||
              y[1] > cells[1] || y[2] < 0 || y[2] > cells[2])
            continue;
          const int other =
            (y[0] * (cells[1] + 1) + y[1]) * (cells[2] + 1) + y[2];
          Tensor<1, 3> d;
          for (int a = 0; a < 3; ++a)
            d[a] = y[a] - x[a];
          const Tensor<2, 3> stiffness = (1 + 0.5 * std::sin(node + other)) /
                                         d.norm_square() * outer_product(d, d);
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

    Cells            cells;
    bool             clamped;
    Epetra_MpiComm   communicator;
    dealii::IndexSet owned;
  };
} // namespace

// The condition number of these boxes is below 1e4. Single precision of the
// right hand side counts too. The second box has more nodes than are ordered by
// minimum degree.
TEST(SparseCholesky, InvertsMatrix)
{
  for (const auto &cells : {Cells{{8, 2, 2}}, Cells{{20, 16, 15}}})
    {
      const SpringBox box(cells, true);
      SparseCholesky  inverse;
      inverse.factorize(*box.matrix);
      EXPECT_EQ(inverse.precision(), Precision::double_precision);
      EXPECT_LT(box.error<double>(inverse), 1e-11);
      EXPECT_LT(box.error<float>(inverse), 1e-2);
      EXPECT_GT(inverse.n_entries(),
                static_cast<std::size_t>(box.matrix->NumGlobalRows()));
    }
}

TEST(SparseCholesky, InvertsMatrixInSinglePrecision)
{
  const SpringBox box({{8, 2, 2}}, true);
  SparseCholesky  inverse(Precision::single_precision);
  inverse.factorize(*box.matrix);
  EXPECT_EQ(inverse.precision(), Precision::single_precision);
  EXPECT_LT(box.error<float>(inverse), 1e-2);
  const double error = box.error<double>(inverse);
  EXPECT_LT(error, 1e-2);
  // It is single precision indeed.
  EXPECT_GT(error, 1e-9);
}

// Other values in the same pattern, another pattern, and a start afresh.
TEST(SparseCholesky, FollowsMatrix)
{
  SpringBox      box({{4, 2, 2}}, true);
  SparseCholesky inverse;
  inverse.factorize(*box.matrix);
  box.add_mass(3.);
  EXPECT_GT(box.error<double>(inverse), 0.1);
  inverse.factorize(*box.matrix);
  EXPECT_LT(box.error<double>(inverse), 1e-12);

  const SpringBox other({{3, 4, 3}}, true);
  inverse.factorize(*other.matrix);
  EXPECT_LT(other.error<double>(inverse), 1e-11);
  inverse.clear();
  EXPECT_EQ(inverse.n_entries(), 0u);
  inverse.factorize(*box.matrix);
  EXPECT_LT(box.error<double>(inverse), 1e-12);
}

// In exact arithmetic, six pivots of a free body are zero; round-off makes them
// negative or tiny. Inertia makes the matrix definite.
TEST(SparseCholesky, RefusesFreeBody)
{
  for (const int length : {1, 3, 8, 20})
    for (const Precision precision :
         {Precision::single_precision, Precision::double_precision})
      {
        SpringBox      box({{length, 2, 3}}, false);
        SparseCholesky inverse(precision);
        std::string    message = "none";
        try
          {
            inverse.factorize(*box.matrix);
          }
        catch (const ComputationError &error)
          {
            message = error.what();
          }
        EXPECT_EQ(message,
                  "the stiffness matrix is singular: the body or a part of it "
                  "can move without resistance, because not enough is "
                  "prescribed")
          << length;
        EXPECT_EQ(inverse.n_entries(), 0u);
        box.add_mass(1e-3);
        inverse.factorize(*box.matrix);
        EXPECT_EQ(inverse.precision(), precision);
        EXPECT_LT(box.error<double>(inverse),
                  precision == Precision::double_precision ? 1e-10 : 0.1);
      }
}

// The pivots of the free end are as small as the third power of the
// slenderness, less than single precision resolves: double precision takes its
// place. The condition number is below 1e11.
TEST(SparseCholesky, SlenderBodyNeedsDoublePrecision)
{
  const SpringBox box({{400, 1, 1}}, true);
  SparseCholesky  inverse(Precision::single_precision);
  inverse.factorize(*box.matrix);
  EXPECT_EQ(inverse.precision(), Precision::double_precision);
  EXPECT_LT(box.error<double>(inverse), 1e-4);
}
