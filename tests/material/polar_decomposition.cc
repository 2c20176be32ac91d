// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The rotation of the polar decomposition must be a rotation for every matrix,
// and that of the singular value decomposition where it is unique. The
// reference is Eigen's Jacobi SVD in extended precision: another algorithm than
// the fast path, and more digits than the robust one.

#include <corotet/material/polar_decomposition.h>

#include <deal.II/base/tensor.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "deviation_from_rotation.h"
#include <Eigen/Dense>

namespace
{
  using namespace corotet;
  using corotet::tests::deviation_from_rotation;
  using dealii::Tensor;
  using Extended = Eigen::Matrix<long double, 3, 3>;

  struct Reference
  {
    Tensor<2, 3> rotation;
    // This is (sigma_2 + sign(det F) sigma_3) / sigma_1: zero where R is not
    // unique.
    double uniqueness;
  };

  Reference
  reference_rotation(const Tensor<2, 3> &F)
  {
    Extended A;
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        A(a, b) = F[a][b];
    const Eigen::JacobiSVD<Extended> svd(A,
                                         Eigen::ComputeFullU |
                                           Eigen::ComputeFullV);
    Extended                         U = svd.matrixU();
    const long double                sign =
      U.determinant() * svd.matrixV().determinant() < 0 ? -1 : 1;
    U.col(2) *= sign;
    const Extended R     = U * svd.matrixV().transpose();
    const auto    &sigma = svd.singularValues();
    Reference      result;
    result.uniqueness = (sigma[1] + sign * sigma[2]) / sigma[0];
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        result.rotation[a][b] = R(a, b);
    return result;
  }

  Tensor<2, 3>
  random_matrix(std::mt19937_64 &generator)
  {
    std::normal_distribution<double> normal;
    Tensor<2, 3>                     F;
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        F[a][b] = normal(generator);
    return F;
  }

  // A matrix U diag(s) V^T with random rotations U and V.
  Tensor<2, 3>
  with_singular_values(const dealii::Tensor<1, 3> &s,
                       std::mt19937_64            &generator)
  {
    const Tensor<2, 3> U =
      polar_decomposition(random_matrix(generator)).rotation;
    Tensor<2, 3> V = polar_decomposition(random_matrix(generator)).rotation;
    for (unsigned int a = 0; a < 3; ++a)
      V[a] *= s[a];
    return U * V;
  }

  // The round-off of R is the machine precision over the uniqueness.
  void
  expect_reference(const Tensor<2, 3> &F, const double uniqueness_required)
  {
    const Tensor<2, 3> R = polar_decomposition(F).rotation;
    ASSERT_LE(deviation_from_rotation(R), 1e-14) << F;
    const Reference reference = reference_rotation(F);
    if (reference.uniqueness > uniqueness_required)
      {
        ASSERT_LE((R - reference.rotation).norm(), 1e-12) << F;
      }
  }
} // namespace

// Entries are normally distributed: about half of the matrices are inverted. In
// debug mode, which is slow, a tenth of them is checked.
TEST(PolarDecomposition, MillionRandomMatrices)
{
#ifdef DEBUG
  const unsigned int n = 100000;
#else
  const unsigned int n = 1000000;
#endif
  std::mt19937_64 generator(1);
  for (unsigned int i = 0; i < n; ++i)
    ASSERT_NO_FATAL_FAILURE(expect_reference(random_matrix(generator), 1e-3));
}

TEST(PolarDecomposition, NearlySingularAndInverted)
{
  std::mt19937_64 generator(2);
  for (const double small : {0.3, 1e-3, 1e-8, 1e-12, 1e-16, 1e-17, 1e-100, 0.})
    for (const double sign : {1., -1.})
      for (unsigned int i = 0; i < 1000; ++i)
        {
          expect_reference(with_singular_values(
                             Tensor<1, 3>({1.5, 0.7, sign * small}), generator),
                           1e-3);
          // Matrices of rank 1, exactly or nearly: R is not unique, but must be
          // a rotation.
          expect_reference(with_singular_values(Tensor<1, 3>(
                                                  {1., small, sign * small}),
                                                generator),
                           1e-3);
        }
}

// Singular values that differ by 1e-17; for inverted matrices the direction of
// the reflection is then arbitrary.
TEST(PolarDecomposition, NearlyEqualSingularValues)
{
  std::mt19937_64 generator(3);
  for (unsigned int i = 0; i < 1000; ++i)
    {
      expect_reference(with_singular_values(
                         Tensor<1, 3>({1., 1. - 1e-17, 1. - 2e-17}), generator),
                       1e-3);
      expect_reference(with_singular_values(Tensor<1, 3>({2., 1., -1. + 1e-17}),
                                            generator),
                       1e-3);
      expect_reference(with_singular_values(Tensor<1, 3>({1., 1., -1.}),
                                            generator),
                       1e-3);
    }
}

TEST(PolarDecomposition, CollapsedToPlaneLineAndPoint)
{
  std::mt19937_64 generator(4);
  for (unsigned int i = 0; i < 1000; ++i)
    {
      // A matrix of rank 2, exactly: the third row is zero. Its R is unique.
      Tensor<2, 3> plane = random_matrix(generator);
      plane[2]           = 0;
      expect_reference(plane, 1e-2);
      EXPECT_EQ(polar_decomposition(plane).state, PolarState::degenerate);
      Tensor<2, 3> line = plane;
      line[1]           = 0;
      expect_reference(line, 1e-2);
      EXPECT_EQ(polar_decomposition(line).state, PolarState::degenerate);
    }
  const PolarDecomposition point = polar_decomposition(Tensor<2, 3>());
  EXPECT_EQ(point.state, PolarState::degenerate);
  EXPECT_EQ(deviation_from_rotation(point.rotation), 0.);
}

// F and s F have the same rotation: exactly, if s is a power of two.
TEST(PolarDecomposition, AnyScale)
{
  std::mt19937_64 generator(5);
  for (unsigned int i = 0; i < 1000; ++i)
    {
      const Tensor<2, 3> F = random_matrix(generator);
      for (const int exponent : {-990, -500, 500, 990})
        EXPECT_EQ(polar_decomposition(F * std::ldexp(1., exponent)).rotation,
                  polar_decomposition(F).rotation);
      for (const double scale : {1e-300, 1e300})
        expect_reference(F * scale, 1e-3);
      // Denormal numbers have fewer digits, but the result is a rotation.
      expect_reference(F * 1e-310, 2.);
    }
}

TEST(PolarDecomposition, KnowsTheState)
{
  Tensor<2, 3> F = 2. * Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
  EXPECT_EQ(polar_decomposition(F).state, PolarState::regular);
  F[2][2] = -0.5;
  EXPECT_EQ(polar_decomposition(F).state, PolarState::inverted);
  // The direction of the smallest singular value is reflected back.
  EXPECT_LE((polar_decomposition(F).rotation -
             Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()))
              .norm(),
            1e-15);
}

TEST(PolarDecomposition, NotFinite)
{
  Tensor<2, 3> F;
  F[0][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(deviation_from_rotation(polar_decomposition(F).rotation), 0.);
  F[0][0] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(deviation_from_rotation(polar_decomposition(F).rotation), 0.);
}
