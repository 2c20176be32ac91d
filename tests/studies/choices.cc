// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The list of choices: everything that a parameter file can name.

#include <corotet/mesh/mesh_format.h>
#include <corotet/mesh/mesh_sources.h>
#include <corotet/studies/choices.h>
#include <corotet/time_integration/time_integrators.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "../source_path.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  std::vector<std::string>
  lines_of(const std::string &text)
  {
    std::vector<std::string> lines;
    std::istringstream       stream(text);
    for (std::string line; std::getline(stream, line);)
      lines.push_back(line);
    return lines;
  }

  // The line that begins with @p start; empty if there is none.
  std::string
  line_with(const std::string &start)
  {
    for (const std::string &line : lines_of(list_choices()))
      if (line.starts_with(start))
        return line;
    return "";
  }
} // namespace

TEST(Choices, FirstSentence)
{
  EXPECT_EQ(first_sentence("# A beam of 1.5 m bends.\n# Then more.\nset A\n"),
            "A beam of 1.5 m bends");
  EXPECT_EQ(first_sentence("# P = 1, 2, .., 10 N, in\n#   one go. More.\n"),
            "P = 1, 2, .., 10 N, in one go");
  EXPECT_EQ(first_sentence("# A title\n#\n# Text.\n"), "A title");
  EXPECT_EQ(first_sentence("set A = 1\n"), "");
  EXPECT_EQ(first_sentence(""), "");
  std::string words = "#";
  for (unsigned int i = 0; i < 100; ++i)
    words += " word";
  const std::string cut = first_sentence(words);
  EXPECT_LE(cut.size(), 96u);
  EXPECT_TRUE(cut.ends_with("word ...")) << cut;
}

// The list has every case that comes with corotet, and every registered name.
TEST(Choices, Everything)
{
  for (const auto &entry :
       std::filesystem::directory_iterator(source_path("parameters")))
    if (entry.path().extension() == ".prm")
      {
        const std::string name = entry.path().stem().string();
        const std::string line = line_with("  " + name + " ");
        EXPECT_GT(line.size(), 40u) << name << ": " << line;
      }
  const std::string integrators = line_with("Integrators (");
  for (const auto &candidate : time_integrators())
    EXPECT_NE(integrators.find(candidate.name), std::string::npos)
      << candidate.name;
  for (const MeshFormatDescription &format : mesh_formats())
    EXPECT_NE(
      line_with("  " + format.extensions + " ").find(format.description),
      std::string::npos)
      << format.name;
  EXPECT_NE(line_with("Laws (").find("neo-Hookean"), std::string::npos);
  EXPECT_NE(line_with("Forces").find("supports"), std::string::npos);
  EXPECT_NE(line_with("Preconditioners (").find("p-multigrid"),
            std::string::npos);
  EXPECT_EQ(line_with("Meshes ("), "Meshes (Mesh/Type): box, file, gmsh");
  for (const std::string &line : lines_of(list_choices()))
    if (line.starts_with("  "))
      {
        EXPECT_LE(line.size(), 120u) << line;
      }
}
