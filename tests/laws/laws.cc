// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Properties that every registered law must have at a point.

#include <corotet/laws/neo_hookean.h>
#include <corotet/material/polar_decomposition.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "../all_laws.h"
#include "../body.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
  const IsotropicMaterial soft = isotropic_material(10., 0.3, 1.);
  const Tensor<2, 3>      unit(dealii::unit_symmetric_tensor<3>());

  // A displacement gradient that rotates by some 100 degrees, stretches by 40
  // and -30 percent and shears.
  const Tensor<2, 3> large =
    rotation_about(Tensor<1, 3>({0.3, -1., 2.}), 1.8) *
      Tensor<2, 3>({{1.4, 0.2, -0.1}, {0.1, 0.7, 0.3}, {0., 0.2, 1.1}}) -
    unit;
  const std::vector<Tensor<2, 3>> gradients{
    Tensor<2, 3>(),
    large,
    Tensor<2, 3>({{0.1, 0.02, 0.}, {-0.05, 0., 0.1}, {0.02, -0.03, -0.2}})};

  // The step of differences of fourth order: their error is h^4 = 1e-12 times
  // derivatives of size 10.
  constexpr double h = 1e-3;

  template <typename Value>
  Value
  difference(const std::function<Value(double)> &f)
  {
    return (8. * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
  }

  Tensor<2, 3>
  direction(const unsigned int a, const unsigned int b)
  {
    Tensor<2, 3> result;
    result[a][b] = 1;
    return result;
  }

  class Laws : public testing::TestWithParam<unsigned int>
  {
  protected:
    const NamedLaw    &named = all_laws()[GetParam()];
    const MaterialLaw &law   = *named.law;
  };
} // namespace

TEST_P(Laws, StressIsTheDerivativeOfTheEnergy)
{
  for (const Tensor<2, 3> &H : gradients)
    {
      const Tensor<2, 3> P = law.stress(soft, H);
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          EXPECT_NEAR(P[a][b],
                      difference<double>([&](const double s) {
                        return law.energy_density(soft,
                                                  H + s * direction(a, b));
                      }),
                      1e-9)
            << named.name;
    }
}

TEST_P(Laws, StressDerivative)
{
  for (const Tensor<2, 3> &H : gradients)
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        {
          const Tensor<2, 3> dF = direction(a, b);
          EXPECT_LE((law.stress_derivative(soft, H, dF) -
                     difference<Tensor<2, 3>>([&](const double s) {
                       return law.stress(soft, H + s * dF);
                     }))
                      .norm(),
                    1e-8)
            << named.name;
        }
}

// Runs check laws by central differences of second order with a step of 1e-5;
// the tolerance is its square plus the round-off over the step.
TEST_P(Laws, HaveNoErrors)
{
  for (const Tensor<2, 3> &H : {gradients[1], gradients[2]})
    {
      const LawErrors errors = law_errors(law, soft, H);
      EXPECT_LE(errors.stress, 1e-8) << named.name;
      EXPECT_LE(errors.stress_derivative, 1e-8) << named.name;
    }
}

// At rest all laws agree with linear elasticity.
TEST_P(Laws, AtRest)
{
  EXPECT_EQ(law.energy_density(soft, Tensor<2, 3>()), 0);
  EXPECT_EQ(law.stress(soft, Tensor<2, 3>()).norm(), 0);
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = 0; b < 3; ++b)
      {
        const Tensor<2, 3> dF = direction(a, b);
        EXPECT_LE((law.stress_derivative(soft, Tensor<2, 3>(), dF) -
                   Tensor<2, 3>(stress(soft, symmetrize(dF))))
                    .norm(),
                  4e-15)
          << named.name;
      }
}

// Small strains keep their digits: the stress differs from that of linear
// elasticity by second order only, 1e-9 of it. Laws with rotations know strains
// to the rounding of F only.
TEST_P(Laws, SmallStrain)
{
  const double       size = 1e-9;
  const Tensor<2, 3> H =
    size * Tensor<2, 3>({{1., 0.3, -0.2}, {-0.5, -0.4, 0.1}, {0.2, 0.6, 0.3}});
  const SymmetricTensor<2, 3> strain = symmetrize(H);
  const bool         rounds = named.text.find("Rotation") != std::string::npos;
  const double       tolerance = rounds ? 4e-16 / size : 5 * size;
  const Tensor<2, 3> sigma(stress(soft, strain));
  EXPECT_LE((law.stress(soft, H) - sigma).norm(), tolerance * sigma.norm());
  const double energy = energy_density(soft, strain);
  EXPECT_NEAR(law.energy_density(soft, H), energy, 2 * tolerance * energy);
}

// Rotating the body rotates its stress, and F P^T is symmetric, so there is no
// torque. The law is isotropic: a body cut in another direction behaves alike.
// Linear elasticity is an exception.
TEST_P(Laws, Objectivity)
{
  const Tensor<2, 3> Q       = rotation_about(Tensor<1, 3>({1., 2., 3.}), 2.1);
  double             largest = 0;
  for (const Tensor<2, 3> &H : gradients)
    {
      const Tensor<2, 3> F = unit + H, P = law.stress(soft, H);
      const Tensor<2, 3> turned = law.stress(soft, Q * F - unit),
                         cut    = law.stress(soft, F * Q - unit),
                         torque = F * transpose(P) - P * transpose(F);
      largest                   = std::max({largest,
                                            (turned - Q * P).norm(),
                                            (cut - P * Q).norm(),
                                            torque.norm()});
      if (!law.is_linear())
        {
          EXPECT_NEAR(law.energy_density(soft, Q * F - unit),
                      law.energy_density(soft, H),
                      1e-14 * 10);
          // The energy of a rotation is the square of the round-off of strains.
          EXPECT_LE(std::abs(law.energy_density(soft, Q - unit)), 1e-28);
        }
    }
  if (law.is_linear())
    EXPECT_GE(largest, 1.);
  else
    // The tolerance is that of some ten operations on numbers up to 20.
    EXPECT_LE(largest, 2e-14 * 10) << named.name;
}

