// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Input files of Abaqus and CalculiX: what is read from them, and the messages
// where they cannot be used.

#include <corotet/base/text.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/mesh_target.h>
#include <corotet/mesh/used_names.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "abaqus.h"

using namespace corotet;
using namespace corotet::tests;

// Sets can be defined in several ways, and may overlap.
TEST_F(AbaqusFile, SetsAndSurfaces)
{
  SerialMesh mesh = read("*HEADING\nA body, of two cells\n" + nodes + cells +
                         "*elset, elset=\"Second One\"\n 9,\n"
                         "*ELSET, ELSET=both, GENERATE\n 1, 100, 2\n"
                         "*ELSET, ELSET=again\n SECOND ONE, 7\n"
                         "*NSET, NSET=Floor, GENERATE\n10, 30, 10\n"
                         "*NSET,\n** a comment\nNSET=part of it\n FLOOR, 50\n"
                         "*NSET, NSET=two\n10, 50\n"
                         "*SURFACE, NAME=side\n 7, S2\n 7, S4\n"
                         "*SURFACE, NAME=outside, TYPE=ELEMENT\n Body,\n"
                         "*SURFACE, NAME=nodes, TYPE=NODE\n 10,\n20,\n Floor\n"
                         "*MATERIAL, NAME=steel\n*ELASTIC\n 2e11, 0.3\n");
  check_mesh(mesh);
  ASSERT_EQ(mesh.cells.size(), 2u);
  EXPECT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(known_regions(mesh),
            (Known{"Body", "Second One", "again", "both"}));
  // The volumes are the determinants 1 and 2 over six.
  EXPECT_NEAR(volume(mesh, "Body"), 0.5, 1e-15);
  EXPECT_NEAR(volume(mesh, "Second One"), 1 / 3., 1e-15);
  EXPECT_NEAR(volume(mesh, "both"), 0.5, 1e-15);
  EXPECT_NEAR(volume(mesh, "again"), 0.5, 1e-15);

  // The areas are those of right triangles with legs of 1, and of three faces
  // of the other cell, with edges of sqrt(2).
  EXPECT_NEAR(area(mesh, "Floor"), 0.5, 1e-15);
  EXPECT_NEAR(area(mesh, "nodes"), 0.5, 1e-15);
  EXPECT_NEAR(area(mesh, "part of it"), 0.5 + std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(area(mesh, "side"), 1, 1e-15);
  EXPECT_NEAR(area(mesh, "outside"), 1.5 + 1.5 * std::sqrt(3.), 1e-15);
  const std::string remarks = join(mesh.remarks, "\n");
  EXPECT_EQ(remarks.find("nodes of the set"), std::string::npos) << remarks;
  // The two nodes of this set have no common edge, so they are corners.
  EXPECT_EQ(MeshNames("corner", mesh.corner_names).known(), Known{"two"});
  EXPECT_EQ(mesh.corners.size(), 2u);
  EXPECT_TRUE(mesh.edges.empty());
  EXPECT_NE(remarks.find("*ELASTIC, *MATERIAL"), std::string::npos);
}

// Cells of no set are known by a number, also in meshes that are written.
TEST_F(AbaqusFile, TheRestHasANumber)
{
  SerialMesh mesh = read(nodes + "*ELEMENT, type=C3D4\n7, 10, 20, 30, 40\n"
                                 "9, 20, 30, 40, 50\n*ELSET, ELSET=far\n9\n");
  check_mesh(mesh);
  // Unnamed regions get their numbers as in a run.
  mesh.regions = UsedNames(mesh).regions;
  std::vector<SerialMesh> meshes{mesh};
  for (const char *const file : {"two.msh", "two.h5"})
    {
      write_mesh(folder / file, mesh);
      meshes.push_back(read_file(folder / file));
    }
  for (const SerialMesh &one : meshes)
    {
      // gmsh has no group 0: "0" comes back as the name of another group, so
      // the order of names may differ.
      Known known = known_regions(one);
      std::sort(known.begin(), known.end());
      EXPECT_EQ(known, (Known{"0", "far"}));
      EXPECT_NEAR(volume(one, "far"), 1 / 3., 1e-15);
      EXPECT_NEAR(volume(one, "0"), 1 / 6., 1e-15);
    }
}

// Elements that are triangles or lines name boundaries and edges. In a file
// with elements of ten nodes, cells are curved where edges are bent; a line
// that ends with a comma is continued.
TEST_F(AbaqusFile, CurvedCellsAndTriangles)
{
  const std::string text =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,.5,0,-0.05\n6,.5,.5,0\n"
    "7,0,.5,0\n8,0,0,.5\n9,.5,0,.5\n10,0,.5,.5\n"
    "*ELEMENT, TYPE=C3D10M, ELSET=all\n1, 1, 2, 3, 4, 5,\n 6, 7, 8,\n9, 10\n"
    "*ELEMENT, TYPE=CPS6, ELSET=bottom\n2, 1, 2, 3, 5, 6, 7\n"
    "*ELEMENT, TYPE=T3D3, ELSET=edge\n3, 1, 5, 2\n"
    "*ELEMENT, TYPE=B32, ELSET=beam\n4, 1, 7, 3\n";
  const SerialMesh mesh = read(text);
  ASSERT_EQ(mesh.geometry_degree, 2u);
  ASSERT_EQ(mesh.curved_nodes.size(), 10u);
  EXPECT_EQ(mesh.curved_nodes[4], dealii::Point<3>(.5, 0, -0.05));
  EXPECT_EQ(mesh.curved_nodes[9], dealii::Point<3>(0, .5, .5));
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_NEAR(area(mesh, "bottom"), 0.5, 1e-15);
  EXPECT_EQ(MeshNames("edge", mesh.edge_names).known(),
            (Known{"beam", "edge"}));
  EXPECT_EQ(mesh.edges.size(), 2u);
  std::set<std::array<unsigned int, 2>> ends;
  for (const SerialMesh::Edge &edge : mesh.edges)
    ends.insert(edge.vertices);
  EXPECT_EQ(ends, (std::set<std::array<unsigned int, 2>>{{{0, 1}}, {{0, 2}}}));
  EXPECT_TRUE(mesh.remarks.empty());
}

// Four tetrahedra around an edge that is inside of the body: the nodes at its
// ends are corners of the surface, but the edge is not on it.
TEST_F(AbaqusFile, EdgeInsideOfTheBody)
{
  const SerialMesh mesh =
    read("*NODE\n1,1,0,0\n2,0,1,0\n3,-1,0,0\n4,0,-1,0\n5,0,0,1\n6,0,0,-1\n"
         "*ELEMENT, TYPE=C3D4\n1,1,2,6,5\n2,2,3,6,5\n3,3,4,6,5\n4,4,1,6,5\n"
         "*NSET, NSET=poles\n5, 6\n");
  EXPECT_EQ(MeshNames("corner", mesh.corner_names).known(), Known{"poles"});
  EXPECT_EQ(mesh.corners.size(), 2u);
  EXPECT_TRUE(mesh.edges.empty());
}

// Names in quotes may have commas.
TEST_F(AbaqusFile, NamesWithCommas)
{
  const SerialMesh mesh =
    read(nodes + "*ELEMENT, TYPE=C3D4, ELSET=\"my set, left\"\n"
                 "7, 10, 20, 30, 40\n"
                 "*ELEMENT, TYPE=C3D4, ELSET = \"my set, right\"\n"
                 "9, 20, 30, 40, 50\n*ELSET, ELSET=5\" pipe\n"
                 "\"my set, left\", 9\n");
  EXPECT_EQ(known_regions(mesh),
            (Known{"5\" pipe", "my set, left", "my set, right"}));
  EXPECT_NEAR(volume(mesh, "my set, left"), 1 / 6., 1e-15);
  EXPECT_NEAR(volume(mesh, "5\" pipe"), 0.5, 1e-15);
}

// Rigid surfaces, which have a shape of their own, are left out; beams with
// cubic displacements have two nodes.
TEST_F(AbaqusFile, RigidSurfacesAndBeams)
{
  const SerialMesh mesh =
    read(nodes + cells +
         "*ELEMENT, TYPE=B33, ELSET=rod\n11, 10, 20\n"
         "*SURFACE, TYPE=CYLINDER, NAME=die\nSTART, 0., 0.\nLINE, 1., 0.\n"
         "*SURFACE, NAME=front\nBody, S1\n");
  EXPECT_EQ(mesh.cells.size(), 2U);
  EXPECT_EQ(MeshNames("edge", mesh.edge_names).known(), Known{"rod"});
  EXPECT_EQ(MeshNames("boundary", mesh.boundaries).known(), Known{"front"});
  ASSERT_FALSE(mesh.remarks.empty());
  EXPECT_NE(mesh.remarks.back().find(
              "left out, as corotet reads the mesh only: *SURFACE, "
              "TYPE=CYLINDER"),
            std::string::npos)
    << mesh.remarks.back();
}

// A set of nodes may be all nodes of a set of elements.
TEST_F(AbaqusFile, NodesOfElements)
{
  const std::string start =
    nodes + cells +
    "*ELSET, ELSET=one\n7\n*ELEMENT, TYPE=S3, ELSET=side\n"
    "11, 20, 30, 40\n";
  const SerialMesh mesh = read(start + "*NSET, NSET=of one, ELSET=one\n"
                                       "*NSET, NSET=of side, ELSET=SIDE\n50\n");
  // The areas are those of three right triangles with legs of 1, and of three
  // faces of the other cell.
  EXPECT_NEAR(area(mesh, "of one"), 1.5, 1e-14);
  EXPECT_NEAR(area(mesh, "of side"), 1.5 * std::sqrt(3.), 1e-14);
  EXPECT_EQ(message(start + "*NSET, NSET=a, ELSET=two\n"),
            "part.inp:15: there is no set of elements 'two' before this line");
}

// An edge whose ends are in the set, but which belongs to none of the set's
// faces, is in the set as well: here one between the side x = 0 and the
// triangle at z = 0, and one to a single node.
TEST_F(AbaqusFile, EdgesBetweenFacesOfASet)
{
  const std::string text =
    "*NODE\n" + two_cubes::node_lines([](const int number, const auto &x) {
      return fmt::format("{}, {}\n", number, fmt::join(x, ", "));
    }) +
    "*ELEMENT, TYPE=C3D4\n" +
    two_cubes::element_lines(
      [](const int number, const int, const std::vector<int> &of_element) {
        return of_element.size() < 4 ?
                 "" :
                 fmt::format("{}, {}\n", number, fmt::join(of_element, ", "));
      });
  // Nodes 1, 4, 7 and 10 are on the side x = 0; 2, 3 and 6 on the side z = 0.
  const SerialMesh both = read(text + "*NSET, NSET=s\n1, 4, 7, 10, 2, 3, 6\n");
  EXPECT_NEAR(area(both, "s"), 1.5, 1e-14);
  ASSERT_EQ(both.edges.size(), 1u);
  EXPECT_EQ(both.vertices[both.edges[0].vertices[0]][0] +
              both.vertices[both.edges[0].vertices[1]][0],
            1);
  EXPECT_TRUE(both.corners.empty());
  const SerialMesh one = read(text + "*NSET, NSET=s\n1, 4, 7, 10, 2\n");
  EXPECT_EQ(one.edges.size(), 1u);
  // A set of whole faces has no further edges.
  EXPECT_TRUE(read(text + "*NSET, NSET=s\n1, 4, 7, 10\n").edges.empty());
}

TEST_F(AbaqusFile, IncludedFiles)
{
  folder.write("nodes.txt", nodes);
  EXPECT_EQ(read("*INCLUDE, INPUT=nodes.txt\n" + cells).cells.size(), 2u);
  folder.write("sub/data.txt", "10,0,0,0\n20,1,0,0\n30,0,1,0\n40,0,0,1\n");
  EXPECT_EQ(read("*NODE, INPUT=sub/data.txt\n50,1,1,1\n" + cells).cells.size(),
            2u);
  // A file can be included between a keyword and its data, and within the data.
  EXPECT_NEAR(area(read("*NODE, NSET=all\n*INCLUDE, INPUT=sub/data.txt\n"
                        "50,1,1,1\n" +
                        cells),
                   "all"),
              1.5 + 1.5 * std::sqrt(3.),
              1e-14);
  EXPECT_EQ(message("*INCLUDE, INPUT=part.inp\n"),
            "part.inp:1: found files that include each other 20 levels deep; "
            "do they include themselves?");
  EXPECT_EQ(message("*INCLUDE, INPUT=../other.inp\n"),
            "part.inp:1: found the file '../other.inp' outside of the folder "
            "of the first one; allowed are files in it or below it");
  EXPECT_EQ(message("*INCLUDE, INPUT=none.inp\n"),
            "part.inp:1: there is no such file: found 'none.inp'");
}

// Messages name a wrong line by its number, and elements that are no tetrahedra
// by their count.
TEST_F(AbaqusFile, Refusals)
{
  const std::pair<std::string, std::string> cases[] = {
    {"1, 2\n",
     ":1: found '1, 2' before the first keyword; needed is one like "
     "*NODE"},
    {nodes, ": the mesh has no tetrahedra"},
    {nodes + cells +
       "*ELEMENT, TYPE=C3D8\n1,10,20,30,40,50,\n10,20,30\n"
       "*ELEMENT, TYPE=S4\n2,10,20,30,40\n3,10,20,30,40\n",
     ": cells other than tetrahedra: found 1 of the type 'C3D8', 2 of the type "
     "'S4'; allowed are C3D4 and C3D10 with their variants, and triangles and "
     "lines, which give their names to faces and nodes"},
    {"*NODE\n1\n",
     ":2: a node is a number and three coordinates: found 1 fields"},
    {"*NODE\n1, 0, x, 0\n", ":2: found 'x'; allowed is a finite number"},
    {"*NODE\n1, 0, 1e999, 0\n",
     ":2: found '1e999'; allowed is a finite number"},
    {"*NODE\n1.5, 0, 0, 0\n",
     ":2: found '1.5'; allowed is a positive whole number"},
    {"*NODE\n1, 0, 0, 0\n1, 0, 0, 1\n",
     ":3: node 1 is there already, at another place"},
    {"*NODE, SYSTEM=C\n",
     ":1: found the coordinate system 'C'; allowed is R, rectangular"},
    {"*ELEMENT\n",
     ":1: *ELEMENT has no name: found no value of TYPE; needed is 'TYPE=...'"},
    {nodes + "*ELEMENT, TYPE=C3D4\n1, 10, 20, 30\n",
     ":9: an element of the type 'C3D4' has 4 nodes: found 3"},
    {nodes + "*ELEMENT, TYPE=C3D4\n1, 10, 20, 30,\n",
     ":8: the last element of this *ELEMENT has too few nodes: found 3; needed "
     "are 4"},
    {nodes + "*ELEMENT, TYPE=C3D4\n1, 10, 20, 30, 41\n",
     ":9: there is no node 41 before this line"},
    {nodes + cells + "7, 10, 20, 30, 40\n", ":11: element 7 is there already"},
    {nodes + "*ELEMENT, TYPE=C3D4" + std::string(1'000'000, 'A') +
       "\n1,10,20,30,40\n",
     ": cells other than tetrahedra: found 1 of the type 'C3D4" +
       std::string(281, 'A') +
       "... (1000020 characters); allowed are C3D4 and C3D10 with their "
       "variants, and triangles and lines, which give their names to faces and "
       "nodes"},
    {nodes + cells + "*NSET, NSET=a\n12\n",
     ":12: there is no node 12 before this line"},
    {cells + nodes, ":2: there is no node 10 before this line"},
    {nodes + cells + "*ELSET, ELSET=a\nbodi\n",
     ":12: there is no element and no set of elements 'bodi' before this line"},
    {nodes + cells + "*SURFACE, NAME=a\nbody, S5\n",
     ":12: found the face 'S5'; allowed are S1, S2, S3 and S4"},
    {nodes + cells + "*SURFACE, NAME=a, TYPE=CUTTING SURFACE\n",
     ":11: found a surface of the type 'CUTTING SURFACE'; allowed are ELEMENT "
     "and NODE"},
    {nodes + cells + "*NSET, NSET=a, GENERATE\n5, 3\n",
     ":12: found the last number, 3, before the first one, 5"},
    {"*PART, NAME=a\n*END PART\n*PART, NAME=A\n",
     ":3: found a second part 'A'; the first one begins in line 1"},
    {"*NGEN\n1, 2\n",
     ":1: found *NGEN, which is not supported; allowed are nodes and elements "
     "that are written out"},
    {"*PART, NAME=a\n", ":1: found *PART without *END PART"},
    {"*INSTANCE, NAME=a, PART=b\n",
     ":1: there is no part 'b' before this line"},
    {"*\n", ":1: found an asterisk without a keyword"},
    {std::string("*NODE\n1,\0,0\n", 12),
     ":2: found a byte of zero: is this a text file?"}};
  for (const auto &[text, expected] : cases)
    EXPECT_EQ(message(text), "part.inp" + expected);
  EXPECT_EQ(message(nodes + cells +
                    "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,.5,0,0\n"
                    "6,.5,.5,0\n7,0,.5,0\n8,0,0,.5\n9,.5,0,.5\n11,0,.5,.5\n"
                    "*ELEMENT, TYPE=C3D10\n1,1,2,3,4,5,6,7,8,9,11\n"),
            "part.inp: tetrahedra of several degrees: found 2 with 4 nodes and "
            "1 with 10; one of these is allowed");
}

// Sets whose size would double with each line, and files that are included
// again and again, are refused before they exhaust the machine.
TEST_F(AbaqusFile, Explosions)
{
  std::string text = nodes + cells + "*NSET, NSET=a\n10, 20, 30, 40\n";
  for (unsigned int i = 0; i < 40; ++i)
    text += "a, a\n";
  EXPECT_NE(message(text).find("have more members than there is room for"),
            std::string::npos);

  folder.write("b.inp", "** nothing\n");
  text.clear();
  for (unsigned int i = 0; i < 1001; ++i)
    text += "*INCLUDE, INPUT=b.inp\n";
  EXPECT_EQ(message(text),
            "part.inp:1001: found more than 1000 included files");
}
