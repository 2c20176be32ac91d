// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Bulk data of Nastran in all formats of fields, and refusals: nothing that
// would change the body is left out silently.

#include <corotet/mesh/curved_cells.h>

#include <gtest/gtest.h>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  class NastranFile : public testing::Test
  {
  protected:
    SerialMesh
    read(const std::string &text) const
    {
      return read_file(folder.write("part.bdf", text));
    }

    // The message of the refusal, without the folder.
    std::string
    message(const std::string &text) const
    {
      const std::string found = refusal([&] { read(text); });
      const std::size_t file  = found.find("part.bdf");
      return file == std::string::npos ? found : found.substr(file);
    }

    TemporaryFolder folder;
  };

  const std::string start = "BEGIN BULK\n";
  const std::string end   = "ENDDATA\n";
  const std::string nodes =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n";
  // Nodes on edges; the first one is not in the middle of its edge.
  const std::string middles =
    "GRID,5,,.5,-.1,0.\nGRID,6,,.5,.5,0.\nGRID,7,,0.,.5,0.\nGRID,8,,0.,0.,.5\n"
    "GRID,9,,.5,0.,.5\nGRID,10,,0.,.5,.5\n";
  const std::string cell = "CTETRA,1,7,1,2,3,4\n";

  void
  expect_curved(const SerialMesh &mesh)
  {
    ASSERT_EQ(mesh.cells.size(), 1u);
    ASSERT_EQ(mesh.geometry_degree, 2u);
    EXPECT_EQ(mesh.curved_nodes[4], dealii::Point<3>(.5, -.1, 0));
    EXPECT_EQ(mesh.curved_nodes[8], dealii::Point<3>(.5, 0, .5));
    EXPECT_EQ(mesh.curved_nodes[9], dealii::Point<3>(0, .5, .5));
  }
} // namespace

// Fields may be free, short or long, with tabs or in lower case, and exponents
// may lack the letter.
TEST_F(NastranFile, Fields)
{
  const std::string long_nodes =
    "GRID*                  1                     0.000000000     0.000000000*\n"
    "*            0.000000000\n"
    "GRID*                  2                     1.000000000     0.000000000*\n"
    "*            0.000000000\n"
    "GRID*                  3                     0.000000000     1.000000000*\n"
    "*            0.000000000\n"
    "GRID*                  4                     0.000000000     0.000000000*\n"
    "*                   1.+0\n";
  const std::string long_cell =
    "CTETRA*                1               7               1               2*\n"
    "*                      3               4\n";
  const std::string texts[]{
    start + nodes + cell + end,
    start + nodes + "CTETRA  1       7       1       2       3       4\n" + end,
    start + nodes + "CTETRA\t1\t7\t1\t2\t3\t4\n" + end,
    "begin bulk\ngrid,1,,0.,0.,0.\ngrid,2,,10.-1,0.,0.\ngrid,3,0,,1.d0,\n"
    "grid,4,,0.,0.,1.\nctetra,1,7,1,2,3,4\nenddata\n",
    start + long_nodes + cell + end,
    start + long_nodes + long_cell + end,
    "SOL 101\nCEND\n" + start + nodes + "$ a comment\n\n" + cell + end +
      "what follows is not read\n"};
  for (const std::string &text : texts)
    EXPECT_NEAR(volume(read(text), "7"), 1 / 6., 1e-15) << text;
}

// Other lines may stand between the lines of a card.
TEST_F(NastranFile, TenNodes)
{
  const std::string all = start + nodes + middles;
  expect_curved(read(all + "CTETRA,1,7,1,2,3,4,5,6\n,7,8,9,10\n" + end));
  expect_curved(read(all +
                     "CTETRA,1,7,1,2,3,4,5,6 $ comment\n$ between\n\n"
                     ",7,8,9,10\n" +
                     end));
  expect_curved(
    read(all +
         "CTETRA         1       7       1       2       3       4       5"
         "       6+EL1\n"
         "+EL1           7       8       9      10\n" +
         end));
  EXPECT_EQ(message(all + "CTETRA,1,7,1,2,3,4,5,\n,7,8,9,10\n" + end),
            "part.bdf:12: a CTETRA has no nodes on its edges or all six of "
            "them: found 5");
}

