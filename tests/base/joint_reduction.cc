// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Sums and maxima over all ranks with one message, and inner products.

#include <corotet/base/joint_reduction.h>
#include <corotet/base/vector.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace corotet;

namespace
{
  unsigned int
  rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }

  unsigned int
  n_ranks()
  {
    return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  }
} // namespace

TEST(JointReduction, AllKinds)
{
  const unsigned int   r = rank(), n = n_ranks();
  const unsigned int   triangle = n * (n + 1) / 2;
  double               sum = r + 1., largest = r, smallest = -2. - r;
  unsigned int         count = r + 1;
  dealii::Tensor<1, 3> vector({1., r + 1., -1.});
  JointReduction       reduction;
  reduction.max(largest);
  reduction.sum(count);
  reduction.sum(vector);
  reduction.min(smallest);
  reduction.sum(sum);
  reduction.run(MPI_COMM_WORLD);
  EXPECT_EQ(sum, triangle);
  EXPECT_EQ(count, triangle);
  EXPECT_EQ(largest, n - 1);
  EXPECT_EQ(smallest, -1. - n);
  EXPECT_EQ(vector, (dealii::Tensor<1, 3>({1. * n, 1. * triangle, -1. * n})));
}

TEST(JointReduction, OnlyMaxima)
{
  double         largest = rank() == n_ranks() - 1 ? 3 : -1;
  JointReduction reduction;
  reduction.max(largest);
  reduction.run(MPI_COMM_WORLD);
  EXPECT_EQ(largest, 3);
}

// A value that is not a number reaches all ranks, whichever rank has it.
TEST(JointReduction, NotFinite)
{
  for (unsigned int of = 0; of < n_ranks(); ++of)
    {
      const double   nan = std::numeric_limits<double>::quiet_NaN();
      double         sum = rank() == of ? nan : 1, largest = sum;
      JointReduction reduction;
      reduction.sum(sum);
      reduction.max(largest);
      reduction.run(MPI_COMM_WORLD);
      EXPECT_TRUE(std::isnan(sum)) << of;
      EXPECT_TRUE(std::isnan(largest)) << of;
    }
}

// Entries are whole numbers, whose sums are exact in any order.
TEST(Vectors, InnerProducts)
{
  for (unsigned int size = 0; size < 70; ++size)
    {
      Vector a(size), b(size);
      double product = 0, square = 0;
      for (unsigned int i = 0; i < size; ++i)
        {
          a.local_element(i) = i + 1;
          b.local_element(i) = 3. * i - 5;
          product += (i + 1) * (3. * i - 5);
          square += (i + 1) * (i + 1);
        }
      EXPECT_EQ(local_inner_product(a, b), product) << size;
      EXPECT_EQ(norm(a), std::sqrt(square)) << size;
      const auto found = norms<3>({{&a, nullptr, &a}});
      EXPECT_EQ(found[0], std::sqrt(square));
      EXPECT_EQ(found[1], 0);
      EXPECT_EQ(found[2], std::sqrt(square));
    }
}
