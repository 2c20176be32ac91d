// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The progress: the text of a line, and the number of lines that remain.

#include <corotet/output/progress.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "support.h"

using namespace corotet;
using namespace test_output;

TEST(Progress, LineSaysHowFarTheRunIs)
{
  const StepRecord record = ModelBody::record(12, 0.25);
  EXPECT_EQ(
    progress_text(record, 0, 1, 3725),
    "step 12, time 0.25 of 1 s (25 %), Newton 2, linear 31, 1:02:05 left");
  EXPECT_EQ(progress_text(record, 0, 0.25, -1),
            "step 12, time 0.25 of 0.25 s (100 %), Newton 2, linear 31");
}

// The percentage is that of the run, whatever its start time, and is rounded
// down. With round-off, 100 times 0.29 is less than 29.
TEST(Progress, ShareIsThatOfTheRun)
{
  const auto share =
    [](const double time, const double start, const double end) {
      const std::string text =
        progress_text(ModelBody::record(1, time), start, end, -1);
      const std::size_t bracket = text.find('(');
      return text.substr(bracket, text.find(')') - bracket + 1);
    };
  EXPECT_EQ(share(-0.98, -1, 1), "(1 %)");
  EXPECT_EQ(share(-0.5, -1, 0), "(50 %)");
  EXPECT_EQ(share(-1, -3, -1), "(100 %)");
  EXPECT_EQ(share(5, 5, 5.1), "(0 %)");
  EXPECT_EQ(share(5.0999, 5, 5.1), "(99 %)");
  EXPECT_EQ(share(0.29, 0, 1), "(29 %)");
}

// A thousand steps that take no time show the first and the last line only.
TEST(Progress, QuickStepsLeaveTwoLines)
{
  const ScratchFolder scratch;
  ModelBody           body(1);
  {
    Log      log(MPI_COMM_WORLD, true);
    Progress progress(0, 10, log);
    log.open(scratch.path + "/log.txt");
    StepRecord record;
    const auto state = [&](const bool last) {
      return Snapshot{body.discretization,
                      record,
                      body.displacement,
                      body.velocity,
                      {},
                      last,
                      {},
                      {}};
    };
    progress.start(state(false));
    for (unsigned int step = 1; step <= 1000; ++step)
      {
        record.step = step;
        record.time = 0.01 * step;
        progress.step(state(step == 1000));
      }
  }
  wait_for_all();
  const std::string text = content_of(scratch.path + "/log.txt");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
  EXPECT_EQ(text.find("step 1, time 0.01 of 10 s (0 %)"), 0u) << text;
  EXPECT_NE(text.find("\nstep 1000, time 10 of 10 s (100 %), Newton 0, linear "
                      "0\n"),
            std::string::npos)
    << text;
}
