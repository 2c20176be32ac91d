// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Rotations of several F at once must be those of the scalar function, to
// round-off where the fast path computes them and exactly elsewhere, whatever
// mix of regular and irregular F the lanes hold. Another test compares the
// scalar function with extended precision.

#include <corotet/base/simd.h>
#include <corotet/material/polar_decomposition.h>
#include <corotet/material/polar_decomposition_simd.h>

#include <deal.II/base/tensor.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "deviation_from_rotation.h"

namespace
{
  using namespace corotet;
  using corotet::tests::deviation_from_rotation;
  using dealii::Tensor;

  constexpr int n_matrices = n_lanes<double>;

  // One F per lane, and its decomposition.
  struct Batch
  {
    Simd<double> F[3][3], R[3][3];
    PolarLanes   found;

    void
    set(const int lane, const Tensor<2, 3> &matrix)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          F[i][j][lane] = matrix[i][j];
    }

    Tensor<2, 3>
    rotation(const int lane) const
    {
      Tensor<2, 3> matrix;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          matrix[i][j] = R[i][j][lane];
      return matrix;
    }

    bool
    is_irregular(const int lane) const
    {
      return (found.irregular >> lane & 1u) != 0;
    }

    PolarState
    state(const int lane) const
    {
      if ((found.degenerate >> lane & 1u) != 0)
        return PolarState::degenerate;
      return (found.inverted >> lane & 1u) != 0 ? PolarState::inverted :
                                                  PolarState::regular;
    }

    void
    decompose()
    {
      found = polar_decomposition(F, R);
    }
  };

  double
  largest_entry(const Tensor<2, 3> &A)
  {
    double largest = 0;
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        largest =
          std::isfinite(A[a][b]) ? std::max(largest, std::abs(A[a][b])) : 1e300;
    return largest;
  }

  class Matrices
  {
  public:
    explicit Matrices(const unsigned int seed)
      : generator(seed)
    {}

    double
    uniform(const double from, const double to)
    {
      return std::uniform_real_distribution<double>(from, to)(generator);
    }

    // The rotation of a random unit quaternion.
    Tensor<2, 3>
    rotation()
    {
      std::array<double, 4> q;
      double                norm = 0;
      for (double &component : q)
        {
          component = normal(generator);
          norm += component * component;
        }
      const double w = q[0], x = q[1], y = q[2], z = q[3], s = 2 / norm;
      Tensor<2, 3> R;
      R[0] = Tensor<1, 3>(
        {1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)});
      R[1] = Tensor<1, 3>(
        {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)});
      R[2] = Tensor<1, 3>(
        {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)});
      return R;
    }

    // A matrix U diag(s) V^T with random rotations U and V.
    Tensor<2, 3>
    with_singular_values(const double s0, const double s1, const double s2)
    {
      Tensor<2, 3> V = rotation();
      V[0] *= s0;
      V[1] *= s1;
      V[2] *= s2;
      return rotation() * V;
    }

    // A matrix with singular values between @p lowest and @p highest, evenly
    // distributed in their logarithm.
    Tensor<2, 3>
    stretched(const double lowest, const double highest)
    {
      const double a = std::log(lowest), b = std::log(highest);
      return with_singular_values(std::exp(uniform(a, b)),
                                  std::exp(uniform(a, b)),
                                  std::exp(uniform(a, b)));
    }

    // A matrix F of any sort; two thirds of them are ordinary.
    Tensor<2, 3>
    any()
    {
      const unsigned int sort = generator() % 30;
      Tensor<2, 3>       F    = stretched(0.1, 10);
      switch (sort)
        {
          case 0: // Inverted.
            return with_singular_values(uniform(1, 3),
                                        uniform(0.5, 1),
                                        uniform(-0.4, -0.01));
          case 1: // Flat, nearly or exactly.
            return with_singular_values(uniform(1, 3), uniform(0.5, 1), 1e-9);
          case 2:
            F[generator() % 3] = 0;
            return F;
          case 3: // A line.
            F[0] = 0;
            F[2] = 2. * F[1];
            return F;
          case 4: // A point.
            return Tensor<2, 3>();
          case 5:
            F[generator() % 3][generator() % 3] =
              std::numeric_limits<double>::quiet_NaN();
            return F;
          case 6:
            F[generator() % 3][generator() % 3] =
              std::numeric_limits<double>::infinity();
            return F;
          case 7:
            return F * std::pow(10., uniform(-300, 300));
          case 8:
            return F * 1e-310;
          case 9:
            return stretched(0.01, 1);
          default:
            return sort < 20 ? F : stretched(0.7, 1.3);
        }
    }

  private:
    std::mt19937_64                  generator;
    std::normal_distribution<double> normal;
  };

  // Compares all lanes, and returns for how many the fast path was taken.
  unsigned int
  expect_scalar_result(const Batch &batch)
  {
    unsigned int n_fast = 0;
    for (int lane = 0; lane < n_matrices; ++lane)
      {
        Tensor<2, 3> F;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            F[i][j] = batch.F[i][j][lane];
        const PolarDecomposition scalar = polar_decomposition(F);
        const Tensor<2, 3>       R      = batch.rotation(lane);
        EXPECT_EQ(batch.state(lane), scalar.state) << F;
        EXPECT_LE(deviation_from_rotation(R), 1e-14) << F;
        if (batch.is_irregular(lane))
          EXPECT_EQ(R, scalar.rotation) << F;
        else
          {
            EXPECT_LE(largest_entry(R - scalar.rotation), 1e-14) << F;
            ++n_fast;
          }
      }
    return n_fast;
  }

