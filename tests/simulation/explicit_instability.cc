// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A neo-Hookean cube, held at one side, that is thrown against it becomes so
// stiff that steps of the stable length at the start are too long. No such run
// ends without a word.

#include <gtest/gtest.h>

#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // The wave speed is 12 m/s, and @p speed [m/s] that of the free side.
  std::string
  thrown_cube(const double speed, const double end_time)
  {
    return box_mesh("1, 1, 1", "2, 2, 2") + element_text(1, "row sum") +
           material_type("neo-Hookean") + material_text(100, 0.3, 1) +
           fixed("x-min") +
           section("Initial conditions",
                   {{"Velocity", fmt::format("-{} * x; 0; 0", speed)}}) +
           section("Time integration",
                   {{"Type", "central difference"},
                    {"Time step", 0},
                    {"End time", end_time}});
  }
} // namespace

// Between two estimates of the stable step, energies far below zero appear
// where 3 J and 12 J were put in.
TEST(ExplicitInstability, EnergyThatVanishes)
{
  for (const auto &[speed, end_time] :
       {std::pair(4., 0.596), std::pair(8., 0.3368)})
    {
      CompleteRun       run(thrown_cube(speed, end_time));
      const std::string message = run.run();
      EXPECT_NE(message.find("the motion is unstable"), std::string::npos)
        << message;
    }
}

// 0.75 J were put in, and as much vanishes until the end.
TEST(ExplicitInstability, LossIsNamed)
{
  CompleteRun run(thrown_cube(2, 2.7));
  EXPECT_EQ(run.run(), "");
  const auto found = warnings(run);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("J have been lost, and 0.75 J have been put in: "
                          "shorter time steps, more estimates"),
            std::string::npos)
    << found[0];
}

// The same motion at a tenth of the speed is fine.
TEST(ExplicitInstability, StableRunIsSilent)
{
  CompleteRun run(thrown_cube(0.2, 2.7));
  EXPECT_EQ(run.run(), "");
  EXPECT_EQ(warnings(run), std::vector<std::string>());
}

// Forces that are not finite although no cell is flat come from long steps. In
// the second run the stable step is estimated after each step.
TEST(ExplicitInstability, CauseIsNamed)
{
  const auto message = [](const double speed, const unsigned int interval) {
    CompleteRun run(
      thrown_cube(speed, 1) +
      section("Time integration",
              {section("central difference",
                       {{"Steps between estimates", interval}})}));
    return run.run({5, 0.});
  };
  const std::string first = message(10, 1000);
  EXPECT_NE(first.find("(smallest det F 1.61); are steps too long?"),
            std::string::npos)
    << first;
  const std::string second = message(10, 1);
  EXPECT_NE(second.find("does the body become stiffer quickly? Then 'Steps "
                        "between estimates' or 'Safety factor' must be "
                        "smaller"),
            std::string::npos)
    << second;
}
