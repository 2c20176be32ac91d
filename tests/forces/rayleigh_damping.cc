// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Rayleigh damping given by ratios at two frequencies, and the stable step with
// it.

#include <corotet/forces/rayleigh_damping.h>
#include <corotet/time_integration/newmark.h>

#include <deal.II/base/numbers.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <complex>

#include "../body.h"
#include "../refusal.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;
using dealii::numbers::PI;

namespace
{
  DampingParameters
  damping(const std::string &frequencies, const std::string &ratios)
  {
    DampingParameters        result;
    dealii::ParameterHandler prm;
    result.declare_parameters(prm);
    prm.set("Frequencies", frequencies);
    prm.set("Ratios", ratios);
    return result;
  }

  std::string
  refusal_of(const std::string &frequencies,
             const std::string &ratios,
             const double       mass_coefficient = 0)
  {
    return refusal([&] {
      DampingParameters parameters = damping(frequencies, ratios);
      parameters.given.mass        = mass_coefficient;
      parameters.coefficients();
    });
  }
} // namespace

// The coefficients give the damping ratios, by the definition of these.
TEST(RayleighDamping, HasTheRatiosAsked)
{
  const DampingCoefficients c = damping("2, 5", "0.02, 0.03").coefficients();
  const auto                ratio = [&](const double f) {
    return c.mass / (4 * PI * f) + c.stiffness * PI * f;
  };
  EXPECT_DOUBLE_EQ(ratio(2), 0.02);
  EXPECT_DOUBLE_EQ(ratio(5), 0.03);
  EXPECT_LT(ratio(3), 0.03);
  EXPECT_GT(ratio(6), 0.03);
}

// At the limits of allowed ratios one coefficient is exactly zero, not a tiny
// negative number, although 0.1 and 0.3 have no exact binary representation.
TEST(RayleighDamping, LimitsAreAllowed)
{
  DampingCoefficients c = damping("0.1, 0.3", "0.01, 0.03").coefficients();
  EXPECT_EQ(c.mass, 0);
  EXPECT_DOUBLE_EQ(c.stiffness, 0.01 / (PI * 0.1));
  c = damping("0.1, 0.3", "0.03, 0.01").coefficients();
  EXPECT_DOUBLE_EQ(c.mass, 0.03 * 4 * PI * 0.1);
  EXPECT_EQ(c.stiffness, 0);
  c = damping("1, 2", "0, 0").coefficients();
  EXPECT_EQ(c.mass, 0);
  EXPECT_EQ(c.stiffness, 0);
  DampingParameters parameters = damping("", "");
  parameters.given             = {3, 4};
  EXPECT_EQ(parameters.coefficients().mass, 3);
  EXPECT_EQ(parameters.coefficients().stiffness, 4);
}

TEST(RayleighDamping, Refusals)
{
  EXPECT_EQ(refusal_of("1, 2", "0.01, 0.05"),
            "Damping/Ratios: a mass coefficient below zero would be needed: "
            "found the ratios 0.01 and 0.05 at 1 and 2 Hz; allowed with the "
            "first is a second from 0.005 to 0.02");
  EXPECT_EQ(refusal_of("1, 2", "0.03, 0.01"),
            "Damping/Ratios: a stiffness coefficient below zero would be "
            "needed: found the ratios 0.03 and 0.01 at 1 and 2 Hz; allowed "
            "with the first is a second from 0.015 to 0.06");
  EXPECT_EQ(refusal_of("1, 2", "0.01, 0.01", 0.5),
            "Damping/Frequencies: damping is given twice: found frequencies "
            "next to the coefficients 0.5 and 0; allowed are these or those");
  const std::string frequencies =
    "; allowed are two positive frequencies, the lower one first";
  EXPECT_EQ(refusal_of("", "0.01, 0.02"),
            "Damping/Frequencies: found '' with Damping/Ratios = '0.01, "
            "0.02'" +
              frequencies);
  EXPECT_EQ(refusal_of("2, 1", "0.01, 0.02"),
            "Damping/Frequencies: found '2, 1' with Damping/Ratios = '0.01, "
            "0.02'" +
              frequencies);
  EXPECT_EQ(refusal_of("0, 1", ""),
            "Damping/Frequencies: found '0, 1' with Damping/Ratios = ''" +
              frequencies);
  EXPECT_EQ(refusal_of("1", "0.1"),
            "Damping/Frequencies: found '1' with Damping/Ratios = '0.1'" +
              frequencies);
  EXPECT_EQ(refusal_of("1, 2", "0.02"),
            "Damping/Ratios: found '0.02' with Damping/Frequencies = '1, 2'; "
            "allowed are two ratios");
}

