// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Programs that the library starts: found without knowing where it was built,
// run without a shell.

#include <corotet/base/exceptions.h>
#include <corotet/base/programs.h>

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>

#include "../source_path.h"

using namespace corotet;
using namespace corotet::tests;

TEST(Programs, AreFoundFromTheProgram)
{
  const std::filesystem::path script =
    find_installed("share/corotet/scripts/draw_study");
  EXPECT_TRUE(script.is_absolute()) << script;
  EXPECT_TRUE(
    std::filesystem::equivalent(script, source_path("scripts/draw_study")));
  EXPECT_EQ(find_installed("share/no such file"), "");
}

namespace
{
  ProgramEnd
  end_of_shell(const std::string              &text,
               const std::vector<std::string> &arguments  = {},
               const double                    time_limit = 60)
  {
    std::vector<std::string> words = {"-c", text, "sh"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_for_output("/bin/sh", words, time_limit);
  }
} // namespace

TEST(Programs, ExitStatus)
{
  EXPECT_EQ(end_of_shell("exit 0").status, 0);
  EXPECT_EQ(end_of_shell("exit 3").status, 3);
  const ProgramEnd killed = end_of_shell("kill -9 $$");
  EXPECT_EQ(killed.signal, SIGKILL);
  EXPECT_FALSE(killed.has_exceeded);
  try
    {
      run_for_output("/no such/program", {}, 60);
      ADD_FAILURE() << "no error";
    }
  catch (const MachineError &error)
    {
      EXPECT_STREQ(error.what(),
                   "/no such/program: cannot be started: No such file or "
                   "directory");
    }
  EXPECT_FALSE(run_installed_script("no such script", ""));
}

// Programs get arguments as they are: no shell splits or expands them.
TEST(Programs, Arguments)
{
  const std::string text = "two words; $HOME 'quoted' *";
  EXPECT_EQ(end_of_shell("printf '%s|' \"$@\"", {text, ""}).output,
            text + "||");
}

// The limit also ends a program that has closed its output and goes on.
TEST(Programs, TimeLimit)
{
  for (const char *text : {"exec sleep 100", "exec sleep 100 >&-"})
    {
      const auto       begin = std::chrono::steady_clock::now();
      const ProgramEnd end   = end_of_shell(text, {}, 0.2);
      EXPECT_TRUE(end.has_exceeded) << text;
      EXPECT_EQ(end.signal, SIGKILL);
      // The system may be slow; sleep is not waited for.
      EXPECT_LT(std::chrono::steady_clock::now() - begin,
                std::chrono::seconds(50));
    }
  EXPECT_EQ(end_of_shell("exec >&-; sleep 0.1; exit 4").status, 4);
}
