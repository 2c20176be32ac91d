// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Blocks of vectors meet Anasazi's requirements, by its own test, and give the
// same results as single vectors.

#include <corotet/solvers/anasazi_adapter.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <AnasaziBasicOutputManager.hpp>
#include <AnasaziMVOPTester.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace corotet;

namespace
{
  // More owned entries than are processed at a time, and no multiple of the
  // number of entries that are summed together. Every seventh entry is no
  // unknown.
  constexpr unsigned int n_owned = 1237;

  std::shared_ptr<VectorSpace>
  make_space()
  {
    const unsigned int rank =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    dealii::IndexSet owned(n_owned * n_ranks);
    owned.add_range(n_owned * rank, n_owned * (rank + 1));
    std::vector<unsigned int> free;
    for (unsigned int i = 0; i < n_owned; ++i)
      if (i % 7 != 0)
        free.push_back(i);
    return std::make_shared<VectorSpace>(Vector(owned, MPI_COMM_WORLD), free);
  }

  class Doubling : public BlockOperator
  {
  public:
    void
    apply(const MultiVector &X, MultiVector &Y) const override
    {
      Y.set_to_sum(2., X, 0., X);
    }
  };

  /// The largest difference of owned entries over all ranks.
  double
  difference(const Vector &x, const Vector &y)
  {
    Vector d(x);
    d -= y;
    return d.linfty_norm();
  }
} // namespace

TEST(MultiVector, PassesAnasazisTest)
{
  const auto vectors = Teuchos::rcp(new MultiVector(make_space(), 5));
  vectors->set_random();
  const Teuchos::RCP<const MultiVector>              any = vectors;
  const Teuchos::RCP<Anasazi::OutputManager<double>> output =
    Teuchos::rcp(new Anasazi::BasicOutputManager<double>(Anasazi::Warnings));
  EXPECT_TRUE((Anasazi::TestMultiVecTraits<double, MultiVector>(output, any)));
  const Teuchos::RCP<const BlockOperator> op = Teuchos::rcp(new Doubling);
  EXPECT_TRUE((Anasazi::TestOperatorTraits<double, MultiVector, BlockOperator>(
    output, any, op)));
}

// Tolerances are those of sums of a thousand products of size one, in another
// order.
TEST(MultiVector, CalculatesAsVectorsDo)
{
  const auto  space = make_space();
  MultiVector A(space, 7), B(space, 3), C(space, 3);
  A.set_random();
  B.set_random();
  C.set_random();
  const MultiVector   before = C.copy();
  std::vector<double> numbers(8 * 3, 0.);
  // The leading dimension of the small matrix is larger than its number of
  // rows.
  const DenseView<double> M{numbers.data(), 7, 3, 8};
  MultiVector::products(M, -2., A, B);
  for (unsigned int j = 0; j < 3; ++j)
    {
      for (unsigned int i = 0; i < 7; ++i)
        EXPECT_NEAR(M(i, j), -2. * (A[i] * B[j]), 1e-11);
      EXPECT_EQ(numbers[8 * j + 7], 0.);
    }
  const std::vector<double> dots = B.dots(C);
  for (unsigned int j = 0; j < 3; ++j)
    EXPECT_NEAR(dots[j], B[j] * C[j], 1e-12 * n_owned);

  for (unsigned int i = 0; i < numbers.size(); ++i)
    numbers[i] = std::cos(i);
  C.add_product(3., A, {numbers.data(), 7, 3, 8}, 0.5);
  for (unsigned int j = 0; j < 3; ++j)
    {
      Vector expected(before[j]);
      expected *= 0.5;
      for (unsigned int i = 0; i < 7; ++i)
        expected.add(3. * M(i, j), A[i]);
      EXPECT_LE(difference(C[j], expected), 1e-14);
      EXPECT_GT(difference(C[j], before[j]), 0.1);
    }
}

// Vectors that are multiplied by zero may hold values that are not numbers.
TEST(MultiVector, OverwritesAnything)
{
  const auto  space = make_space();
  MultiVector A(space, 2), C(space, 2);
  A.set_random();
  C.fill(std::numeric_limits<double>::quiet_NaN());
  const std::vector<double> identity{1, 0, 0, 1};
  C.add_product(1., A, {identity.data(), 2, 2, 2}, 0.);
  EXPECT_EQ(difference(C[1], A[1]), 0.);
  MultiVector D(space, 2);
  D.fill(std::numeric_limits<double>::quiet_NaN());
  D.set_to_sum(0., D, 1., A);
  EXPECT_EQ(difference(D[0], A[0]), 0.);
}

// A view writes into its columns of the original, a copy does not; entries that
// are no unknowns stay zero.
TEST(MultiVector, ViewsAndCopies)
{
  const auto  space = make_space();
  MultiVector A(space, 4);
  A.fill(1.);
  MultiVector copy = A.copy(), view = A.view({3, 1});
  view.fill(5.);
  EXPECT_EQ(view[0].linfty_norm(), 5.);
  EXPECT_EQ(A[3].linfty_norm(), 5.);
  EXPECT_EQ(A[1].linfty_norm(), 5.);
  EXPECT_EQ(A[2].linfty_norm(), 1.);
  EXPECT_EQ(copy[3].linfty_norm(), 1.);
  A.set_random();
  for (unsigned int i = 0; i < n_owned; i += 7)
    EXPECT_EQ(A[0].local_element(i), 0.);
  // The mean of squares of the random entries is 1/3, with a deviation of 0.3 /
  // sqrt(n).
  const double n = space->dimension;
  EXPECT_EQ(n,
            (n_owned - (n_owned + 6) / 7) *
              dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
  EXPECT_NEAR(A.dots(A)[2] / n, 1. / 3, 2 / std::sqrt(n));
}
