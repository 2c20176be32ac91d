// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Runs with very many steps: refused if the number cannot be counted, else a
// warning.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../refusal.h"
#include "../temporary_folder.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  std::string
  cube(const Entries integration)
  {
    return element_text(1, "diagonal scaling") + linear_solver("direct") +
           fixed("x-min") + section("Time integration", integration);
  }

  std::string
  run_refusal(const Entries integration)
  {
    return refusal([&] { const CompleteRun run(cube(integration)); });
  }

  // The warnings about the number of steps. Collective.
  std::vector<std::string>
  warnings_of_steps(CompleteRun &run)
  {
    std::vector<std::string> result = warnings(run);
    std::erase_if(result, [](const std::string &line) {
      return !line.starts_with("steps");
    });
    return result;
  }
} // namespace

TEST(NumberOfSteps, EqualSteps)
{
  EXPECT_EQ(run_refusal({{"Time step", 1e-12}}),
            "Time integration/Time step: found 1e-12, which makes 1e+12 steps "
            "from t = 0 to 1; allowed: at most 4000000000 steps, so at least "
            "2.5e-10");
  EXPECT_EQ(
    run_refusal({{"Type", "central difference"}, {"Time step", 1e-300}}),
    "Time integration/Time step: found 1e-300, which makes 1e+300 steps "
    "from t = 0 to 1; allowed: at most 4000000000 steps, so at least "
    "2.5e-10");
  EXPECT_EQ(run_refusal({{"Time step", 2.5e-10}}), "nothing was refused");

  CompleteRun few(cube({{"Time step", 1e-7}}));
  CompleteRun many(cube({{"Time step", 0.99e-7}}));
  EXPECT_TRUE(warnings_of_steps(few).empty());
  EXPECT_EQ(warnings_of_steps(many),
            std::vector<std::string>(
              {"steps of 9.9e-08 s: 1.01e+07 of them up to the end time"}));
}

// The stable step for the default material is some microseconds.
TEST(NumberOfSteps, StableSteps)
{
  const Entry type("Type", "central difference"), stable("Time step", 0);
  EXPECT_EQ(run_refusal({type, stable, {"End time", 1e9}})
              .rfind("Time integration/Time step: found 0 and stable steps of",
                     0),
            0u);
  EXPECT_EQ(run_refusal({type, stable}), "nothing was refused");
  CompleteRun many(cube({type, stable, {"End time", 1e5}}));
  EXPECT_FALSE(warnings_of_steps(many).empty());
}

// Adaptive steps of the first length would be too many; and steps become ever
// shorter before a load that is not finite, until round-off swallows them.
TEST(NumberOfSteps, AdaptiveSteps)
{
  const auto adaptive = [](const double step) {
    return cube({{"Type", "Newmark"},
                 {"Time step", step},
                 section("Adaptive step", {{"Enabled", true}})});
  };
  CompleteRun few(adaptive(1e-3));
  CompleteRun many(adaptive(1e-9));
  EXPECT_TRUE(warnings_of_steps(few).empty());
  EXPECT_EQ(warnings_of_steps(many),
            std::vector<std::string>(
              {"steps of 1e-09 s: 1e+09 of them up to the end time"}));

  CompleteRun shorter(
    adaptive(1e-2) +
    section("Time integration",
            {section("Adaptive step", {{"Smallest step", 1e-30}})}) +
    gravity("0; 0; if(t > 0.5 && t < 0.9, 1/0, -1)"));
  const std::string message = shorter.run();
  EXPECT_NE(message.find("which round-off of the time swallows"),
            std::string::npos)
    << message;
  EXPECT_FALSE(warnings_of_steps(shorter).empty());
}