#ifdef DEBUG
  // Debug mode is slow, so it checks a tenth of them.
  constexpr unsigned int n_batches = 100000 / n_matrices;
#else
  constexpr unsigned int n_batches = 1000000 / n_matrices;
#endif
} // namespace

TEST(PolarDecompositionSimd, MillionMatricesOfAllSorts)
{
  Matrices     matrices(1);
  unsigned int n_fast = 0;
  for (unsigned int k = 0; k < n_batches && !HasFailure(); ++k)
    {
      Batch batch;
      for (int lane = 0; lane < n_matrices; ++lane)
        batch.set(lane, matrices.any());
      batch.decompose();
      n_fast += expect_scalar_result(batch);
    }
  // Most matrices do not need the scalar function.
  EXPECT_GT(n_fast, n_batches * n_matrices / 2);
}

// Condition numbers go up to 100: the fast path takes all but too flat
// matrices.
TEST(PolarDecompositionSimd, LargeStretches)
{
  Matrices matrices(2);
  for (unsigned int k = 0; k < n_batches / 10 && !HasFailure(); ++k)
    {
      Batch batch;
      for (int lane = 0; lane < n_matrices; ++lane)
        batch.set(lane, matrices.stretched(0.05, 5));
      batch.decompose();
      expect_scalar_result(batch);
    }
}

// Ordinary F of any ordinary scale always take the fast path.
TEST(PolarDecompositionSimd, OrdinaryStretchesTakeTheFastPath)
{
  Matrices matrices(3);
  for (const double scale : {1e-14, 1e-6, 0.1, 1., 1.001, 10., 1e6, 1e14})
    for (const double stretch : {1., 1.0001, 1.05, 1.3, 2., 5.})
      for (unsigned int k = 0; k < 100 && !HasFailure(); ++k)
        {
          Batch batch;
          for (int lane = 0; lane < n_matrices; ++lane)
            batch.set(lane, matrices.stretched(1 / stretch, stretch) * scale);
          batch.decompose();
          EXPECT_EQ(expect_scalar_result(batch), n_matrices);
        }
}

// The result of a lane is the same to the last bit whatever is in the other
// lanes: F of other sorts, which need more steps, no steps or the scalar
// function.
TEST(PolarDecompositionSimd, NeighboursDoNotMatter)
{
  Matrices matrices(4);
  for (unsigned int k = 0; k < n_batches / 10 && !HasFailure(); ++k)
    {
      const Tensor<2, 3> F = matrices.any();
      Batch              reference;
      for (int lane = 0; lane < n_matrices; ++lane)
        reference.set(lane, F);
      reference.decompose();
      const Tensor<2, 3> R = reference.rotation(0);
      for (int own = 0; own < n_matrices; ++own)
        {
          Batch batch;
          for (int lane = 0; lane < n_matrices; ++lane)
            batch.set(lane, lane == own ? F : matrices.any());
          batch.decompose();
          const Tensor<2, 3> R_mixed = batch.rotation(own);
          // Nine numbers without gaps, whose bits are what is compared.
          // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
          EXPECT_EQ(std::memcmp(&R, &R_mixed, sizeof(R)), 0) << F;
          EXPECT_EQ(batch.state(own), reference.state(0)) << F;
          EXPECT_EQ(batch.is_irregular(own), reference.is_irregular(0)) << F;
        }
    }
}

TEST(PolarDecompositionSimd, InPlace)
{
  Matrices matrices(5);
  for (unsigned int k = 0; k < 1000 && !HasFailure(); ++k)
    {
      Batch batch;
      for (int lane = 0; lane < n_matrices; ++lane)
        batch.set(lane, matrices.any());
      batch.decompose();
      polar_decomposition(batch.F, batch.F);
      // Registers without gaps, whose bits are what is compared.
      // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
      EXPECT_EQ(std::memcmp(&batch.F, &batch.R, sizeof(batch.R)), 0);
    }
}
