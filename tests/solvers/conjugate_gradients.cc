// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Conjugate gradients with two global sums per iteration, compared with
// deal.II's, and where the norm computed in advance would be only round-off.

#include <corotet/solvers/conjugate_gradients.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace corotet;

namespace
{
  /// A vector with 50 entries on each rank.
  Vector
  some_vector()
  {
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const unsigned int rank =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    dealii::IndexSet owned(50 * n_ranks);
    owned.add_range(50 * rank, 50 * (rank + 1));
    Vector result(owned, MPI_COMM_WORLD);
    for (unsigned int i = 0; i < 50; ++i)
      result.local_element(i) = std::sin(1. + 50 * rank + i);
    return result;
  }

  /// A diagonal matrix with the entries offset + i^2.
  struct Matrix
  {
    double offset;

    void
    vmult(Vector &dst, const Vector &src) const
    {
      const auto owned = src.locally_owned_elements();
      for (unsigned int i = 0; i < src.locally_owned_size(); ++i)
        {
          const double row     = owned.nth_index_in_set(i);
          dst.local_element(i) = (offset + row * row) * src.local_element(i);
        }
    }
  };

  struct Scaling
  {
    void
    vmult(Vector &dst, const Vector &src) const
    {
      const auto owned = src.locally_owned_elements();
      for (unsigned int i = 0; i < src.locally_owned_size(); ++i)
        dst.local_element(i) =
          src.local_element(i) / (1. + owned.nth_index_in_set(i));
    }

    void
    vmult_with_norm(Vector &dst, const Vector &src, const double norm) const
    {
      // The norm given in advance is that of the source, up to a few digits.
      EXPECT_NEAR(norm, corotet::norm(src), 1e-9 * norm);
      vmult(dst, src);
    }
  };
  const StopQuestion nobody;
} // namespace

TEST(ConjugateGradients, AreThoseOfDealii)
{
  const Vector b = some_vector();
  for (const bool from_zero : {true, false})
    {
      Vector x(b), expected(b);
      if (from_zero)
        x = expected = 0.;
      dealii::SolverControl    control(300, 1e-10), reference(300, 1e-10);
      dealii::SolverCG<Vector> cg(reference);
      cg.solve(Matrix{1}, expected, b, Scaling());
      EXPECT_TRUE(ConjugateGradients(control, nobody, true)
                    .solve(Matrix{1}, x, b, Scaling()));
      // Round-off may change the number of iterations by one.
      EXPECT_NEAR(control.last_step(), reference.last_step(), 1);
      EXPECT_GT(control.last_step(), 20u);
      x -= expected;
      // Both residuals are below 1e-10, and no eigenvalue is below 1.
      EXPECT_LT(x.l2_norm(), 2e-10);
    }
}

TEST(ConjugateGradients, StopAtNegativeCurvatureIfAsked)
{
  const Vector          b = some_vector();
  Vector                x(b);
  dealii::SolverControl control(300, 1e-10);
  x = 0;
  EXPECT_FALSE(ConjugateGradients(control, nobody, true)
                 .solve(Matrix{-1e5}, x, b, Scaling()));
  for (const double entry : x)
    EXPECT_TRUE(std::isfinite(entry));
}

TEST(ConjugateGradients, FailureIsThrown)
{
  const Vector          b = some_vector();
  Vector                x(b);
  dealii::SolverControl control(3, 1e-10);
  x = 0;
  EXPECT_THROW(
    ConjugateGradients(control, nobody, true).solve(Matrix{1}, x, b, Scaling()),
    dealii::SolverControl::NoConvergence);
}

// A single rank that asks to stop is enough to stop all.
TEST(ConjugateGradients, StopWhenAskedTo)
{
  const Vector          b = some_vector();
  Vector                x(b);
  dealii::SolverControl control(300, 1e-10);
  unsigned int          n = 0;
  const unsigned int    last =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) - 1;
  const StopQuestion question([&] {
    return ++n > 5 &&
           dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == last;
  });
  x = 0;
  EXPECT_THROW(ConjugateGradients(control, question, true)
                 .solve(Matrix{1}, x, b, Scaling()),
               StepInterrupted);
  EXPECT_EQ(n, 6u);
}

// The step leaves a small part of the residual, a millionth and less: then the
// norm computed from sums of squares would have no correct digit.
TEST(ConjugateGradients, NormAfterAStepThatLeavesLittle)
{
  const Vector r = some_vector();
  for (const double left : {0.5, 1e-2, 1e-5, 1e-9, 1e-13, 0.})
    {
      Vector q(r), next(r);
      for (unsigned int i = 0; i < q.locally_owned_size(); ++i)
        q.local_element(i) *= i % 2 == 0 ? 1 + left : 1 - left;
      next.add(-1., q);
      const auto products = inner_products<3>({{{&r, &r}, {&r, &q}, {&q, &q}}});
      const double found =
        norm_after_step(1., products[0], products[1], products[2], next);
      EXPECT_NEAR(found, norm(next), 1e-9 * norm(next));
    }
}
