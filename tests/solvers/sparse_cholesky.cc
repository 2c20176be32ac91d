// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The factorisation inverts stiffness matrices up to round-off times the
// condition number, in both precisions, for vectors of both, on one rank and on
// two; it follows new values and new patterns and refuses a body that can move.

#include <corotet/base/exceptions.h>
#include <corotet/solvers/sparse_cholesky.h>

#include <deal.II/base/mpi.h>

#include <SuiteSparse_config.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "spring_box.h"

using namespace corotet;
using namespace corotet::tests;
using Cells     = std::array<int, 3>;
using Precision = SparseCholesky::Precision;
template <typename Number>
using DistributedVector = dealii::LinearAlgebra::distributed::Vector<Number>;

namespace
{
  /// The largest error of @p inverse applied to K x, where x has entries of
  /// size 1.
  template <typename Number>
  double
  error(const SpringBox &box, const SparseCholesky &inverse)
  {
    Vector             x = box.vector(), b(x);
    const unsigned int n = x.locally_owned_size();
    for (unsigned int i = 0; i < n; ++i)
      x.local_element(i) = std::cos(0.1 * box.owned.nth_index_in_set(i));
    box.matrix->vmult(b, x);
    DistributedVector<Number> rhs(box.owned, MPI_COMM_WORLD), y(rhs);
    for (unsigned int i = 0; i < n; ++i)
      rhs.local_element(i) = b.local_element(i);
    inverse.vmult(y, rhs);
    double largest = 0;
    for (unsigned int i = 0; i < n; ++i)
      largest =
        std::max(largest, std::abs(x.local_element(i) - y.local_element(i)));
    return dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
  }

  /// While it lives, CHOLMOD gets @p n more blocks of memory on this rank; then
  /// it gets no more, or, with @p once, only the next one is refused.
  class MemoryLimit
  {
  public:
    MemoryLimit(const long n, const bool once)
    {
      left       = n;
      lacks_once = once;
      SuiteSparse_config_malloc_func_set([](std::size_t size) {
        return is_there() ? std::malloc(size) : nullptr;
      });
      SuiteSparse_config_calloc_func_set([](std::size_t n, std::size_t size) {
        return is_there() ? std::calloc(n, size) : nullptr;
      });
      SuiteSparse_config_realloc_func_set([](void *block, std::size_t size) {
        return is_there() ? std::realloc(block, size) : nullptr;
      });
    }

    ~MemoryLimit()
    {
      SuiteSparse_config_malloc_func_set(std::malloc);
      SuiteSparse_config_calloc_func_set(std::calloc);
      SuiteSparse_config_realloc_func_set(std::realloc);
    }

    MemoryLimit(const MemoryLimit &) = delete;
    MemoryLimit &
    operator=(const MemoryLimit &) = delete;

  private:
    static bool
    is_there()
    {
      --left;
      return left >= 0 || (lacks_once && left < -1);
    }

    inline static long left       = 0;
    inline static bool lacks_once = false;
  };
} // namespace

// The condition number of these boxes is below 1e4. Single precision of the
// right hand side and of the solution adds an error of 6e-8 of each. The second
// box has too many nodes to be ordered by minimum degree.
TEST(SparseCholesky, InvertsMatrix)
{
  for (const auto &cells : {Cells{{8, 2, 2}}, Cells{{20, 16, 15}}})
    {
      const SpringBox box(cells, true);
      SparseCholesky  inverse;
      inverse.factorize(*box.matrix);
      EXPECT_EQ(inverse.precision(), Precision::double_precision);
      EXPECT_LT(error<double>(box, inverse), 1e-11);
      EXPECT_LT(error<float>(box, inverse), 2e-3);
      EXPECT_GT(inverse.n_entries(),
                static_cast<std::size_t>(3 * box.pattern->nodes().n_global()));
    }
}

// The counts from the analysis are those of the factorisation.
TEST(SparseCholesky, AnalyzeCounts)
{
  const SpringBox box({{8, 2, 2}}, true);
  SparseCholesky  counted, inverse;
  counted.analyze(*box.matrix);
  inverse.factorize(*box.matrix);
  EXPECT_EQ(counted.n_entries(), inverse.n_entries());
  EXPECT_EQ(counted.n_operations(), inverse.n_operations());
  // A column of k entries takes about k^2 operations: the number is at least
  // that of a block diagonal matrix.
  EXPECT_GT(counted.n_operations(), 9. * 3 * box.pattern->nodes().n_global());
  counted.factorize(*box.matrix);
  EXPECT_LT(error<double>(box, counted), 1e-11);
}

TEST(SparseCholesky, InvertsMatrixInSinglePrecision)
{
  const SpringBox box({{8, 2, 2}}, true);
  SparseCholesky  inverse(Precision::single_precision);
  inverse.factorize(*box.matrix);
  EXPECT_EQ(inverse.precision(), Precision::single_precision);
  EXPECT_LT(error<float>(box, inverse), 2e-3);
  const double error_of_double = error<double>(box, inverse);
  EXPECT_LT(error_of_double, 2e-3);
  // The error shows that single precision was used.
  EXPECT_GT(error_of_double, 1e-9);
}

