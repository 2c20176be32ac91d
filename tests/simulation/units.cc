// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Results in any units: a body whose length, modulus, density and loads are
// multiplied by powers of two moves as before, but for the units. Such factors
// change only exponents of numbers, without rounding, so results are the same
// to the last bit, as long as no number leaves its range; powers are even, as
// square roots of these quantities occur. Stiffnesses and forces exceed the
// range of single precision.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "complete_run.h"
#include "modal.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // Exponents of two for units of length [m], modulus [Pa] and density
  // [kg/m^3].
  struct Units
  {
    int length  = 0;
    int modulus = 0;
    int density = 0;

    double
    seconds() const
    {
      return std::ldexp(1., length + (density - modulus) / 2);
    }
  };

  // Bodies of 1e-9 m with small forces; with matrices of 1e-42 and of 1e42 N/m,
  // and forces of 1e-72 and of 1e60 N.
  const std::vector<Units> all_units = {{-30, 40, 10},
                                        {-50, -90, 20},
                                        {60, 80, -20}};

  std::string
  body(const Units       &units,
       const unsigned int degree,
       const std::string &law,
       const std::string &coarse_solver)
  {
    const double metre  = std::ldexp(1., units.length);
    const double pascal = std::ldexp(1., units.modulus);
    return box_mesh(fmt::format("{0}, {1}, {1}", 4 * metre, metre), "8, 2, 2") +
           element_text(degree) + material_type(law) +
           material_text(pascal, 0.3, std::ldexp(1., units.density)) +
           fixed("x-min") +
           tractions(
             fmt::format("x-max: {}; {}; 0", 1e-3 * pascal, 1e-4 * pascal)) +
           section("Linear solver",
                   {section("p-multigrid",
                            {{"Coarse solver", coarse_solver}})});
  }

  // The displacement at the end, in these units.
  std::vector<double>
  displacement(const std::string &text, const Units &units)
  {
    CompleteRun run(text);
    EXPECT_EQ(run.run(), "");
    std::vector<double> result;
    for (unsigned int i = 0; i < run.simulation.state().u.locally_owned_size();
         ++i)
      result.push_back(
        std::ldexp(run.simulation.state().u.local_element(i), -units.length));
    return result;
  }

  void
  expect_same_motion(const unsigned int degree,
                     const std::string &law,
                     const std::string &coarse_solver,
                     const std::string &mass,
                     const std::string &integrator,
                     const double       time_step,
                     const double       end_time)
  {
    const auto found = [&](const Units &units) {
      return displacement(
        body(units, degree, law, coarse_solver) + element_text(degree, mass) +
          time_integration(integrator,
                           end_time * units.seconds(),
                           time_step * units.seconds(),
                           {section("static", {{"Load steps", 2}})}),
        units);
    };
    const std::vector<double> reference = found({});
    for (const Units &units : all_units)
      EXPECT_EQ(found(units), reference)
        << degree << ' ' << law << ' ' << coarse_solver << ' ' << integrator
        << ", 2^" << units.length << " m";
  }
} // namespace

TEST(Units, Statics)
{
  for (const unsigned int degree : {1u, 2u, 3u})
    for (const std::string coarse_solver : {"direct", "aggregation"})
      {
        expect_same_motion(
          degree, "linear", coarse_solver, "consistent", "static", 1, 1);
        expect_same_motion(
          degree, "corotational", coarse_solver, "consistent", "static", 1, 1);
      }
}

TEST(Units, ImplicitDynamics)
{
  for (const unsigned int degree : {1u, 2u, 3u})
    for (const std::string coarse_solver : {"direct", "aggregation"})
      expect_same_motion(
        degree, "corotational", coarse_solver, "consistent", "Newmark", 1, 3);
}

// The program chooses the stable step, from the largest frequency.
TEST(Units, ExplicitDynamics)
{
  for (const std::string mass : {"diagonal scaling", "consistent"})
    expect_same_motion(
      1, "corotational", "direct", mass, "central difference", 0, 3);
}

// Eigenvalues are exact to the square of the tolerance of residuals, 1e-8, or
// to round-off of the matrices, on which decisions of the search depend.
TEST(Units, Modes)
{
  for (const unsigned int degree : {1u, 2u, 3u})
    for (const std::string coarse_solver : {"direct", "aggregation"})
      {
        const auto found = [&](const Units &units) {
          const Analysis computed(body(units, degree, "linear", coarse_solver) +
                                  section("Modes", {{"Number", 4}}));
          std::vector<double> result;
          for (const Mode &mode : computed.analysis.modes())
            result.push_back(mode.frequency * units.seconds());
          return result;
        };
        const std::vector<double> reference = found({});
        for (const Units &units : all_units)
          {
            const std::vector<double> here = found(units);
            for (unsigned int i = 0; i < 4; ++i)
              EXPECT_NEAR(here[i], reference[i], 1e-11 * reference[i])
                << degree << ' ' << coarse_solver << ", 2^" << units.length;
          }
      }
}