TEST_F(NastranFile, Refusals)
{
  const std::string systems =
    ": coordinates in a system of their own (CP) are not read: found ";
  const std::string only = "; allowed are 0 and a blank, the basic system";
  EXPECT_EQ(message(start + "CORD2C,1,0,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n" +
                    "GRID,1,1,1.,90.,0.\n" + cell + end),
            "part.bdf:4" + systems + "1 in a GRID" + only);
  EXPECT_EQ(message(start + "GRDSET,,2\n" + nodes + cell + end),
            "part.bdf:2" + systems + "2 in a GRDSET" + only);
  for (const std::string solid : {"CHEXA", "CPENTA", "CPYRA", "CPYRAM"})
    EXPECT_EQ(message(start + nodes + solid + ",2,1,1,2,3,4,1\n" + cell + end),
              "part.bdf:6: cells other than tetrahedra: found " + solid +
                "; allowed is CTETRA");
  EXPECT_EQ(message(start + nodes + "CTETRA,1,7,1,2,x,4\n" + end),
            "part.bdf:6: a node of a CTETRA: found 'x'; allowed is a positive "
            "whole number");
  EXPECT_EQ(message(start + "GRID,1,,a,0.,0.\n" + end),
            "part.bdf:2: found 'a'; allowed is a finite number");
  EXPECT_EQ(message(start + nodes + end),
            "part.bdf: the mesh has no tetrahedra");
  EXPECT_EQ(message(start + nodes + "CTETRA,1,7,1,2,3,5\n" + end),
            "part.bdf: an element has the node 5, which the file does not "
            "contain");
}

// Nodes and elements that the bulk data have twice, and elements with too many
// nodes.
TEST_F(NastranFile, LeftoversAndDuplicates)
{
  EXPECT_EQ(message(start + nodes + "GRID,2,,1.,0.,1.\n" + cell + end),
            "part.bdf:6: node 2 is there already, at another place");
  EXPECT_EQ(message(start + nodes + "GRID,2,,1.,0.,0.\n" + cell + end),
            "nothing was refused");
  EXPECT_EQ(message(start + nodes + cell + "CTRIA3,1,3,1,2,3\n" + end),
            "part.bdf:7: element 1 is there already");
  EXPECT_EQ(message(start + nodes + middles +
                    "CTETRA,1,7,1,2,3,4,5,6\n,7,8,9,10,,3\n" + end),
            "part.bdf:12: a CTETRA has 4 or 10 nodes: found '3' behind them");
}

// Statements without which a part of the mesh would be missing.
TEST_F(NastranFile, RefusesWhatWouldBeMissing)
{
  for (const std::string name : {"INCLUDE 'nodes.bdf'", "INCLUDE'nodes.bdf'"})
    EXPECT_EQ(message(start + nodes + cell + name + "\n" + end),
              "part.bdf:7: other files are not read: found INCLUDE; allowed is "
              "one file with the whole mesh");
  for (const std::string card : {"=,*1,=,*1.,==", "=       *1      "})
    EXPECT_EQ(message(start + nodes + cell + card + "\n" + end),
              "part.bdf:7: cards that repeat others (=) are not read; allowed "
              "is each card written out");
}

// The log says which cards are not read, and which parts are known by their
// numbers only.
TEST_F(NastranFile, Remarks)
{
  using Known = std::vector<std::string>;
  EXPECT_TRUE(read(start + nodes + cell + end).remarks.empty());
  EXPECT_EQ(read("SOL 101\nCEND\nTITLE = a part\n" + start + nodes +
                 "CQUAD4,9,1,1,2,3,4\n" + cell + "RBE2,7,1,123,2\n" + end)
              .remarks,
            Known{"left out, as corotet reads the mesh only: CQUAD4, RBE2"});
  const SerialMesh mesh = read(start + nodes +
                               "GRID,5,,1.,1.,1.\nCTETRA,4,,1,2,3,4\n"
                               "CTETRA,8,7,2,3,4,5\nCTRIA3,6,,1,2,3\n" +
                               end);
  EXPECT_EQ(mesh.remarks,
            Known{
              "1 CTETRA have no property: each is named by its own number; "
              "1 CTRIA3 have no property: each is named by its own number"});
  EXPECT_NEAR(volume(mesh, "4"), 1 / 6., 1e-15);
  EXPECT_NEAR(area(mesh, "6"), 0.5, 1e-15);
}
