// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Steps that are interrupted between their parts, or while systems are solved,
// and continued later.

#include <gtest/gtest.h>

#include "../memory_archive.h"
#include "bent_bar.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  std::string
  halved_bar(const std::string &integration,
             const unsigned int max_iterations,
             const std::string &traction,
             const std::string &solver = "jacobi")
  {
    return bent_bar(integration, max_iterations, traction, 1e-9, solver);
  }

  void
  expect_same(const StepRecord &a, const StepRecord &b)
  {
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.dt, b.dt);
    EXPECT_EQ(a.parts, b.parts);
    EXPECT_EQ(a.newton_iterations, b.newton_iterations);
    EXPECT_EQ(a.linear_iterations, b.linear_iterations);
    EXPECT_EQ(a.elastic_energy, b.elastic_energy);
    EXPECT_EQ(a.external_work, b.external_work);
    EXPECT_EQ(a.energy_balance, b.energy_balance);
  }

  std::string
  moved_by_adaptive_steps()
  {
    return halved_bar(time_integration("generalized-alpha",
                                       0.2,
                                       0.01,
                                       {section("Adaptive step",
                                                {{"Enabled", true},
                                                 {"Target error", 3e-3}})}),
                      50,
                      "8");
  }
} // namespace

// A step that is interrupted after each of its parts, saved, and continued by
// another process is the same to the last bit.
TEST(InterruptedSteps, BetweenParts)
{
  for (const std::string &text :
       {halved_bar(statics(2, 8), 5, "5000"),
        halved_bar(time_integration("generalized-alpha", 0.4, 0.2), 2, "8")})
    {
      CompleteRun whole(text);
      ASSERT_EQ(whole.run(), "");
      std::vector<StepRecord>      steps;
      std::unique_ptr<CompleteRun> run = std::make_unique<CompleteRun>(text);
      run->simulation.start(run->observers);
      unsigned int n_left = 0;
      for (;;)
        {
          run->simulation.step(
            {.after_step = [] { return true; }, .within_step = {}});
          for (const StepRecord &record : run->recorder().steps)
            steps.push_back(record);
          if (run->simulation.is_done())
            break;
          n_left += run->simulation.parts_made() > 0;
          MemoryArchive archive;
          run->simulation.save_state(archive);
          archive.reading = true;
          auto next       = std::make_unique<CompleteRun>(text);
          next->simulation.resume(next->observers, {}, archive);
          EXPECT_EQ(next->simulation.time(), run->simulation.time());
          EXPECT_EQ(next->simulation.parts_made(),
                    run->simulation.parts_made());
          run = std::move(next);
        }
      report("states between parts", n_left);
      EXPECT_GE(n_left, 1u);
      const std::vector<StepRecord> &expected = whole.recorder().steps;
      ASSERT_EQ(steps.size(), expected.size());
      for (std::size_t i = 0; i < steps.size(); ++i)
        expect_same(steps[i], expected[i]);
      EXPECT_EQ(largest_difference(run->simulation.state().u,
                                   whole.simulation.state().u),
                0);
    }
}

// A step that is given up in the middle of a solve leaves the state before it,
// from which the run goes on, here or in another process.
TEST(InterruptedSteps, WithinSolves)
{
  for (const std::string &text :
       {halved_bar(statics(2, 8), 5, "5000"),
        halved_bar(statics(4, 8), 5, "5000", "p-multigrid"),
        halved_bar(time_integration("generalized-alpha", 0.4, 0.2), 2, "8"),
        moved_by_adaptive_steps()})
    {
      CompleteRun whole(text), run(text);
      ASSERT_EQ(whole.run(), "");
      run.simulation.start(run.observers);
      unsigned int n_steps = 0, n_given_up = 0;
      while (!run.simulation.is_done())
        {
          const double time = run.simulation.time();
          const Vector u    = run.simulation.state().u;
          // Every second step is given up, each time at another question.
          const unsigned int when = n_steps % 2 == 0 ? n_steps % 7 + 1 : 0;
          ++n_steps;
          bool         is_given_up = false;
          unsigned int n_asked     = 0;
          run.simulation.step({.after_step = {}, .within_step = [&] {
                                 is_given_up = ++n_asked == when;
                                 return is_given_up;
                               }});
          if (!is_given_up)
            continue;
          ++n_given_up;
          ASSERT_FALSE(run.simulation.is_done());
          EXPECT_GE(run.simulation.time(), time);
          if (run.simulation.time() == time)
            {
              EXPECT_EQ(largest_difference(run.simulation.state().u, u), 0);
            }
          else
            {
              EXPECT_GT(run.simulation.parts_made(), 0u);
            }
          EXPECT_EQ(largest_difference(run.simulation.displacement(),
                                       run.simulation.state().u),
                    0);
          if (n_given_up > 3)
            continue;
          MemoryArchive archive;
          run.simulation.save_state(archive);
          archive.reading = true;
          CompleteRun other(text);
          other.simulation.resume(other.observers, {}, archive);
          while (!other.simulation.is_done())
            other.simulation.step();
          // The tolerance is that of solvers and, in adaptive runs, of step
          // sizes that were chosen again.
          EXPECT_LE(largest_difference(other.simulation.state().u,
                                       whole.simulation.state().u),
                    1e-7 * whole.simulation.state().u.linfty_norm());
        }
      report("steps given up", n_given_up);
      EXPECT_GE(n_given_up, 1u);
      EXPECT_LE(largest_difference(run.simulation.state().u,
                                   whole.simulation.state().u),
                1e-7 * whole.simulation.state().u.linfty_norm());
    }
}

// A result is due in a step that was interrupted behind a part, and the run
// goes on with other steps: the first of them gives the result, also if it was
// given up once.
TEST(InterruptedSteps, LeftForOtherSteps)
{
  const auto bar = [](const double step) {
    return halved_bar(time_integration("generalized-alpha", 0.4, step), 2, "8");
  };
  CompleteRun run(bar(0.2));
  run.simulation.start(run.observers);
  run.simulation.step({.after_step = [] { return true; }, .within_step = {}});
  const double time = run.simulation.time();
  ASSERT_GT(run.simulation.parts_made(), 0u);
  const OutputTimes times{1000, 0.9 * time};
  MemoryArchive     left;
  run.simulation.save_state(left);

  for (const bool is_given_up : {false, true})
    {
      MemoryArchive archive = left;
      archive.reading       = true;
      auto other            = std::make_unique<CompleteRun>(bar(0.01));
      other->simulation.resume(other->observers, times, archive);
      if (is_given_up)
        {
          other->simulation.step(
            {.after_step = {}, .within_step = [] { return true; }});
          EXPECT_EQ(other->simulation.time(), time);
          MemoryArchive again;
          other->simulation.save_state(again);
          again.reading = true;
          other         = std::make_unique<CompleteRun>(bar(0.01));
          other->simulation.resume(other->observers, times, again);
        }
      other->simulation.step();
      EXPECT_NEAR(other->simulation.time(), time + 0.01, 1e-12);
    }
}
