// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Loads and supports that cannot act are named at the start of a run.

#include <deal.II/base/utilities.h>

#include <gtest/gtest.h>

#include <vector>

#include "../temporary_folder.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // The warnings of a run before its first step.
  std::vector<std::string>
  warnings_of(const std::string &text)
  {
    CompleteRun run(text);
    return warnings(run);
  }

  std::string
  held_bar(const unsigned int degree)
  {
    return box_mesh("2, 1, 1", "2, 1, 1") + element_text(degree) +
           fixed("x-min") + tractions("x-max: 1e-3; 0; 0");
  }

  const std::string reactions_only =
    ": has no effect but on reactions, as the displacement is prescribed "
    "wherever it acts";
} // namespace

TEST(ForcesWithoutEffect, AreNamed)
{
  for (const unsigned int degree : {1u, 2u, 3u})
    {
      const std::string text =
        held_bar(degree) +
        supports("x-min: 1; 1; 1, x-max: 1; 1; 1",
                 "x-min: 1",
                 "x-max: 1; 1; 1") +
        section("Loads",
                {{"Gravity", "0; 0; -1"},
                 {"Point forces", "0 0 0: 1; 0; 0, 2 0 0: 1; 0; 0"}});
      std::vector<std::string> expected{
        "Supports/Dashpots on boundary 'x-max': has no effect in statics, "
        "where nothing moves",
        "Loads/Point forces '0 0 0'" + reactions_only,
        "Supports/Elastic on boundary 'x-min'" + reactions_only,
        "Supports/Elastic normal on boundary 'x-min'" + reactions_only};
      EXPECT_EQ(warnings_of(text + statics()), expected);
      // In dynamics dashpots have an effect.
      expected.erase(expected.begin());
      EXPECT_EQ(warnings_of(text + time_integration("Newmark", 1, 0.1)),
                expected);
    }
}

// There is no warning if one component or one node is free, as then the force
// does not only change reactions.
TEST(ForcesWithoutEffect, WhatActsInPartIsNotNamed)
{
  EXPECT_EQ(warnings_of(box_mesh("2, 1, 1", "2, 1, 1") + element_text(2) +
                        displacements("x-min: 0; 0; free, x-max: 0; 0; 0") +
                        tractions("y-min: 1; 1; 1") +
                        supports("x-min: 1; 1; 1") + statics()),
            std::vector<std::string>());
}

// All nodes of the loaded boundary also belong to other boundaries, which hold
// them.
TEST(ForcesWithoutEffect, LoadOnNodesThatOthersHold)
{
  const std::string text =
    box_mesh("1, 1, 1", "1, 2, 1") + element_text(1) + fixed("x-min, x-max");
  const std::vector<std::string> expected{
    "Boundary conditions/Traction on boundary 'y-min'" + reactions_only,
    "Boundary conditions/Pressure on boundary 'z-max'" + reactions_only};
  EXPECT_EQ(warnings_of(text + tractions("y-min: 1; 0; 0") +
                        pressures("z-max: 1") + statics()),
            expected);
}

// The boundary is free only in the component in which the load acts during a
// pulse, not at the start or end of the run; there is no warning.
TEST(ForcesWithoutEffect, NotThoseOfAPulse)
{
  const auto found = warnings_of(
    held_bar(1) + displacements("x-max: free; 0; 0") +
    section("Loads",
            {{"Point forces", "2 0 0: if(t > 0.4 & t < 0.43, 1, 0); 5; 0"}}) +
    time_integration("Newmark", 1, 0.01));
  EXPECT_TRUE(found.empty()) << found.front();
}

// In statics damping only causes a warning: dashpots with wrong values are not
// evaluated.
TEST(ForcesWithoutEffect, DampingInStatics)
{
  const std::string text =
    held_bar(2) + material_type("Saint Venant-Kirchhoff") + statics(4);
  CompleteRun without(text);
  ASSERT_EQ(without.run(), "");
  CompleteRun with(
    text + section("Damping", {{"Stiffness coefficient", "0.1"}}) +
    supports("", "", "x-max: if(t > 0.4 & t < 0.6, -1, 1); 0; 0"));
  ASSERT_EQ(with.run(), "");
  for (unsigned int k = 0; k < 4; ++k)
    {
      const StepRecord &a = without.recorder().steps[k],
                       &b = with.recorder().steps[k];
      EXPECT_EQ(a.newton_iterations, b.newton_iterations);
      EXPECT_EQ(a.elastic_energy, b.elastic_energy);
    }
}
