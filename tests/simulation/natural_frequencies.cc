// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Natural frequencies compared with theory and a NAFEMS benchmark; orders of
// convergence.

#include <gtest/gtest.h>

#include <cmath>

#include "modal.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::numbers::PI;

namespace
{
  // The relative error of the first axial eigenvalue (pi/2)^2 E / (rho L^2) of
  // a bar between rollers, whose material does not contract: the sides do not
  // move sideways, so no other mode is as low.
  double
  axial_error(const unsigned int degree,
              const unsigned int n,
              const std::string &mass)
  {
    const Analysis bar(
      box_body(
        "1, 0.25, 0.25", fmt::format("{}, {}, {}", 4 * n, n, n), degree, 0, 1) +
      sliding_along_x() + element_text(degree, mass) +
      section("Modes", {{"Tolerance", 1e-9}}));
    return std::abs(bar.mode(1).eigenvalue / (PI * PI / 4) - 1);
  }

  double
  axial_order(const unsigned int degree,
              const unsigned int n,
              const std::string &mass)
  {
    const double order = std::log2(axial_error(degree, n, mass) /
                                   axial_error(degree, 2 * n, mass));
    report(fmt::format("order of an eigenvalue, degree {}, {}", degree, mass),
           order);
    return order;
  }
} // namespace

// Eigenvalues converge with order 2p for a consistent mass. The meshes are so
// coarse that orders are below this limit, by less than 0.1.
TEST(NaturalFrequencies, OrderOfConsistentMass)
{
  EXPECT_NEAR(axial_order(1, 2, "consistent"), 2, 0.1);
  EXPECT_NEAR(axial_order(2, 1, "consistent"), 4, 0.1);
  EXPECT_NEAR(axial_order(3, 1, "consistent"), 6, 0.1);
}

// Lumped masses have order 2 for any degree: their error is that of a
// quadrature rule which is exact for linear polynomials.
TEST(NaturalFrequencies, OrderOfLumpedMass)
{
  EXPECT_NEAR(axial_order(1, 2, "row sum"), 2, 0.1);
  EXPECT_NEAR(axial_order(1, 2, "diagonal scaling"), 2, 0.1);
  EXPECT_NEAR(axial_order(2, 1, "diagonal scaling"), 2, 0.1);
  EXPECT_NEAR(axial_order(3, 1, "diagonal scaling"), 2, 0.1);
}

namespace
{
  // The first root of the frequency equation of a cantilever by Timoshenko's
  // beam theory (Huang, J. Appl. Mech. 28, 1961, 579-584): omega in units of
  // sqrt(E / rho) / L, for a square section with thickness / L = t, Poisson's
  // ratio 0 and the shear coefficient 5/6.
  double
  timoshenko_cantilever(const double t)
  {
    const double r2    = t * t / 12;
    const double s2    = r2 * 2 / (5. / 6);
    const auto   value = [&](const double b) {
      const double root  = std::sqrt((r2 - s2) * (r2 - s2) + 4 / (b * b));
      const double alpha = std::sqrt((-(r2 + s2) + root) / 2);
      const double beta  = std::sqrt((r2 + s2 + root) / 2);
      return 2 +
             (b * b * (r2 - s2) * (r2 - s2) + 2) * std::cosh(b * alpha) *
               std::cos(b * beta) -
             b * (r2 + s2) / std::sqrt(1 - b * b * r2 * s2) *
               std::sinh(b * alpha) * std::sin(b * beta);
    };
    // Without shear the root is b = 3.516.
    double low = 3, high = 3.6;
    for (unsigned int i = 0; i < 60; ++i)
      {
        const double middle                           = 0.5 * (low + high);
        (value(middle) * value(low) > 0 ? low : high) = middle;
      }
    return low * std::sqrt(r2);
  }
} // namespace

