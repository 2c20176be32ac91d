// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Steps that fail and are repeated in halves.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bent_bar.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // A run that has finished.
  struct FinishedRun : public CompleteRun
  {
    explicit FinishedRun(const std::string &text)
      : CompleteRun(text)
      , message(run())
    {}

    const std::string message;
  };

  std::string
  bar(const std::string &integration,
      const unsigned int max_iterations,
      const std::string &traction,
      const double       tolerance = 1e-11)
  {
    return bent_bar(integration, max_iterations, traction, tolerance);
  }

  std::string
  dynamics(const double time_step)
  {
    return time_integration("generalized-alpha", 0.2, time_step);
  }
} // namespace

// A load step that fails at first is made in parts, and ends in the same state
// as small steps; records are those of the given steps.
TEST(Halving, Statics)
{
  const FinishedRun small(bar(statics(32, 0), 50, "5000"));
  const FinishedRun halved(bar(statics(2, 8), 5, "5000"));
  EXPECT_EQ(small.message, "");
  EXPECT_EQ(halved.message, "");
  const auto &records = halved.recorder().steps;
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].time, 0.5);
  EXPECT_EQ(records[1].time, 1.);
  unsigned int parts = 0;
  for (const StepRecord &record : records)
    {
      parts += record.parts;
      EXPECT_NEAR(record.dt, 0.5, 1e-15);
      EXPECT_GE(record.newton_iterations, record.parts);
      EXPECT_LE(record.newton_iterations, 5 * record.parts);
    }
  report("parts of two load steps", parts);
  EXPECT_GE(parts, 3u);
  for (const StepRecord &record : small.recorder().steps)
    EXPECT_EQ(record.parts, 1u);
  // In statics the result does not depend on the path.
  const StepRecord &last = small.recorder().steps.back();
  EXPECT_GE(last.max_displacement, 0.3);
  EXPECT_LE(largest_difference(halved.simulation.state().u,
                               small.simulation.state().u),
            1e-9);
  EXPECT_NEAR(records.back().elastic_energy,
              last.elastic_energy,
              1e-9 * last.elastic_energy);
  EXPECT_EQ(halved.recorder().summary.status, "done");
  EXPECT_EQ(halved.recorder().summary.steps, 2u);
}

// A time step made in two parts equals two steps of half the size,
// accelerations and works included.
TEST(Halving, Dynamics)
{
  const FinishedRun halved(bar(dynamics(0.2), 2, "8", 1e-9));
  const FinishedRun half(bar(dynamics(0.1), 2, "8", 1e-9));
  EXPECT_EQ(half.message, "");
  EXPECT_EQ(halved.message, "");
  const auto &records = halved.recorder().steps;
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(records[0].parts, 2u);
  EXPECT_NEAR(records[0].dt, 0.2, 1e-15);
  EXPECT_EQ(records[0].time, 0.2);
  ASSERT_EQ(half.recorder().steps.size(), 2u);
  const StepRecord &last = half.recorder().steps.back();
  EXPECT_EQ(last.parts, 1u);
  const State &a = halved.simulation.state(), &b = half.simulation.state();
  EXPECT_GT(b.u.linfty_norm(), 5e-4);
  EXPECT_LE(largest_difference(a.u, b.u), 1e-12 * b.u.linfty_norm());
  EXPECT_LE(largest_difference(a.v, b.v), 1e-12 * b.v.linfty_norm());
  EXPECT_LE(largest_difference(a.a, b.a), 1e-12 * b.a.linfty_norm());
  EXPECT_NEAR(records[0].external_work,
              last.external_work,
              1e-12 * last.external_work);
}