// Damping is proportional to the stiffness with frozen rotations, whose largest
// frequency does not change in a body that is stretched equally in all
// directions, while that of the exact tangent grows.
TEST(RayleighDamping, StableStepOfFrozenRotations)
{
  const auto frequencies = [](const double strain) {
    MovingBody body(box("2, 1, 1", "4, 2, 2", 0.2),
                    element_text(2, "diagonal scaling") +
                      rotation_at("quadrature points") +
                      section("Damping", {{"Stiffness coefficient", 1e-4}}));
    body.state.u = body.interpolate(
      [&](const Point<3> &x) { return strain * Tensor<1, 3>(x); });
    return body.system.acceleration_solver().largest_frequencies(body.state);
  };
  const auto at_rest = frequencies(0), stretched = frequencies(3);
  // Both estimates are too large by less than 1e-3.
  EXPECT_NEAR(stretched.damped / at_rest.damped, 1, 1e-3);
  EXPECT_NEAR(at_rest.all / at_rest.damped, 1, 1e-3);
  EXPECT_GT(stretched.all, 1.01 * stretched.damped);
}

// A bar clamped at x = 0 swings along its axis in its first or second mode, u_x
// = sin(k x), k = (2 m - 1) pi / 2; with nu = 0 nothing else moves. The
// amplitude |v - conj(lambda) u| of the mode, lambda = omega (-zeta + i sqrt(1
// - zeta^2)), decays at the rate zeta omega. The trapezoidal rule changes
// lambda by lambda^3 h^2 / 12, whose real part is (omega h)^2 / 4 of the rate,
// and terms of fourth order. Eight cubic elements know the mode to 1e-9.
TEST(RayleighDamping, ModesDecayAtTheirRatio)
{
  const std::vector<double> ratios = {0.02, 0.05};
  const double              c      = std::sqrt(1e6 / 1000);
  for (const unsigned int mode : {0, 1})
    {
      MovingBody body(
        box("1, 0.1, 0.1", "8, 1, 1"),
        element_text(3) + material_type("linear") + material_text(1e6, 0) +
          fixed("x-min") +
          section("Damping",
                  {{"Frequencies", fmt::format("{}, {}", c / 4, 3 * c / 4)},
                   {"Ratios", fmt::format("{}, {}", ratios[0], ratios[1])}}) +
          newton_tolerances(1e-12) + linear_solver("direct", 1e-12));

      const double       k     = (2 * mode + 1) * PI / 2;
      const double       omega = c * k;
      const double       zeta  = ratios[mode];
      const unsigned int n     = 200;
      const double       h     = 2 * PI / omega / 50;
      const Vector       shape = body.interpolate([&](const Point<3> &x) {
        return Tensor<1, 3>({std::sin(k * x[0]), 0., 0.});
      });
      Vector             weights(shape);
      body.mass.apply(weights, shape);
      const std::complex<double> lambda(-zeta * omega,
                                        omega * std::sqrt(1 - zeta * zeta));
      const auto                 amplitude = [&] {
        return std::abs(weights * body.state.v -
                        std::conj(lambda) * (weights * body.state.u));
      };

      body.state.u.copy_locally_owned_data_from(shape);
      body.system.prescribe(body.state, 0., 1.);
      body.system.solve_acceleration(body.state, 0.);
      const double start = amplitude();
      Newmark      newmark;
      for (unsigned int i = 0; i < n; ++i)
        newmark.step(body.system, {i * h, h, (i + 1.) / n}, body.state);
      const double measured = std::log(start / amplitude()) / (n * h * omega);
      report(fmt::format("damping ratio of mode {} over that asked", mode + 1),
             measured / zeta);
      const double square = omega * omega * h * h;
      EXPECT_NEAR(measured / zeta, 1 - square / 4, square * square);
    }
}
