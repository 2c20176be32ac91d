// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Loads so small, on bodies so thin, that forces could be round-off: they are
// not, and bend the body like a linear one.

#include <gtest/gtest.h>

#include "../all_laws.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // A steel strip, 1 mm thick and 1 m long.
  const std::string strip =
    box_mesh("1, 0.01, 0.001", "20, 1, 1") + fixed("x-min");

  const std::vector<std::string> turning_laws{
    material_type("corotational"),
    material_type("corotational") + rotation_at("quadrature points"),
    material_type("Saint Venant-Kirchhoff"),
    material_type("neo-Hookean")};
} // namespace

// 1e-5 N at the tip in twenty steps: in each step less than the possible, but
// not the actual, round-off of rotations in the forces of such flat cells. All
// laws give the deflection of the linear one, as strains are 1e-8 and rotations
// 1e-5.
TEST(TinyLoads, BendAThinStrip)
{
  const std::string load =
    strip + material_text(2.1e11) + tractions("x-max: 0; 0; 1") + statics(20);
  CompleteRun linear(load + material_type("linear"));
  ASSERT_EQ(linear.run(), "");
  for (const std::string &law : turning_laws)
    {
      CompleteRun run(load + law);
      ASSERT_EQ(run.run(), "");
      const auto &steps = run.recorder().steps;
      ASSERT_EQ(steps.size(), 20u);
      for (std::size_t k = 0; k < steps.size(); ++k)
        EXPECT_NEAR(steps[k].max_displacement /
                      linear.recorder().steps[k].max_displacement,
                    1,
                    1e-5)
          << law << k;
    }
}

// A tenth of that load, all at once, in implicit steps. Tolerances of solvers
// are relative to all forces and leave some 1e-5 of the displacement.
TEST(TinyLoads, MoveAThinStrip)
{
  for (const std::string method : {"BDF2", "backward Euler", "Newmark"})
    {
      const std::string text = strip + material_text(2.1e11, 0.3, 7850) +
                               tractions("x-max: 0; 0; 0.1") +
                               time_integration(method, 0.2, 0.02);
      CompleteRun linear(text + material_type("linear"));
      ASSERT_EQ(linear.run(), "");
      for (const std::string &law : turning_laws)
        {
          CompleteRun run(text + law);
          ASSERT_EQ(run.run(), "");
          EXPECT_NEAR(run.recorder().steps.back().max_displacement /
                        linear.recorder().steps.back().max_displacement,
                      1,
                      1e-4)
            << method << law;
        }
    }
}

// A short load, and hundreds of steps after it: the motion decreases in each,
// until products of its values underflow to zero. That is rest, and not a
// failure.
TEST(TinyLoads, ComeToRest)
{
  const std::string body = box_mesh("1, 0.1, 0.1", "2, 1, 1") + fixed("x-min") +
                           tractions("x-max: 0; 0; 1e3*pulse(t, 0, 0.1)");
  for (const NamedLaw &law : all_laws())
    {
      CompleteRun at_rest(
        body + law.text + statics(100) +
        section("Time integration",
                {section("static", {{"Proportional loading", false}})}));
      ASSERT_EQ(at_rest.run(), "") << law.name;
      // With rotations a displacement of their round-off remains.
      EXPECT_LT(at_rest.recorder().steps.back().max_displacement,
                law.name == "linear" ? 1e-100 : 1e-15)
        << law.name;
    }
  for (const std::string method : {"backward Euler", "BDF2"})
    for (const std::string law : {"linear", "corotational"})
      {
        // Each step covers many periods and leaves less than a thousandth of
        // the motion.
        CompleteRun damped(body + material_type(law) +
                           time_integration(method, 20000, 100) +
                           initial_conditions("0; 0; 0", "0; 0; x"));
        ASSERT_EQ(damped.run(), "") << method << law;
        EXPECT_LT(damped.recorder().steps.back().max_displacement, 1e-90)
          << method << law;
      }
}
