// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The output directory: made if it is missing, refused if it is in use, and
// emptied only of what corotet has written itself, so that nothing of the
// user's is ever lost.

#include <corotet/output/output_directory.h>

#include <gtest/gtest.h>

#include <fstream>

#include "support.h"

using corotet::InputError;
using corotet::MachineError;
using corotet::prepare_output_directory;
using namespace test_output;
namespace fs = std::filesystem;

namespace
{
  // Makes empty files, with the folders that they are in.
  void
  make_files(const std::string &folder, const std::vector<std::string> &names)
  {
    if (on_rank_0())
      for (const std::string &name : names)
        {
          const fs::path path = fs::path(folder) / name;
          fs::create_directories(path.parent_path());
          std::ofstream file(path);
        }
    wait_for_all();
  }

  std::string
  directory_refusal(const std::string &directory, const bool overwrite)
  {
    return message_of<InputError>(
      [&] { prepare_output_directory(directory, overwrite, MPI_COMM_WORLD); });
  }

  const std::vector<std::string> results{"solution.vtkhdf",
                                         "solution.vtkhdf.tmp",
                                         "solution/mesh.h5",
                                         "solution/step_000012.h5",
                                         "solution/step_1000000.h5.tmp",
                                         "solution/block_2_000000.h5",
                                         "stress_points.vtkhdf",
                                         "stress_points/mesh.h5",
                                         "stress_points/step_000012.h5",
                                         "history.csv",
                                         "summary.json",
                                         "parameters.prm",
                                         "log.txt",
                                         "checkpoint/000012.h5"};
} // namespace

TEST(OutputDirectory, IsMadeWithItsParents)
{
  const ScratchFolder scratch;
  const std::string   directory = scratch.path + "/a/b";
  prepare_output_directory(directory, false, MPI_COMM_WORLD);
  EXPECT_TRUE(fs::is_empty(directory));
  // An empty one is as good as a new one.
  prepare_output_directory(directory + "/", false, MPI_COMM_WORLD);
}

TEST(OutputDirectory, InUseIsRefused)
{
  const ScratchFolder scratch;
  make_files(scratch.path, {"history.csv"});
  EXPECT_EQ(directory_refusal(scratch.path, false),
            "the output directory '" + scratch.path +
              "' is not empty; choose another one, or set Output/Overwrite = "
              "true to remove the results in it");
  EXPECT_TRUE(fs::exists(scratch.path + "/history.csv"));
}

TEST(OutputDirectory, ResultsAreOverwritten)
{
  const ScratchFolder scratch;
  make_files(scratch.path, results);
  prepare_output_directory(scratch.path, true, MPI_COMM_WORLD);
  EXPECT_TRUE(fs::is_empty(scratch.path));
}

// One foreign file, wherever it is, keeps everything.
TEST(OutputDirectory, ForeignFilesAreNotOverwritten)
{
  for (const std::string foreign : {"thesis.tex",
                                    "solution/notes.txt",
                                    "solution/step_1.h5.bak",
                                    "checkpoint/mine",
                                    "more/history.csv"})
    {
      const ScratchFolder scratch;
      make_files(scratch.path, results);
      make_files(scratch.path, {foreign});
      const std::string message = directory_refusal(scratch.path, true);
      EXPECT_NE(message.find("which is no result of corotet; only a directory "
                             "of results can be overwritten"),
                std::string::npos)
        << message;
      for (const std::string &name : results)
        EXPECT_TRUE(fs::exists(scratch.path + "/" + name)) << name;
      EXPECT_TRUE(fs::exists(scratch.path + "/" + foreign));
    }
}

// A parameter file or a log alone may be anybody's.
TEST(OutputDirectory, UnmarkedFolderIsNotOverwritten)
{
  for (const std::string name : {"parameters.prm", "log.txt"})
    {
      const ScratchFolder scratch;
      make_files(scratch.path, {name});
      EXPECT_EQ(directory_refusal(scratch.path, true),
                "the output directory '" + scratch.path +
                  "' is not empty and holds no results of corotet; only a "
                  "directory of results can be overwritten");
      EXPECT_TRUE(fs::exists(scratch.path + "/" + name));
    }
}

// A run that failed before its first result leaves these two.
TEST(OutputDirectory, FailedRunIsOverwritten)
{
  const ScratchFolder scratch;
  make_files(scratch.path, {"parameters.prm", "log.txt"});
  prepare_output_directory(scratch.path, true, MPI_COMM_WORLD);
  EXPECT_TRUE(fs::is_empty(scratch.path));
}

TEST(OutputDirectory, LinkIsNotOverwritten)
{
  const ScratchFolder scratch, elsewhere;
  make_files(elsewhere.path, {"mesh.h5"});
  make_files(scratch.path, {"history.csv"});
  if (on_rank_0())
    fs::create_directory_symlink(elsewhere.path, scratch.path + "/solution");
  wait_for_all();
  EXPECT_NE(directory_refusal(scratch.path, true), "no error");
  EXPECT_TRUE(fs::exists(elsewhere.path + "/mesh.h5"));
}

TEST(OutputDirectory, FileIsRefused)
{
  const ScratchFolder scratch;
  make_files(scratch.path, {"file"});
  EXPECT_EQ(directory_refusal(scratch.path + "/file", true),
            "the output directory '" + scratch.path +
              "/file' is a file; a directory or a new name is allowed");
}

// Nobody can make a folder in /proc, not even root.
TEST(OutputDirectory, FailureIsTheMachines)
{
  const std::string message = message_of<MachineError>(
    [] { prepare_output_directory("/proc/corotet", false, MPI_COMM_WORLD); });
  EXPECT_EQ(message.find("the output directory '/proc/corotet' cannot be made "
                         "or emptied: "),
            0u)
    << message;
}
