// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Reading and listing parameter files. Values are those that the texts of the
// files say; a listing must be readable as a parameter file again.

#include <corotet/base/exceptions.h>
#include <corotet/base/parameter_listing.h>

#include <nlohmann/json.hpp>

#include <sstream>

#include "base/parameter_example.h"

using namespace corotet;

TEST(ParameterFile, ReadsPrm)
{
  Example example;
  example.parameters.read(example.folder.write("a.prm",
                                               "# comment\n"
                                               "subsection Material\n"
                                               "\tset Density = 7.8e3 # iron\n"
                                               "  set Law=corotational\n"
                                               "  subsection No parameters\n"
                                               "  end\n"
                                               "end\n"
                                               "\r\n"
                                               "SUBSECTION Mesh\n"
                                               "  set File name = a \\\n"
                                               "    b.msh\n"
                                               "  subsection Box\n"
                                               "    SET Cells (per side) = 5\n"
                                               "  end\n"
                                               "END"),
                          {});
  EXPECT_EQ(example.density, 7800);
  EXPECT_EQ(example.law, "corotational");
  EXPECT_EQ(example.file_name, "a b.msh");
  EXPECT_EQ(example.cells, 5);
}

TEST(ParameterFile, KnowsWhereEntriesWereSet)
{
  Example           example;
  const std::string file = example.folder.write("a.prm",
                                                "subsection Material\n"
                                                "  # A comment.\n"
                                                "  set Density = \\\n"
                                                "    2\n"
                                                "end\n"
                                                "subsection Mesh\n"
                                                "end\n");
  example.parameters.read(file, {" Mesh / Box/Cells (per side)=3"});
  EXPECT_EQ(example.density, 2);
  EXPECT_EQ(example.cells, 3);
  const ParameterFile &parameters = example.parameters;
  EXPECT_EQ(parameters.location("Material/Density"), file + ":3");
  EXPECT_EQ(parameters.location("Mesh"), file + ":6");
  EXPECT_EQ(parameters.location("Mesh/Box/Cells (per side)"), "--set");
  EXPECT_EQ(parameters.location("Material/Law"), file);
  EXPECT_EQ(parameters.folder() + "/a.prm", file);
  EXPECT_EQ(parameters.path(), file);
}

TEST(ParameterFile, IncludesRelativeToTheIncludingFile)
{
  Example           example;
  const std::string included =
    example.folder.write("parts/iron.prm", "set Density = 7800\n");
  example.parameters.read(example.folder.write("a.prm",
                                               "subsection Material\n"
                                               "  include parts/iron.prm\n"
                                               "end\n"),
                          {});
  EXPECT_EQ(example.density, 7800);
  EXPECT_EQ(example.parameters.location("Material/Density"), included + ":1");
}

TEST(ParameterFile, ReadsJsonShortAndInFull)
{
  Example           example;
  const std::string file =
    example.folder.write("a.json",
                         R"json({"Material": {"Density": 12.5, "Law": {
                             "value": "corotational", "documentation": "x"}},
                             "Mesh": {"Box": {"Cells (per side)": "5"}}})json");
  example.parameters.read(file, {"Material/Density = 3"});
  EXPECT_EQ(example.density, 3);
  EXPECT_EQ(example.law, "corotational");
  EXPECT_EQ(example.cells, 5);
  EXPECT_EQ(example.parameters.location("Material/Law"), file + ":2");
  EXPECT_EQ(example.parameters.location("Mesh/Box"), file + ":3");
}

// A .xml file as ParameterHandler itself prints it, with changed names.
TEST(ParameterFile, ReadsXml)
{
  for (const auto style :
       {dealii::ParameterHandler::XML, dealii::ParameterHandler::ShortXML})
    {
      Example            written;
      std::ostringstream text;
      written.parameters.handler().enter_subsection("Mesh");
      written.parameters.handler().enter_subsection("Box");
      written.parameters.handler().set("Cells (per side)", 7L);
      written.parameters.handler().leave_subsection();
      written.parameters.handler().leave_subsection();
      written.parameters.handler().print_parameters(text, style);

      Example example;
      example.parameters.read(example.folder.write("a.xml", text.str()), {});
      EXPECT_EQ(example.cells, 7);
    }
}