// Steps whose length the run chooses, by stability or by their error, end at
// results: with a shorter time between these, there are as many steps as
// results. Equal steps do not end there.
TEST(NumberOfSteps, StepsThatEndAtResults)
{
  const auto start = [](CompleteRun &run, const double interval) {
    run.simulation.start(run.observers, {1, interval});
  };
  for (const std::string &text :
       {cube({{"Type", "central difference"}, {"Time step", 0}}),
        cube({{"Type", "Newmark"},
              {"Time step", 1e-3},
              section("Adaptive step", {{"Enabled", true}})})})
    {
      CompleteRun too_many(text), many(text), few(text), none(text);
      EXPECT_EQ(refusal([&] { start(too_many, 1e-12); }),
                "Output/Time between results: found 1e-12, which makes 1e+12 "
                "steps from t = 0 to 1, as steps end at its multiples; "
                "allowed: at most 4000000000 steps, so at least 2.5e-10");
      start(many, 0.9e-7);
      EXPECT_EQ(warnings_of_steps(many),
                std::vector<std::string>(
                  {"steps of 9e-08 s: 1.11e+07 of them up to the end time"}));
      start(few, 2e-7);
      EXPECT_TRUE(warnings_of_steps(few).empty());
      EXPECT_NEAR(few.simulation.planned_steps(), 5e6, 1);
      const double n_planned = none.simulation.planned_steps();
      start(none, 0.5);
      EXPECT_EQ(none.simulation.planned_steps(), n_planned);
      EXPECT_LT(n_planned, 5e6);
    }
  CompleteRun equal(cube({{"Time step", 1e-3}}));
  EXPECT_EQ(refusal([&] { start(equal, 1e-12); }), "nothing was refused");
  EXPECT_TRUE(warnings_of_steps(equal).empty());
}

// This holds at other times, too: half of a step of one unit of round-off may
// be rounded to that step again, which must not go on for ever.
TEST(NumberOfSteps, RejectedStepsBecomeShorter)
{
  for (unsigned int i = 1; i < 60; i += 3)
    {
      const std::string begin = fmt::format("{:.3f}", i / 61.);
      CompleteRun       run(
        cube({{"Type", "Newmark"},
                    {"Time step", 1e-2},
                    section("Adaptive step",
                            {{"Enabled", true}, {"Smallest step", 1e-30}})}) +
        gravity("0; 0; if(t > " + begin + " && t < 0.995, 1/0, -1)"));
      EXPECT_NE(run.run().find("which round-off of the time swallows"),
                std::string::npos)
        << begin;
    }
}

// An energy whose squares overflow while the forces are finite: the step does
// not count, and time, state and record remain those of the step before.
class EnergyOverflow : public testing::TestWithParam<std::string>
{};

TEST_P(EnergyOverflow, StepIsTakenBack)
{
  CompleteRun run(
    box_mesh("2, 1, 1", "2, 1, 1") + element_text(1) + material_type("linear") +
    material_text(1e-20, 0.3, 1e-20) + fixed("x-min") +
    displacements("x-max: 1e155*t^4; 0; 0") + linear_solver("direct") +
    section("Time integration", {{"Maximum halvings", 3}}) + GetParam());
  const std::string message = run.run();
  EXPECT_NE(message.find("the energy is not finite"), std::string::npos)
    << message;

  const StepRecord &last = run.recorder().records.back();
  EXPECT_GT(last.step, 2u);
  EXPECT_TRUE(std::isfinite(last.kinetic_energy + last.elastic_energy +
                            last.external_work + last.energy_balance));
  const double time = last.time;
  EXPECT_LT(time, 2);
  // The last record may belong to a part of a step.
  EXPECT_NE(message.find(fmt::format("(t = {:.6g}): ", time)),
            std::string::npos)
    << message;
  EXPECT_DOUBLE_EQ(run.simulation.state().u.linfty_norm(),
                   1e155 * std::pow(time, 4));
  EXPECT_EQ(run.recorder().summary.end_time, time);
  EXPECT_EQ(run.recorder().summary.steps, last.step);
}

INSTANTIATE_TEST_SUITE_P(
  All,
  EnergyOverflow,
  testing::Values(time_integration("Newmark",
                                   2,
                                   0.01,
                                   {section("Adaptive step",
                                            {{"Enabled", true},
                                             {"Smallest step", 1e-3},
                                             {"Largest step", 0.1},
                                             {"Target error", 1}})}),
                  time_integration("Newmark", 2, 0.01),
                  time_integration("central difference", 2, 0.01)));
