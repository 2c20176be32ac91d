// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The output directory: it is made if missing, refused if in use, and only
// files that corotet itself has written are removed, so that no file of the
// user is ever lost.

#include <corotet/output/directory_lock.h>
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

  // Makes these files and the mark, as a run leaves them.
  void
  make_results(const std::string &folder, const std::vector<std::string> &names)
  {
    Log                          log(MPI_COMM_WORLD, true);
    const corotet::DirectoryLock mark(folder, MPI_COMM_WORLD, log);
    make_files(folder, names);
  }

  // Whether the folder has only the mark.
  bool
  has_nothing(const std::string &folder)
  {
    return std::distance(fs::directory_iterator(folder),
                         fs::directory_iterator()) == 1 &&
           corotet::DirectoryLock::has_marked(folder);
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
                                         "checkpoint/step_000012.h5",
                                         "checkpoint/step_000012.json"};
} // namespace

TEST(OutputDirectory, IsMadeWithItsParents)
{
  const ScratchFolder scratch;
  const std::string   directory = scratch.path + "/a/b";
  prepare_output_directory(directory, false, MPI_COMM_WORLD);
  EXPECT_TRUE(fs::is_empty(directory));
  // An empty folder is as good as a new one.
  prepare_output_directory(directory + "/", false, MPI_COMM_WORLD);
}

TEST(OutputDirectory, InUseIsRefused)
{
  const ScratchFolder scratch;
  make_files(scratch.path, {"history.csv"});
  const std::string refusal = "the output directory '" + scratch.path +
                              "' is not empty; choose another one";
  EXPECT_EQ(directory_refusal(scratch.path, false), refusal);
  // Only results can be overwritten.
  make_files(scratch.path, {".corotet"});
  EXPECT_EQ(directory_refusal(scratch.path, false),
            refusal + ", or set Output/Overwrite = true to remove the results "
                      "in it");
  EXPECT_TRUE(fs::exists(scratch.path + "/history.csv"));
}

TEST(OutputDirectory, ResultsAreOverwritten)
{
  const ScratchFolder scratch;
  make_results(scratch.path, results);
  prepare_output_directory(scratch.path, true, MPI_COMM_WORLD);
  EXPECT_TRUE(has_nothing(scratch.path));
}

// One foreign file, anywhere, prevents all files from being removed.
TEST(OutputDirectory, ForeignFilesAreNotOverwritten)
{
  for (const std::string foreign : {"thesis.tex",
                                    "solution/notes.txt",
                                    "solution/step_1.h5.bak",
                                    "checkpoint/mine",
                                    "more/history.csv"})
    {
      const ScratchFolder scratch;
      make_results(scratch.path, results);
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

// Without the mark files may belong to anybody, whatever their names are.
TEST(OutputDirectory, UnmarkedFolderIsNotOverwritten)
{
  for (const std::vector<std::string> &names :
       {results, {"log.txt"}, {"history.csv", "log.txt"}, {".corotet"}})
    {
      const ScratchFolder scratch;
      make_files(scratch.path, names);
      if (names.front() == ".corotet")
        make_files(scratch.path, {"history.csv"});
      EXPECT_EQ(directory_refusal(scratch.path, true),
                "the output directory '" + scratch.path +
                  "' is not empty and holds no results of corotet; only a "
                  "directory of results can be overwritten");
      for (const std::string &name : names)
        EXPECT_TRUE(fs::exists(scratch.path + "/" + name));
    }
}

TEST(OutputDirectory, LinkIsNotOverwritten)
{
  const ScratchFolder scratch, elsewhere;
  make_files(elsewhere.path, {"mesh.h5"});
  make_results(scratch.path, {"history.csv"});
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

TEST(OutputDirectory, LinkToNothingIsRefused)
{
  const ScratchFolder scratch;
  if (on_rank_0())
    fs::create_symlink("nowhere", scratch.path + "/link");
  wait_for_all();
  EXPECT_EQ(directory_refusal(scratch.path + "/link", true),
            "the output directory '" + scratch.path +
              "/link' is a link to 'nowhere', which does not exist; make it, "
              "or choose another name");
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

// Only one run at a time can have the lock; the file that remains locks
// nothing.
TEST(DirectoryLock, KeepsOthersOut)
{
  const ScratchFolder scratch;
  const std::string   directory = scratch.path + "/run";
  Log                 log(MPI_COMM_WORLD, true);
  for (unsigned int run = 0; run < 2; ++run)
    {
      const corotet::DirectoryLock lock(directory, MPI_COMM_WORLD, log);
      const std::string            message = message_of<MachineError>([&] {
        const corotet::DirectoryLock other(directory, MPI_COMM_WORLD, log);
      });
      EXPECT_TRUE(message.starts_with("the output directory '" + directory +
                                      "' is in use by process "))
        << message;
      // A folder with the mark alone has no results.
      prepare_output_directory(directory, false, MPI_COMM_WORLD);
    }
}
