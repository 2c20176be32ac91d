// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Entries of candidates that are not selected: refused if the choice was not
// set, else reported with their place in the file. Not reported are entries
// with their default values, as the file of a finished run sets all of them,
// and entries that something else reads.

#include <corotet/base/exceptions.h>
#include <corotet/base/unused_entries.h>

#include <gtest/gtest.h>

#include "temporary_folder.h"

using corotet::find_unused_entries;

namespace
{
  // A choice between a box and a file in a section of a parameter file.
  class Choice
  {
  public:
    Choice()
    {
      dealii::ParameterHandler &prm = parameters.handler();
      prm.enter_subsection("Mesh");
      prm.declare_entry("Type", "box", dealii::Patterns::Selection("box|file"));
      prm.enter_subsection("box");
      prm.declare_entry("Cells", "1", dealii::Patterns::Integer());
      prm.leave_subsection();
      prm.enter_subsection("file");
      prm.declare_entry("Name", "");
      prm.enter_subsection("Format");
      prm.declare_entry("Version", "4");
      prm.leave_subsection();
      prm.leave_subsection();
      // A subsection that is no candidate of the choice.
      prm.enter_subsection("names");
      prm.declare_entry("Side", "left");
      prm.leave_subsection();
      prm.leave_subsection();
    }

    std::vector<std::string>
    unused(const std::string              &content,
           const std::vector<std::string> &overrides = {},
           const std::vector<std::string> &used      = {})
    {
      folder.write("a.prm", "subsection Mesh\n" + content + "end\n");
      parameters.read(folder / "a.prm", overrides);
      return find_unused_entries(parameters, used);
    }

    corotet::ParameterFile parameters;
    TemporaryFolder        folder;
  };

  const std::string file_name = "subsection file\nset Name = x\nend\n";
} // namespace

TEST(UnusedEntries, OfSelectedCandidatesAreUsed)
{
  Choice choice;
  EXPECT_TRUE(choice
                .unused("set Type = file\n" + file_name +
                        "subsection names\nset Side = right\nend\n")
                .empty());
}

TEST(UnusedEntries, AreNamedWhereTheChoiceWasMade)
{
  Choice choice;
  EXPECT_EQ(choice.unused("set Type = box\nsubsection file\nset Name = x\n"
                          "subsection Format\nset Version = 2\nend\nend\n"),
            (std::vector<std::string>{
              choice.folder / "a.prm:4: no effect, as \"Mesh/Type\" is 'box': "
                              "Mesh/file/Name, Mesh/file/Format/Version"}));
}

TEST(UnusedEntries, AreNamedWhereTheCommandLineMadeTheChoice)
{
  Choice choice;
  EXPECT_EQ(choice.unused(file_name, {"Mesh/Type = box"}).size(), 1);
}

TEST(UnusedEntries, AreRefusedWithoutAChoice)
{
  Choice choice;
  try
    {
      choice.unused(file_name);
      FAIL() << "accepted";
    }
  catch (const corotet::InputError &error)
    {
      EXPECT_EQ(error.entry, "Mesh/file/Name");
      EXPECT_STREQ(error.what(),
                   "it would have no effect: \"Mesh/Type\" is not set, and its "
                   "default is 'box'; allowed with \"Mesh/Type = file\"");
    }
}

TEST(UnusedEntries, WithDefaultValuesDoNotMatter)
{
  Choice choice;
  EXPECT_TRUE(choice
                .unused("subsection file\nset Name =\nsubsection Format\n"
                        "set Version = 4\nend\nend\n")
                .empty());
}

TEST(UnusedEntries, ThatAreReadElsewhereAreLeftOut)
{
  Choice choice;
  EXPECT_TRUE(choice.unused(file_name, {}, {"Mesh/file"}).empty());
}
