// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A rotation that is stored as a quaternion is restored to round-off, whichever
// of the four components is the largest.

#include <corotet/material/quaternion_simd.h>

#include <deal.II/base/tensor.h>
#include <deal.II/physics/transformations.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "deviation_from_rotation.h"

namespace
{
  using namespace corotet;
  using dealii::Tensor;

  constexpr int n_rotations = n_lanes<double>;

  // The rotations after a conversion to quaternions and back.
  std::vector<Tensor<2, 3>>
  there_and_back(const std::vector<Tensor<2, 3>> &rotations)
  {
    Simd<double> R[3][3], result[3][3], q[4];
    for (int lane = 0; lane < n_rotations; ++lane)
      for (unsigned int i = 0; i < 9; ++i)
        R[i / 3][i % 3][lane] = rotations[lane][i / 3][i % 3];
    to_quaternion(R, q);
    to_rotation(q, result);
    std::vector<Tensor<2, 3>> matrices(n_rotations);
    for (int lane = 0; lane < n_rotations; ++lane)
      for (unsigned int i = 0; i < 9; ++i)
        matrices[lane][i / 3][i % 3] = result[i / 3][i % 3][lane];
    return matrices;
  }

  void
  expect_same(const std::vector<Tensor<2, 3>> &rotations)
  {
    const auto found = there_and_back(rotations);
    for (int lane = 0; lane < n_rotations; ++lane)
      {
        // Entries are products of two components, each with an error of some
        // four roundings of 2.2e-16; the determinant has three times that
        // error.
        EXPECT_LE((found[lane] - rotations[lane]).norm(), 3e-15)
          << rotations[lane];
        EXPECT_LE(tests::deviation_from_rotation(found[lane]), 3e-15)
          << rotations[lane];
      }
  }
} // namespace

TEST(QuaternionSimd, EveryAxisAndAngle)
{
  std::mt19937_64                        generator(1);
  std::normal_distribution<double>       normal;
  std::uniform_real_distribution<double> uniform(-std::numbers::pi,
                                                 std::numbers::pi);
  for (unsigned int k = 0; k < 20000 && !HasFailure(); ++k)
    {
      std::vector<Tensor<2, 3>> rotations;
      for (int lane = 0; lane < n_rotations; ++lane)
        {
          Tensor<1, 3> axis{
            {normal(generator), normal(generator), normal(generator)}};
          // Some rotations are about coordinate axes, where components are
          // zero.
          if (generator() % 4 == 0)
            axis[generator() % 3] = 0;
          if (generator() % 4 == 0)
            axis[generator() % 3] = 0;
          if (axis.norm() == 0)
            axis[generator() % 3] = 1;
          // Angles include tiny ones and half turns, exact and nearly.
          const unsigned int sort  = generator() % 8;
          double             angle = uniform(generator);
          if (sort < 2)
            angle *= std::pow(10., -2. * (generator() % 9));
          if (sort == 1 || sort == 2)
            angle = std::numbers::pi - (sort == 1 ? angle : 0.);
          rotations.push_back(
            dealii::Physics::Transformations::Rotations::rotation_matrix_3d(
              axis / axis.norm(), angle));
        }
      expect_same(rotations);
    }
}