// The stress in results is the Cauchy stress; for corotational elasticity up to
// terms of the order of the strain, here 1e-3.
TEST_P(Laws, SpatialStress)
{
  const Tensor<2, 3> R = rotation_about(Tensor<1, 3>({0.3, -1., 2.}), 1.8);
  const Tensor<2, 3> S =
    unit +
    1e-3 * Tensor<2, 3>({{1., 0.3, 0.}, {0.3, -0.4, 0.1}, {0., 0.1, 0.3}});
  const Tensor<2, 3> F = law.is_linear() ? S : R * S;
  // More gradients than there are lanes; one differs from the first.
  std::vector<Tensor<2, 3>>          H(11, F - unit);
  std::vector<SymmetricTensor<2, 3>> sigma(H.size());
  H[3] *= 0.5;
  law.spatial_stresses(soft, F - unit, H, sigma.data());
  const Tensor<2, 3> cauchy =
    law.stress(soft, F - unit) * transpose(F) / determinant(F);
  const bool approximate =
    law.is_linear() || named.text.find("Rotation") != std::string::npos;
  for (const unsigned int q : {0, 2, 7, 8, 10})
    EXPECT_LE((Tensor<2, 3>(sigma[q]) - cauchy).norm(),
              (approximate ? 4e-3 : 1e-14) * cauchy.norm())
      << named.name << ' ' << q;
  EXPECT_GT((sigma[3] - sigma[0]).norm(), 1e-3 * sigma[0].norm());
}

INSTANTIATE_TEST_SUITE_P(All,
                         Laws,
                         testing::Range<unsigned int>(0, all_laws().size()),
                         [](const auto &info) {
                           std::string name;
                           for (const char c : all_laws()[info.param].name)
                             if (std::isalnum(c))
                               name += c;
                           return name;
                         });

// Flat and inverted states have infinite energy.
TEST(NeoHookean, HasNoStateInsideOut)
{
  const auto law = neo_hookean_law();
  for (const double stretch : {0., -1e-9, -0.5, -1.})
    {
      Tensor<2, 3> H;
      H[2][2] = stretch - 1;
      EXPECT_EQ(law->energy_density(soft, H),
                std::numeric_limits<double>::infinity());
      EXPECT_FALSE(std::isfinite(law->stress(soft, H)[2][2]));
    }
  // A nearly flat state has the energy of the formula for uniaxial strain, mu /
  // 2 (s^2 - 1) - mu ln s + lambda / 2 (ln s)^2.
  Tensor<2, 3> H;
  const double s = 1e-6, ln = std::log(s);
  H[0][0] = s - 1;
  EXPECT_NEAR(law->energy_density(soft, H),
              soft.mu / 2 * (s * s - 1) - soft.mu * ln +
                soft.lambda / 2 * ln * ln,
              // The round-off of s is 1e-16 / 1e-6 of it.
              1e-9 * soft.lambda * 100);
}

// ln J is computed in two ways, and the energy has no jump between them.
TEST(NeoHookean, EnergyIsAsAccurateAsTheStrain)
{
  const auto law = neo_hookean_law();
  for (const double size : {1e-12, 1e-7, 1e-3, 0.0999, 0.1001, 0.3, 2.})
    for (const double sign : {-1., 1.})
      {
        const double e = sign * std::min(size, sign > 0 ? 2. : 0.9);
        Tensor<2, 3> H;
        H[1][1] = e;
        // The reference is in long double, whose 19 digits leave enough after
        // cancellation.
        const long double x = e, ln = std::log1p(x);
        const long double energy =
          soft.mu * (0.5L * x * x + (x - ln)) + 0.5L * soft.lambda * ln * ln;
        // Cancellation in x - ln(1 + x): 1e-19 / x in long double; in double it
        // costs a factor of 20 where no series is used.
        EXPECT_NEAR(law->energy_density(soft, H),
                    double(energy),
                    (1e-14 + 2e-19 / size) * double(energy))
          << e;
      }
}

// Far stretched, also without a change of volume: mu / 2 (tr C - 3) - mu ln J +
// lambda / 2 (ln J)^2 as it stands has no cancellation.
TEST(NeoHookean, EnergyOfLargeStretches)
{
  const auto law = neo_hookean_law();
  for (const double s : {3., 100., 1000.})
    for (const bool is_isochoric : {false, true})
      {
        const double t = is_isochoric ? 1 / std::sqrt(s) : s;
        Tensor<2, 3> H;
        H[0][0] = s - 1;
        H[1][1] = H[2][2] = t - 1;
        const double ln   = std::log(s * t * t);
        EXPECT_NEAR(law->energy_density(soft, H) /
                      (soft.mu * (0.5 * (s * s + 2 * t * t - 3) - ln) +
                       0.5 * soft.lambda * ln * ln),
                    1,
                    1e-13)
          << s;
      }
}
