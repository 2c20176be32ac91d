// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Bodies with soft and stiff parts: round-off of the stiff ones, which may be
// larger than all forces on the soft ones, does not hide these.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "complete_run.h"
#include "stable_step.h"

using namespace corotet;
using namespace corotet::tests;

// A thin rod of 30 kPa sticks out of a steel block and bends down by 300 N/m^3,
// while both fly at one velocity, which makes no difference: seen from the
// flying body it bends as on a body at rest, by some 5 mm in 0.1 s. Positions
// of 10 m have a round-off of 1e-15 m, which is a stress of 2 mPa in steel and
// more than all forces on the rod together. Newton's method is asked for 1e-9
// of the displacement.
TEST(SoftAndStiff, RodOnAFlyingBlock)
{
  const auto bend = [](const std::string &type, const double velocity) {
    CompleteRun run(
      box_mesh("2, 0.1, 0.1", "20, 1, 1") +
      section("Selections",
              {{"Regions",
                "block: box -1 -1 -1 1 1 1, rod: box 1 -1 -1 3 1 1"}}) +
      element_text(2) + material_type(type) +
      section("Material",
              {{"Young's modulus", "block: 2e11, rod: 3e4"},
               {"Density", "block: 7800, rod: 1000"}}) +
      section("Loads", {{"Body force", "0; 0; if(x > 1, -300, 0)"}}) +
      initial_conditions("0; 0; 0", fmt::format("{}; 0; 0", velocity)) +
      newton_tolerances(1e-9) + time_integration("Newmark", 0.1, 0.01));
    EXPECT_EQ(run.run(), "");
    Vector u = run.recorder().displacement;
    for (unsigned int i = 0; i < u.locally_owned_size(); i += 3)
      u.local_element(i) -= 0.1 * velocity;
    return u;
  };
  for (const std::string type : {"linear", "corotational"})
    {
      const Vector at_rest = bend(type, 0);
      EXPECT_GT(at_rest.linfty_norm(), 1e-3);
      EXPECT_LE(largest_difference(bend(type, 100), at_rest), 1e-8) << type;
    }
}

// A plate, half of it 1e6 times as stiff as the other one: the stiff half
// turns as a whole about the soft one. Round-off in the rows of an assembled
// matrix is a moment on the stiff half, of some tenths of that of the load;
// iterations take it away.
TEST(SoftAndStiff, AssembledMatrixOfAPlate)
{
  const auto sink = [](const std::string &matrix) {
    CompleteRun run(
      box_mesh("10, 10, 0.1", "4, 4, 1") +
      section("Selections",
              {{"Regions", "soft: box -1 -1 -1 5 11 1, stiff: not soft"}}) +
      element_text(3) + material_type("linear") +
      section("Material", {{"Young's modulus", "soft: 1e6, stiff: 1e12"}}) +
      fixed("x-min") + gravity("0.1; 0.2; -0.3") +
      section("Linear solver", {{"Type", "direct"}, {"Operator", matrix}}) +
      statics(1));
    EXPECT_EQ(run.run(), "");
    return run.recorder().displacement;
  };
  const Vector u = sink("matrix-free");
  EXPECT_LE(largest_difference(sink("assembled"), u), 1e-5 * u.linfty_norm());
}

// A light end of a heavy body, whose mass is 1e-7 of the other end's, has the
// fastest modes: as sqrt(E / rho), to the estimates' tolerance, as the heavy
// part holds it as a wall does. With E / rho 1.1 times that of the other end
// its modes are next to those of this end.
TEST(SoftAndStiff, StableStepOfLightParts)
{
  const auto step_of_light_end = [](const double ratio) {
    return stable_step(
      box_mesh("7, 1, 1", "14, 2, 2") + element_text(1, "diagonal scaling") +
      section("Selections",
              {{"Regions",
                "heavy: box -1 -1 -1 1 9 9, light: box 6 -1 -1 8 9 9, "
                "middle: box 1 -1 -1 6 9 9"}}) +
      material_type("linear") +
      section("Material",
              {{"Young's modulus",
                fmt::format("heavy: 3e6, middle: 1e6, light: {}",
                            3e6 * 1e-7 * ratio)},
               {"Density", "heavy: 1000, middle: 1000, light: 1e-4"}}));
  };
  EXPECT_NEAR(step_of_light_end(1.1) * std::sqrt(1.1) /
                (step_of_light_end(10) * std::sqrt(10.)),
              1,
              1e-3);
}