// A cantilever of square section, 20 times as long as thick, nu = 0, compared
// with beam theories: Timoshenko's for bending, Saint-Venant's for torsion
// (with J = 0.140577 t^4, polar moment t^4 / 6), and extension, (pi / 2) sqrt(E
// / rho) / L, which is exact, so that only the error of order 2p is left. The
// clamped end, which cannot warp, makes torsion stiffer by about 0.2 %.
// Effective masses: 8 / pi^2 for extension; 0.6131 for bending, by Bernoulli's
// theory.
TEST(NaturalFrequencies, Cantilever)
{
  const double thickness = 0.05, mass = thickness * thickness;
  for (const unsigned int degree : {2u, 3u})
    {
      SCOPED_TRACE(degree);
      const Analysis beam(box_body("1, 0.05, 0.05",
                                   degree == 2 ? "20, 4, 4" : "10, 2, 2",
                                   degree,
                                   0,
                                   8) +
                          fixed("x-min"));
      const auto     compare = [&](const std::string &what,
                               const unsigned int number,
                               const double       expected,
                               const double       tolerance) {
        const double error = beam.mode(number).angular_frequency / expected - 1;
        report(fmt::format("{} of a cantilever, degree {}: error",
                           what,
                           degree),
               error);
        EXPECT_NEAR(error, 0, tolerance) << what;
      };
      const double bending = timoshenko_cantilever(thickness);
      compare("bending", 1, bending, degree == 2 ? 2e-4 : 1e-5);
      compare("bending", 2, bending, degree == 2 ? 2e-4 : 1e-5);
      compare("torsion", 7, PI / 2 * std::sqrt(0.5 * 0.140577 * 6), 0.005);
      compare("extension", 8, PI / 2, degree == 2 ? 1e-7 : 1e-9);

      const auto share =
        beam.mode(1).effective_mass / mass + beam.mode(2).effective_mass / mass;
      EXPECT_NEAR(share[0], 0, 1e-10);
      EXPECT_NEAR(share[1], 0.6131, 0.005);
      EXPECT_NEAR(share[2], 0.6131, 0.005);
      EXPECT_NEAR(beam.mode(7).effective_mass.norm() / mass, 0, 1e-10);
      EXPECT_NEAR(beam.mode(8).effective_mass[0] / mass,
                  8 / (PI * PI),
                  degree == 2 ? 1e-5 : 1e-6);
    }
}

// The NAFEMS benchmark FV52 (Selected benchmarks for natural frequency
// analysis, R0015) has three rigid body modes, then 44.762, 110.52 (twice),
// 169.08, 193.93 and 206.64 Hz (twice), computed with 4 x 4 x 1 bricks of 20
// nodes. The plate is supported on lines, which solids do not feel in the limit
// of small cells: bending frequencies decrease with each refinement, so a value
// without its mesh has no meaning. With 6 x 6 x 1 cuboids of degree 2 all are
// within 1 %; the mode in the plane, 193.59 Hz by theory, is the same on all
// meshes.
TEST(NaturalFrequencies, PlateOnItsLowerEdges)
{
  const Analysis plate(
    box_mesh("10, 10, 1", "6, 6, 1") + element_text(2) +
    material_text(200e9, 0.3, 8000) +
    displacements("x-min & z-min: free; free; 0, x-max & z-min: free; free; 0, "
                  "y-min & z-min: free; free; 0, "
                  "y-max & z-min: free; free; 0"));
  const std::vector<double> expected{
    44.762, 110.52, 110.52, 169.08, 193.93, 206.64, 206.64};
  for (unsigned int i = 1; i <= 3; ++i)
    EXPECT_LT(plate.mode(i).frequency, 1e-10 * 44.762);
  for (unsigned int i = 0; i < 7; ++i)
    EXPECT_NEAR(plate.mode(4 + i).frequency, expected[i], 0.01 * expected[i]);
  // The mesh has the symmetry of the plate: pairs are equal up to round-off.
  for (const unsigned int i : {5u, 9u})
    EXPECT_NEAR(plate.mode(i).frequency,
                plate.mode(i + 1).frequency,
                1e-9 * plate.mode(i).frequency);
}
