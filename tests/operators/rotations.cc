// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The placement of rotations: forces, energies and exact tangents for the three
// placements, checked with differences, symmetry and the balance of each cell.

#include <corotet/material/rotation_derivative.h>

#include <gtest/gtest.h>

#include "random_states.h"

using namespace corotet;
using namespace corotet::tests;

class NonlinearLaws
  : public testing::TestWithParam<std::tuple<unsigned int, unsigned int>>
{
protected:
  unsigned int degree = std::get<0>(GetParam());
  NamedLaw     law    = nonlinear_laws()[std::get<1>(GetParam())];
};

// Central differences of fourth order with steps of 2e-4 have an error of some
// 1e-16 (h^4 / 30) of the fifth derivative, and round-off of 1e-13 / 2e-4.
TEST_P(NonlinearLaws, ConsistentTangentIsTheDerivative)
{
  MovingBody   body(box("1, 2, 1", "2, 2, 2", 0.2), case_text(degree, law));
  Elasticity   elasticity = elasticity_of(body, law.law);
  const Vector v          = random_direction(body);
  double       largest    = 0;
  for (const RandomState &state : states)
    for (const double angle : {0.3, 1.5, 3., dealii::numbers::PI})
      {
        Vector       u = displacement(body, state, angle, 7);
        const Vector x = moved(u, 0., v);
        if (!has_state(elasticity, x))
          continue;
        const double h = 2e-4;
        Vector       difference(u);
        difference.zero_out_ghost_values();
        difference = 0;
        for (const auto &[step, weight] :
             {std::pair<double, double>{-2, 1. / 12},
              {-1, -2. / 3},
              {1, 2. / 3},
              {2, -1. / 12}})
          {
            u = moved(x, step * h, v);
            difference.add(weight / h, force(elasticity, u));
          }
        force(elasticity, x);
        EXPECT_EQ(elasticity.linearize(x, Tangent::consistent), 0u);
        Vector product(difference);
        elasticity.apply_linearization(product, v, 1., 0., nullptr, nullptr);
        const double error =
          largest_difference(product, difference) / difference.linfty_norm();
        largest = std::max(largest, error);
        EXPECT_LE(error, 1e-6) << state.name << ", angle " << angle;
      }
  report("largest relative difference", largest);
  EXPECT_GT(largest, 0) << "no state was looked at";
}

// The force is the gradient of the energy, except with one rotation per cell
// above degree 1.
TEST_P(NonlinearLaws, ForceIsTheGradientOfTheEnergy)
{
  MovingBody   body(box("1, 2, 1", "2, 2, 2", 0.2), case_text(degree, law));
  Elasticity   elasticity = elasticity_of(body, law.law);
  const Vector v          = random_direction(body);
  double       largest    = 0;
  for (const RandomState &state : states)
    {
      Vector       u = displacement(body, state, 2., 3);
      const Vector x = moved(u, 0., v);
      const double h = 2e-4;
      if (!has_state(elasticity, x))
        continue;
      double slope = 0;
      for (const auto &[step, weight] : {std::pair<double, double>{-2, 1. / 12},
                                         {-1, -2. / 3},
                                         {1, 2. / 3},
                                         {2, -1. / 12}})
        {
          u = moved(x, step * h, v);
          force(elasticity, u);
          slope += weight / h * elasticity.state(u).energy;
        }
      const Vector f     = force(elasticity, x);
      const double power = f * v;
      largest = std::max(largest, std::abs(power - slope) / std::abs(slope));
    }
  report("largest relative difference", largest);
  EXPECT_GT(largest, 0) << "no state was looked at";
  if (law.law->has_energy(degree))
    EXPECT_LE(largest, 1e-8);
  else
    EXPECT_GE(largest, 1e-4) << "a law without an energy is expected here";
}

// Ghost cells of the assembled matrix must have the rotations of their owners,
// also where these are not unique.
TEST_P(NonlinearLaws, AssembledMatrixOfACrushedBody)
{
  for (const auto &s : {dealii::Tensor<1, 3>({1., 1., -1.}),
                        dealii::Tensor<1, 3>({1., 0., 0.}),
                        dealii::Tensor<1, 3>({0., 0., 0.})})
    {
      MovingBody   body(box("1, 1, 1", "3, 3, 3"), case_text(degree, law));
      Elasticity   elasticity = elasticity_of(body, law.law);
      const Vector u = body.interpolate([&](const dealii::Point<3> &x) {
        dealii::Tensor<1, 3> value;
        for (unsigned int a = 0; a < 3; ++a)
          value[a] = (s[a] - 1) * (x[a] - 0.5);
        return value;
      });
      force(elasticity, u);
      EffectiveOperator A(body.discretization,
                          elasticity,
                          body.mass,
                          body.motion.is_prescribed());
      A.update(1., 0.);
      Vector v = random_direction(body);
      v.zero_out_ghost_values();
      Vector product(v), assembled(v);
      A.vmult(product, v);
      A.matrix().vmult(assembled, v);
      EXPECT_LE(largest_difference(product, assembled),
                1e-13 * product.linfty_norm());
    }
}

// Two stretches of an inverted cell may sum to zero, where the derivative of
// its rotation is infinite: below a smallest sum it is bounded, and the cell is
// counted once. All cells have the same gradient here, and there are five.
TEST_P(NonlinearLaws, BoundedDerivativesAreCounted)
{
  if (!law.name.starts_with("corotational"))
    GTEST_SKIP() << "a law without rotations";
  for (const double sum : {0.5 * smallest_sum_of_stretches, 0.3})
    {
      MovingBody   body(box("1, 1, 1", "1, 1, 1"), case_text(degree, law));
      Elasticity   elasticity = elasticity_of(body, law.law);
      const Vector u = body.interpolate([&](const dealii::Point<3> &x) {
        return dealii::Tensor<1, 3>(
          {0.5 * x[0], -0.2 * x[1], (sum - 1.8) * x[2]});
      });
      force(elasticity, u);
      EXPECT_EQ(elasticity.linearize(u, Tangent::consistent),
                sum < smallest_sum_of_stretches ? 5u : 0u)
        << law.name << ", sum " << sum;
    }
}

INSTANTIATE_TEST_SUITE_P(
  All,
  NonlinearLaws,
  testing::Combine(testing::Values(1u, 2u, 3u),
                   testing::Range<unsigned int>(0, nonlinear_laws().size())));
