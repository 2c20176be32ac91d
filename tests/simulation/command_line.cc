// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The command line. Expected values are what the arguments say; refusals are
// compared with the whole message a user gets.

#include <corotet/base/exceptions.h>
#include <corotet/base/version.h>
#include <corotet/simulation/command_line.h>

#include <gtest/gtest.h>

using namespace corotet;

namespace
{
  CommandLine
  parse(std::vector<const char *> arguments)
  {
    arguments.insert(arguments.begin(), "corotet");
    return parse_command_line(static_cast<int>(arguments.size()),
                              arguments.data());
  }

  std::string
  command_line_refusal(const std::vector<const char *> &arguments)
  {
    try
      {
        parse(arguments);
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(error.exit_status, 1);
        EXPECT_EQ(error.entry, "");
        return error.what();
      }
    return "accepted";
  }
} // namespace

TEST(CommandLine, FileOnly)
{
  const CommandLine c = parse({"a.prm"});
  EXPECT_EQ(c.parameter_file, "a.prm");
  EXPECT_TRUE(c.overrides.empty());
  EXPECT_FALSE(c.output_directory);
  EXPECT_FALSE(c.validate);
  EXPECT_FALSE(c.quiet);
  EXPECT_FALSE(c.print_parameters);
  EXPECT_FALSE(c.message);
}

TEST(CommandLine, AllOptions)
{
  const CommandLine c = parse({"--set",
                               "A/B = 1, 2",
                               "--quiet",
                               "--validate",
                               "--output",
                               "out put",
                               "--set",
                               "C=x y",
                               "a.prm"});
  EXPECT_EQ(c.parameter_file, "a.prm");
  EXPECT_EQ(c.overrides, (std::vector<std::string>{"A/B = 1, 2", "C=x y"}));
  EXPECT_EQ(c.output_directory, "out put");
  EXPECT_TRUE(c.validate);
  EXPECT_TRUE(c.quiet);
}

TEST(CommandLine, OverrideDoesNotTakeTheFileBehindIt)
{
  const CommandLine c = parse({"--set", "A = 1", "a.prm"});
  EXPECT_EQ(c.overrides, std::vector<std::string>{"A = 1"});
  EXPECT_EQ(c.parameter_file, "a.prm");
}

TEST(CommandLine, PrintParametersWithAndWithoutStyleAndFile)
{
  EXPECT_EQ(parse({"--print-parameters"}).print_parameters, "prm");
  EXPECT_EQ(parse({"--print-parameters", "json"}).print_parameters, "json");
  EXPECT_EQ(parse({"--print-parameters=markdown"}).print_parameters,
            "markdown");
  EXPECT_EQ(parse({"--print-parameters", "json"}).parameter_file, "");
  const CommandLine behind = parse({"--print-parameters", "a.prm"});
  EXPECT_EQ(behind.print_parameters, "prm");
  EXPECT_EQ(behind.parameter_file, "a.prm");
  const CommandLine before = parse({"a.prm", "--print-parameters", "--quiet"});
  EXPECT_EQ(before.print_parameters, "prm");
  EXPECT_EQ(before.parameter_file, "a.prm");
  EXPECT_TRUE(before.quiet);
}

TEST(CommandLine, HelpNamesEveryOption)
{
  const std::string help = *parse({"--help"}).message;
  for (const char *option : {"FILE",
                             "--set",
                             "--output",
                             "--validate",
                             "--print-parameters",
                             "--quiet",
                             "--version",
                             "--help"})
    EXPECT_NE(help.find(option), std::string::npos) << option << '\n' << help;
  EXPECT_EQ(parse({"-h"}).message, help);
  EXPECT_EQ(parse({"mesh", "-h"}).message, parse({"mesh", "--help"}).message);
}

TEST(CommandLine, VersionNamesProgramAndLibrary)
{
  const std::string message = *parse({"--version"}).message;
  EXPECT_EQ(message.rfind("corotet " + version + " (revision ", 0), 0)
    << message;
  EXPECT_NE(message.find("deal.II"), std::string::npos) << message;
}

TEST(CommandLine, RefusesAMissingFile)
{
  EXPECT_EQ(command_line_refusal({}),
            "command line: a parameter file is needed: corotet [OPTIONS] "
            "FILE.prm (--help lists the options)");
}

