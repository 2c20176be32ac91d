// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Programs that the library starts: found without knowing where it was built,
// run without a shell.

#include <corotet/base/programs.h>

#include <gtest/gtest.h>

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

TEST(Programs, ExitStatus)
{
  EXPECT_EQ(run_and_wait("/bin/sh", {"-c", "exit 0"}), 0);
  EXPECT_EQ(run_and_wait("/bin/sh", {"-c", "exit 3"}), 3);
  EXPECT_EQ(run_and_wait("/bin/sh", {"-c", "kill -9 $$"}), std::nullopt);
  EXPECT_NE(run_and_wait("/no such/program", {}).value_or(127), 0);
}

// As they are: no shell splits or expands them.
TEST(Programs, Arguments)
{
  const std::string text = "two words; $HOME 'quoted' *";
  EXPECT_EQ(run_and_wait("/bin/sh", {"-c", "[ \"$#\" = 2 ]", "sh", text, ""}),
            0);
  EXPECT_EQ(run_and_wait("/bin/sh",
                         {"-c", "[ \"$1\" = \"$2\" ]", "sh", text, text}),
            0);
  EXPECT_EQ(run_and_wait("/bin/sh",
                         {"-c",
                          "[ \"$1\" = 'two words; $HOME '\"'quoted'\"' *' ]",
                          "sh",
                          text}),
            0);
}