// A run that goes on after single precision has failed begins in double
// precision, for the first pattern only.
TEST(SparseCholesky, BeginsInDouble)
{
  const SpringBox box({{8, 2, 2}}, true), other({{3, 4, 3}}, true);
  SparseCholesky  inverse(Precision::single_precision);
  inverse.begin_in_double();
  inverse.factorize(*box.matrix);
  EXPECT_EQ(inverse.precision(), Precision::double_precision);
  EXPECT_LT(error<double>(box, inverse), 1e-11);
  inverse.factorize(*other.matrix);
  EXPECT_EQ(inverse.precision(), Precision::single_precision);
}

// Factors that are powers of two change exponents only: solutions are the same
// to the last bit for matrices and right hand sides far beyond the range of
// single precision.
TEST(SparseCholesky, AnySize)
{
  const SpringBox     unscaled({{8, 2, 2}}, true);
  const int           n = 3 * unscaled.pattern->n_owned();
  std::vector<double> b(n), reference(n), x(n);
  for (int i = 0; i < n; ++i)
    b[i] = std::cos(0.1 * unscaled.owned.nth_index_in_set(i));
  for (const Precision precision :
       {Precision::single_precision, Precision::double_precision})
    {
      SparseCholesky inverse(precision);
      inverse.factorize(*unscaled.matrix);
      inverse.vmult(reference.data(), b.data());
      for (const int of_matrix : {-300, 300})
        for (const int of_rhs : {-400, 400})
          {
            SpringBox box({{8, 2, 2}}, true);
            box.matrix->scale(std::ldexp(1., of_matrix));
            inverse.factorize(*box.matrix);
            EXPECT_EQ(inverse.precision(), precision);
            for (int i = 0; i < n; ++i)
              x[i] = std::ldexp(b[i], of_rhs);
            inverse.vmult(x.data(), x.data());
            for (int i = 0; i < n; ++i)
              EXPECT_EQ(std::ldexp(x[i], of_matrix - of_rhs), reference[i]);
          }
    }
}

// The factorisation is repeated with other values in the same pattern, with
// another pattern, and from the start.
TEST(SparseCholesky, FollowsMatrix)
{
  SpringBox      box({{4, 2, 2}}, true);
  SparseCholesky inverse;
  inverse.factorize(*box.matrix);
  box.add_mass(3.);
  EXPECT_GT(error<double>(box, inverse), 0.1);
  inverse.factorize(*box.matrix);
  EXPECT_LT(error<double>(box, inverse), 1e-12);

  const SpringBox other({{3, 4, 3}}, true);
  inverse.factorize(*other.matrix);
  EXPECT_LT(error<double>(other, inverse), 1e-11);
  SparseCholesky afresh;
  EXPECT_EQ(afresh.n_entries(), 0u);
  afresh.factorize(*box.matrix);
  EXPECT_LT(error<double>(box, afresh), 1e-12);
}

// In exact arithmetic six pivots of a free body are zero; round-off makes them
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
        catch (const ComputationError &failure)
          {
            message = failure.what();
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
        EXPECT_LT(error<double>(box, inverse),
                  precision == Precision::double_precision ? 1e-10 : 0.1);
      }
}

// The pivots of the free end are as small as the third power of the
// slenderness, below the resolution of single precision: double precision
// replaces it. The condition number is below 1e11.
TEST(SparseCholesky, SlenderBodyNeedsDoublePrecision)
{
  const SpringBox box({{400, 1, 1}}, true);
  SparseCholesky  inverse(Precision::single_precision);
  inverse.factorize(*box.matrix);
  EXPECT_EQ(inverse.precision(), Precision::double_precision);
  EXPECT_LT(error<double>(box, inverse), 1e-4);
}

// The matrix is factorised on rank 0. Whichever block of memory is refused
// there, and whether later ones are or not, all ranks get the error, in both
// precisions and where double replaces single. If no block is missing, the
// inverse is right.
TEST(SparseCholesky, MemoryMayBeTooShortAnywhere)
{
  const struct
  {
    Cells     cells;
    Precision precision;
  } cases[] = {{Cells{{3, 2, 2}}, Precision::double_precision},
               {Cells{{3, 2, 2}}, Precision::single_precision},
               {Cells{{400, 1, 1}}, Precision::single_precision}};
  for (const auto &[cells, precision] : cases)
    {
      const SpringBox   box(cells, true);
      const std::string expected =
        "memory is too short to factorise a matrix with " +
        std::to_string(3 * box.pattern->nodes().n_global()) + " unknowns";
      const auto factorizes = [&](const long n_blocks, const bool once) {
        SparseCholesky inverse(precision);
        std::string    message = "none";
        {
          const MemoryLimit limit(n_blocks, once);
          try
            {
              inverse.factorize(*box.matrix);
            }
          catch (const MachineError &error)
            {
              message = error.what();
            }
        }
        if (message == "none")
          {
            EXPECT_LT(error<double>(box, inverse), 1e-2) << n_blocks;
          }
        else
          {
            EXPECT_EQ(message, expected) << n_blocks;
          }
        return message == "none";
      };
      long n_needed = 0;
      while (n_needed < 1000 && !factorizes(n_needed, false))
        ++n_needed;
      // There are blocks for the matrix, its order, the factor and the vectors.
      EXPECT_GT(n_needed, 20);
      EXPECT_LT(n_needed, 1000);
      for (long n_blocks = 0; n_blocks < n_needed; ++n_blocks)
        factorizes(n_blocks, true);
    }
}
