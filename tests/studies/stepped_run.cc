// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// When a run in single steps is over, and that its results remain then.

#include <corotet/base/exceptions.h>
#include <corotet/studies/stepped_run.h>

#include <deal.II/base/exceptions.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>

#include "body.h"
#include "temporary_folder.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // A bar whose law has no stress in flat cells, and whose end moves to the
  // other side of its support in six load steps: the second or third moves too
  // far.
  const std::string bar =
    box_mesh("1, 1, 1", "1, 1, 1") + material_type("neo-Hookean") +
    material_text(1e6) + fixed("x-min") + displacements("x-max: -3*t; 0; 0") +
    section("Time integration",
            {{"Type", "static"},
             {"Maximum halvings", 0},
             section("static",
                     {{"Load steps", 6}, {"Proportional loading", false}})});

  CommandLine
  command_in(const TemporaryFolder &folder)
  {
    CommandLine command;
    command.parameter_file   = folder.write("bar.prm", bar);
    command.output_directory = folder / "run";
    command.quiet            = true;
    return command;
  }

  std::string
  text_of(const std::string &file)
  {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
} // namespace

TEST(SteppedRun, IsOverAfterAFailedStep)
{
  const TemporaryFolder folder;
  SteppedRun            run(command_in(folder), MPI_COMM_SELF);
  EXPECT_THROW(
    {
      while (!run.is_done())
        run.step();
    },
    ComputationError);
  EXPECT_LT(run.time(), 1);
  EXPECT_TRUE(run.is_done());
  const std::string summary = text_of(folder / "run/summary.json");
  EXPECT_EQ(nlohmann::json::parse(summary).at("status"), "failed");
  run.finish();
  EXPECT_EQ(text_of(folder / "run/summary.json"), summary);
  EXPECT_THROW(run.step(), std::logic_error);
}

TEST(SteppedRun, IsOverWhenItIsFinished)
{
  const TemporaryFolder folder;
  SteppedRun            run(command_in(folder), MPI_COMM_SELF);
  run.step();
  EXPECT_FALSE(run.is_done());
  run.finish();
  EXPECT_TRUE(run.is_done());
  const std::string summary = text_of(folder / "run/summary.json"),
                    history = text_of(folder / "run/history.csv");
  EXPECT_EQ(nlohmann::json::parse(summary).at("status"), "done");
  EXPECT_THROW(run.step(), std::logic_error);
  run.finish();
  EXPECT_EQ(text_of(folder / "run/summary.json"), summary);
  EXPECT_EQ(text_of(folder / "run/history.csv"), history);
}