// The load is finite up to t = 0.55, and again at the last of four load steps:
// two steps are recorded, then parts of the third as far as halving allows, t =
// 0.5 + 0.25 (1/8).
TEST(Halving, GivesUp)
{
  const FinishedRun run(
    bar(statics(4, 3), 50, "if(t > 0.55 && t < 0.9, 1/(t-t), 100)"));
  EXPECT_EQ(run.message.find("step 3 (t = 0.53125): the forces are not finite"),
            0u)
    << run.message;
  EXPECT_NE(run.message.find("; the step has been halved 3 times"),
            std::string::npos)
    << run.message;
  const auto &shown = run.recorder().steps;
  ASSERT_EQ(shown.size(), 3u);
  EXPECT_EQ(shown[1].time, 0.5);
  EXPECT_EQ(shown[2].step, 3u);
  EXPECT_EQ(shown[2].time, 0.53125);
  EXPECT_EQ(shown[2].parts, 1u);
  EXPECT_NEAR(shown[2].dt, 0.03125, 1e-15);
  EXPECT_TRUE(run.recorder().last);
  EXPECT_EQ(run.recorder().saved.size(), 0u);
  EXPECT_EQ(run.recorder().summary.status, "failed");
  EXPECT_EQ(run.recorder().summary.message, run.message);
  EXPECT_EQ(run.recorder().summary.end_time, 0.53125);
  // The saved state is the equilibrium for that load, of factor 0.53125.
  const FinishedRun good(
    bar(statics(1, 0), 50, fmt::format("{}", 100 * 0.53125)));
  EXPECT_LE(largest_difference(run.recorder().displacement,
                               good.recorder().displacement),
            1e-10 * good.recorder().displacement.linfty_norm());
}

// A step from a guess that fails starts from the guess again, not from rest.
TEST(Halving, StartsFromTheGuessAgain)
{
  const std::string text =
    bar(statics(1, 1), 1, "5000") +
    initial_conditions("0.05 * z; 0; -0.02 * x^2", "0; 0; 0");
  MovingBody        guess(box("1, 0.1, 0.1", "5, 1, 1"), text);
  const FinishedRun run(text);
  EXPECT_NE(run.message.find("; the step has been halved 1 times"),
            std::string::npos)
    << run.message;
  EXPECT_GT(guess.state.u.linfty_norm(), 0.01);
  EXPECT_EQ(largest_difference(run.recorder().displacement, guess.state.u), 0.);
}

// Rows are written less often than steps: the last good step, which had no row,
// gets one before the run ends.
TEST(Halving, FailsBetweenRows)
{
  CompleteRun run(
    bar(statics(4, 0), 50, "if(t > 0.55 && t < 0.9, 1/(t-t), 100)"));
  const std::string message = run.run({.steps_between_rows = 4});
  EXPECT_EQ(message.find("step 3 (t = 0.5): the forces are not finite"), 0u)
    << message;
  const Recorder &recorder = run.recorder();
  ASSERT_EQ(recorder.steps.size(), 1u);
  EXPECT_EQ(recorder.steps[0].step, 2u);
  EXPECT_EQ(recorder.steps[0].time, 0.5);
  EXPECT_TRUE(recorder.last);
  EXPECT_EQ(recorder.saved.size(), 0u);
  EXPECT_EQ(recorder.summary.steps, 2u);
  EXPECT_EQ(recorder.summary.end_time, 0.5);
  const FinishedRun good(bar(statics(1, 0), 50, "50"));
  EXPECT_NEAR(recorder.steps[0].elastic_energy,
              good.recorder().steps[0].elastic_energy,
              1e-9 * good.recorder().steps[0].elastic_energy);
  EXPECT_LE(largest_difference(recorder.displacement,
                               good.recorder().displacement),
            1e-10 * good.recorder().displacement.linfty_norm());
}

// No part of the third step succeeds: the second, which has been recorded, is
// saved.
TEST(Halving, FailsAtOnceWithoutHalvings)
{
  const FinishedRun run(
    bar(statics(4, 0), 50, "if(t > 0.55 && t < 0.9, 1/(t-t), 100)"));
  EXPECT_EQ(run.message.find("step 3 (t = 0.5): the forces are not finite"), 0u)
    << run.message;
  EXPECT_EQ(run.message.find("halved"), std::string::npos);
  ASSERT_EQ(run.recorder().steps.size(), 2u);
  ASSERT_EQ(run.recorder().saved.size(), 1u);
  EXPECT_EQ(run.recorder().saved[0].step, 2u);
  EXPECT_EQ(run.recorder().saved[0].time, 0.5);
  EXPECT_TRUE(run.recorder().last);
  EXPECT_EQ(run.recorder().summary.status, "failed");
  EXPECT_EQ(run.recorder().summary.steps, 2u);
  const FinishedRun good(bar(statics(1, 0), 50, "50"));
  EXPECT_LE(largest_difference(run.recorder().displacement,
                               good.recorder().displacement),
            1e-10 * good.recorder().displacement.linfty_norm());
}