TEST(ParameterFile, ListsParametersInFormatsItReads)
{
  for (const std::string style : {"prm", "json"})
    {
      Example written;
      written.parameters.read(written.folder.write("a.prm", ""),
                              {"Mesh/Box/Cells (per side) = 9",
                               "Material/Law = corotational"});
      std::ostringstream text;
      written.parameters.print(text, style);

      Example example;
      example.parameters.read(example.folder.write("b." + style, text.str()),
                              {});
      EXPECT_EQ(example.cells, 9) << style;
      EXPECT_EQ(example.law, "corotational") << style;
    }
}

TEST(ParameterFile, PrmListingDocumentsEveryEntry)
{
  const Example      example;
  std::ostringstream text;
  example.parameters.print(text, "prm");
  EXPECT_EQ(text.str(),
            "subsection Material\n"
            "  # Mass per volume [kg/m^3]. [a number >= 0]\n"
            "  set Density = 1000\n"
            "\n"
            "  # Which law. [one of linear, corotational]\n"
            "  set Law     = linear\n"
            "end\n"
            "\n"
            "subsection Mesh\n"
            "  # A mesh. [a file name]\n"
            "  set File name =\n"
            "\n"
            "  subsection Box\n"
            "    # Number of cells [-]. [a whole number >= 1]\n"
            "    set Cells (per side) = 1\n"
            "  end\n"
            "end\n");
}

TEST(ParameterFile, JsonListingHasDefaultDocumentationAndPattern)
{
  const Example      example;
  std::ostringstream text;
  example.parameters.print(text, "json");
  const auto json  = nlohmann::json::parse(text.str());
  const auto entry = json.at("Mesh").at("Box").at("Cells (per side)");
  EXPECT_EQ(entry.at("value"), "1");
  EXPECT_EQ(entry.at("default_value"), "1");
  EXPECT_EQ(entry.at("documentation"), "Number of cells [-].");
  EXPECT_EQ(entry.at("pattern_description"),
            "[Integer range 1...2147483647 (inclusive)]");
  EXPECT_EQ(entry.at("allowed"), "a whole number >= 1");
  EXPECT_EQ(entry.size(), 5);
}

TEST(ParameterFile, MarkdownListingIsATablePerSection)
{
  const Example      example;
  std::ostringstream text;
  example.parameters.print(text, "markdown");
  EXPECT_EQ(text.str(),
            "## Material\n\n"
            "| Entry | Default | Allowed | Meaning |\n"
            "|---|---|---|---|\n"
            "| Density | `1000` | a number >= 0 | Mass per volume "
            "[kg/m^3]. |\n"
            "| Law | `linear` | one of linear, corotational | Which law. |\n\n"
            "## Mesh\n\n"
            "| Entry | Default | Allowed | Meaning |\n"
            "|---|---|---|---|\n"
            "| File name |  | a file name | A mesh. |\n\n"
            "## Mesh/Box\n\n"
            "| Entry | Default | Allowed | Meaning |\n"
            "|---|---|---|---|\n"
            "| Cells (per side) | `1` | a whole number >= 1 | Number of cells "
            "[-]. |\n\n");
}

// ParameterHandler writes a subsection without content as an empty text.
TEST(ParameterFile, ReadsEmptySubsectionsInJson)
{
  Example example;
  EXPECT_EQ(example.refusal("a.json",
                            R"({"Material": {"No parameters": ""},
                                "Mesh": {"File name": "", "Box": {}}})"),
            "accepted");
  EXPECT_EQ(example.refusal("a.json", R"({"Material": "1"})"),
            "a.json:1: \"Material\" is a subsection, not an entry");
}

