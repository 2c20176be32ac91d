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

// Whether the run ends early, or with a warning, or energy was kept up to a
// tenth of what was put in.
TEST(ExplicitInstability, NoneIsSilent)
{
  unsigned int n_ended = 0, n_warned = 0;
  for (const double speed : {2., 4., 8.})
    for (const double end_time : {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1., 2., 2.7})
      {
        CompleteRun run(thrown_cube(speed, end_time));
        const bool  has_ended  = !run.run().empty();
        const bool  has_warned = !warnings(run).empty();
        n_ended += has_ended;
        n_warned += has_warned;
        double worst = 0;
        for (const StepRecord &record : run.recorder().records)
          worst = std::max(worst, std::abs(record.energy_balance));
        EXPECT_TRUE(has_ended || has_warned ||
                    worst <= 0.1 * 0.1875 * speed * speed)
          << speed << " m/s, until " << end_time << " s: " << worst << " J";
      }
  // Some runs are of each kind.
  EXPECT_GT(n_ended, 5u);
  EXPECT_GT(n_warned, 0u);
  report("runs that end early", n_ended);
  report("runs with a warning", n_warned);
}

// The same motion at a tenth of the speed is fine.
TEST(ExplicitInstability, StableRunIsSilent)
{
  CompleteRun run(thrown_cube(0.2, 2.7));
  EXPECT_EQ(run.run(), "");
  EXPECT_EQ(warnings(run), std::vector<std::string>());
}

// A body that lies turned over at rest has no energy but that of round-off,
// which grows with the steps.
TEST(ExplicitInstability, RoundOffIsNone)
{
  for (const std::string law : {"corotational", "neo-Hookean"})
    {
      CompleteRun run(box_mesh("1, 1, 1", "3, 2, 2") +
                      element_text(2, "diagonal scaling") + material_type(law) +
                      material_text(1, 0.3, 1) +
                      initial_conditions("-2 * x; -2 * y; 0", "0; 0; 0") +
                      section("Time integration",
                              {{"Type", "central difference"},
                               {"Time step", 0},
                               {"End time", 50}}));
      EXPECT_EQ(run.run(), "") << law;
      for (const std::string &warning : warnings(run))
        EXPECT_EQ(warning.find("energy_balance"), std::string::npos) << warning;
    }
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
  EXPECT_NE(first.find("are steps too long?"), std::string::npos) << first;
  const std::string second = message(10, 1);
  EXPECT_NE(second.find("does the body become stiffer quickly? Then 'Steps "
                        "between estimates' or 'Safety factor' must be "
                        "smaller"),
            std::string::npos)
    << second;
}