TEST(CommandLine, RefusesUnknownOptions)
{
  EXPECT_EQ(command_line_refusal({"a.prm", "--valdate"}),
            "command line: unknown option \"--valdate\"; did you mean "
            "\"--validate\"?");
  EXPECT_EQ(command_line_refusal({"a.prm", "--outptu=x"}),
            "command line: unknown option \"--outptu=x\"; did you mean "
            "\"--output\"?");
  const std::string message = command_line_refusal({"a.prm", "-j8"});
  EXPECT_EQ(message.rfind("command line: unknown option \"-j8\"; allowed are "
                          "--",
                          0),
            0)
    << message;
}

TEST(CommandLine, RefusesASecondFile)
{
  EXPECT_EQ(command_line_refusal({"a.prm", "b.prm"}),
            "command line: unexpected argument \"b.prm\"; one file is "
            "allowed");
}

TEST(CommandLine, Mesh)
{
  EXPECT_FALSE(parse({"a.prm"}).mesh);
  EXPECT_FALSE(parse({"a.prm"}).list);
  EXPECT_TRUE(parse({"--list"}).list);
  EXPECT_FALSE(parse({"a.prm"}).report);
  EXPECT_TRUE(parse({"a.prm", "--report"}).report);
  const CommandLine c = parse(
    {"mesh", "part.step", "--size", "0.5", "--degree", "2", "--out", "a.msh"});
  ASSERT_TRUE(c.mesh);
  EXPECT_EQ(c.mesh->file, "part.step");
  EXPECT_EQ(c.mesh->element_size, 0.5);
  EXPECT_EQ(c.mesh->geometry_degree, 2u);
  EXPECT_EQ(c.mesh->out, "a.msh");
  EXPECT_NE(parse({"mesh", "--help"}).message.value_or("").find("--degree"),
            std::string::npos);
  EXPECT_EQ(command_line_refusal({"mesh"}),
            "command line: a mesh or a geometry is needed: corotet mesh "
            "[OPTIONS] FILE");
  EXPECT_EQ(command_line_refusal({"mesh", "a.stp", "--sise", "2"}),
            "command line: unknown option \"--sise\"; did you mean "
            "\"--size\"?");
  EXPECT_EQ(command_line_refusal({"mesh", "a.stp", "b.stp"}),
            "command line: unexpected argument \"b.stp\"; one file is "
            "allowed");
}

TEST(CommandLine, RefusesNumbersThatMakeNoMesh)
{
  const auto check =
    [](const char *option, const char *wrong, const std::string &allowed) {
      EXPECT_EQ(command_line_refusal({"mesh", "a.stp", option, wrong}),
                std::string("command line: ") + option + ": found '" + wrong +
                  "'; allowed is " + allowed);
    };
  for (const char *const wrong :
       {"0", "-1", "nan", "inf", "1e400", "abc", "2 m"})
    check("--size", wrong, "a number > 0");
  for (const char *const wrong : {"0", "4", "two", "1.5", "nan"})
    check("--degree", wrong, "1, 2 or 3");
  for (const char *const wrong : {"0.9", "181", "nan", "abc"})
    check("--feature-angle", wrong, "a number from 1 to 180");
  EXPECT_EQ(
    parse({"mesh", "a.stp", "--feature-angle", "180"}).mesh->feature_angle,
    180);
  EXPECT_EQ(parse({"mesh", "a.stp", "--size", "1e-3"}).mesh->element_size,
            1e-3);
}

TEST(CommandLine, RefusesAnUnknownStyle)
{
  EXPECT_EQ(command_line_refusal({"--print-parameters", "xlm"}),
            "command line: \"xlm\" is no style of --print-parameters; allowed "
            "are prm, json, markdown, schema");
}

// These styles list defaults and allowed values, which do not depend on a file.
TEST(CommandLine, RefusesAFileForStylesWithoutValues)
{
  for (const std::string style : {"markdown", "schema"})
    for (const bool file_first : {false, true})
      EXPECT_EQ(command_line_refusal(
                  file_first ? std::vector<const char *>{"a.prm",
                                                         "--print-parameters",
                                                         style.c_str(),
                                                         "--set",
                                                         "A = 1"} :
                               std::vector<const char *>{"--print-parameters",
                                                         style.c_str(),
                                                         "a.prm"}),
                "command line: --print-parameters " + style +
                  ": found the file \"a.prm\"; allowed is none, as this style "
                  "says nothing of values that are set (prm and json do)");
}

TEST(CommandLine, RefusesAnOptionWithoutItsValue)
{
  const std::string message = command_line_refusal({"a.prm", "--output"});
  EXPECT_EQ(message.rfind("command line: --output", 0), 0) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}