// The written file, read again, gives the same values; the name of the mesh,
// relative to the file, still means the same mesh.
TEST(ParameterFile, EffectiveParametersReproduceTheRun)
{
  Example written;
  written.parameters.read(
    written.folder.write("cases/a.prm",
                         "subsection Mesh\n"
                         "  set File name = ../meshes/part.msh\n"
                         "end\n"),
    {"Material/Density = 0.1", "Mesh/Box/Cells (per side) = 4"});
  written.folder.write("output/a/log.txt", "");
  const std::string file = written.folder / "output/a/parameters.prm";
  written.parameters.write_effective(file);

  Example example;
  example.parameters.read(file, {});
  EXPECT_EQ(example.density, 0.1);
  EXPECT_EQ(example.cells, 4);
  EXPECT_EQ(example.file_name, "../../meshes/part.msh");
}

TEST(ParameterFile, RefusesFileNamesThatCouldNotBeReadAgain)
{
  Example example;
  example.parameters.read(example.folder.write("c#/a.prm",
                                               "subsection Mesh\n"
                                               "  set File name = part.msh\n"
                                               "end\n"),
                          {});
  // A file in the same folder has the name without "c#/".
  example.parameters.check_effective(example.folder / "c#/b.prm");
  try
    {
      example.parameters.check_effective(example.folder / "b.prm");
      FAIL() << "nothing is refused";
    }
  catch (const InputError &error)
    {
      EXPECT_EQ(error.entry, "Mesh/File name");
      EXPECT_STREQ(error.what(),
                   "found 'part.msh', which is 'c#/part.msh' as seen from the "
                   "results, what parameters.prm there, which repeats the run, "
                   "cannot say; allowed are folders whose names are text in "
                   "UTF-8 without #, tabs and line breaks");
    }
}

TEST(ParameterFile, RefusesToWriteIntoAFolderThatIsNotThere)
{
  const Example example;
  EXPECT_THROW(example.parameters.write_effective(example.folder /
                                                  "absent/parameters.prm"),
               MachineError);
}

// The texts on the left are those deal.II's patterns give.
TEST(ParameterListing, DescribesPatternsInWords)
{
  using namespace dealii::Patterns;
  EXPECT_EQ(describe_pattern(Double().description()), "a number");
  EXPECT_EQ(describe_pattern(Double(0.5, 2).description()),
            "a number from 0.5 to 2");
  EXPECT_EQ(describe_pattern(Double(Double::min_double_value, 2).description()),
            "a number <= 2");
  EXPECT_EQ(describe_pattern(Integer().description()), "a whole number");
  EXPECT_EQ(describe_pattern(Integer(1, 3).description()),
            "a whole number from 1 to 3");
  EXPECT_EQ(describe_pattern(Selection("a|b").description()), "one of a, b");
  EXPECT_EQ(describe_pattern(Selection("a").description()), "only a");
  EXPECT_EQ(describe_pattern(Bool().description()), "true or false");
  EXPECT_EQ(describe_pattern(Anything().description()), "a text");
  EXPECT_EQ(describe_pattern(FileName().description()), "a file name");
  EXPECT_EQ(describe_pattern(DirectoryName().description()), "a folder name");
  EXPECT_EQ(describe_pattern(List(Double(0), 3, 3, ";").description()),
            "3 values separated by \";\", each a number >= 0");
  EXPECT_EQ(describe_pattern(List(Selection("a|b")).description()),
            "any number of values separated by \",\", each one of a, b");
  EXPECT_EQ(describe_pattern(List(Integer(0), 1, 2).description()),
            "1 to 2 values separated by \",\", each a whole number >= 0");
  EXPECT_EQ(describe_pattern(Map(Anything(), FileName()).description()),
            "any number of pairs separated by \",\", each a text and a file "
            "name separated by \":\"");
  EXPECT_EQ(describe_pattern("[Something new]"), "[Something new]");
}
