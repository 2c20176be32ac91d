// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// What the log shows and writes. Tests run without a terminal, so progress
// lines must appear nowhere.

#include <corotet/base/exceptions.h>
#include <corotet/base/log.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include "temporary_folder.h"

using namespace corotet;

namespace
{
  bool
  on_rank_0()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  // What appears on the terminal while @p action runs.
  std::string
  shown(const std::function<void()> &action)
  {
    testing::internal::CaptureStdout();
    action();
    return testing::internal::GetCapturedStdout();
  }
} // namespace

TEST(Log, WritesEarlyLinesIntoTheFileToo)
{
  const TemporaryFolder folder;
  const std::string     expected = on_rank_0() ? "early\nwarning: late\n" : "";
  const std::string     terminal = shown([&] {
    Log log(MPI_COMM_WORLD, /* quiet = */ false);
    log.line("early");
    log.open(folder / "log.txt");
    log.progress("live");
    log.warning("late");
  });
  EXPECT_EQ(terminal, expected);
  EXPECT_EQ(folder.read("log.txt"), expected);
}

TEST(Log, QuietWritesOnlyTheFile)
{
  const TemporaryFolder folder;
  const std::string     terminal = shown([&] {
    Log log(MPI_COMM_WORLD, /* quiet = */ true);
    log.open(folder / "log.txt");
    log.line("text");
  });
  EXPECT_EQ(terminal, "");
  EXPECT_EQ(folder.read("log.txt"), on_rank_0() ? "text\n" : "");
}

TEST(Log, CountsWhatIsWorthALook)
{
  Log log(MPI_COMM_WORLD, /* quiet = */ true);
  EXPECT_EQ(log.counts(), "");
  log.count("step made in parts", "steps made in parts");
  log.warning("one");
  EXPECT_EQ(log.counts(), "1 step made in parts, 1 warning");
  log.count("step made in parts", "steps made in parts");
  EXPECT_EQ(log.counts(), "2 steps made in parts, 1 warning");
}

TEST(Log, RefusesAFileThatCannotBeWritten)
{
  const TemporaryFolder folder;
  Log                   log(MPI_COMM_WORLD, /* quiet = */ true);
  // Only rank 0 opens the file, and all ranks get the error.
  EXPECT_THROW(log.open(folder / "absent/log.txt"), MachineError);
  // This file can be opened, but has no room for the lines shown before.
  log.line("early");
  EXPECT_THROW(log.open("/dev/full"), MachineError);
}
