// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Meshes from gmsh: all formats of one body agree with each other and with the
// exact volume and areas; messages about files that cannot be used name them.

#include <corotet/mesh/check_mesh.h>

#include <gmsh.h>
#include <gtest/gtest.h>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  using Names = std::map<unsigned int, std::string>;

  // Two bricks of 1 x 1 x 1 and 2 x 1 x 1 that share their interface.
  const std::string bricks = R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 2, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
e = 1e-3;
left()   = Surface In BoundingBox{-e, -e, -e, e, 1 + e, 1 + e};
middle() = Surface In BoundingBox{1 - e, -e, -e, 1 + e, 1 + e, 1 + e};
right()  = Surface In BoundingBox{3 - e, -e, -e, 3 + e, 1 + e, 1 + e};
Physical Volume("small", 4) = {1};
Physical Volume(17) = {2};
Physical Surface("left", 4) = {left()};
Physical Surface("middle", 8) = {middle()};
Physical Surface(30) = {right()};
Mesh.MeshSizeMin = 0.4;
Mesh.MeshSizeMax = 0.4;
)";

  // The text of a mesh file of version 2.2 in ASCII.
  std::string
  msh(const std::string &nodes, const std::string &elements)
  {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + nodes +
           "$EndNodes\n$Elements\n" + elements + "$EndElements\n";
  }

  // The nodes of the unit tetrahedron, with numbers that leave gaps.
  const std::string unit_nodes =
    "4\n10 0 0 0\n2000000 1 0 0\n300 0 1 0\n40000 0 0 1\n";

  void
  expect_bricks(SerialMesh mesh)
  {
    check_mesh(mesh);
    EXPECT_EQ(mesh.regions.names, (Names{{4, "small"}, {17, ""}}));
    EXPECT_EQ(mesh.boundaries.names,
              (Names{{4, "left"}, {8, "middle"}, {30, ""}}));
    // Sides are plane, so volumes are exact to the round-off of some hundred
    // terms.
    EXPECT_NEAR(region_volumes(mesh).at(4), 1, 1e-13);
    EXPECT_NEAR(region_volumes(mesh).at(17), 2, 1e-13);
    EXPECT_NEAR(boundary_areas(mesh).at(4), 1, 1e-13);
    EXPECT_NEAR(boundary_areas(mesh).at(30), 1, 1e-13);
    EXPECT_EQ(boundary_areas(mesh).size(), 2u);
    ASSERT_EQ(mesh.remarks.size(), 1u);
    EXPECT_NE(mesh.remarks[0].find("boundary 'middle' has "),
              std::string::npos);
    EXPECT_NE(mesh.remarks[0].find(" faces inside the body; they are ignored"),
              std::string::npos);
  }

  std::string
  message(const std::string &file)
  {
    return refusal([&] { read_gmsh(file); });
  }
} // namespace

// check_mesh() drops the named surface between the bricks.
TEST(GmshMesh, Geometry)
{
  const TemporaryFolder folder;
  const std::string     geometry = folder.write("bricks.geo", bricks);
  const SerialMesh      mesh =
    read_gmsh("bricks.geo", std::filesystem::path(geometry).parent_path());
  EXPECT_EQ(mesh.origin, folder / "bricks.geo");
  expect_bricks(mesh);
}

// gmsh itself writes the mesh of one geometry in every format; each holds the
// same cells.
TEST(GmshMesh, AllFormats)
{
  const TemporaryFolder folder;
  const std::string     geometry = folder.write("bricks.geo", bricks);
  const std::size_t     n_cells  = read_gmsh(geometry).cells.size();
  for (const double version : {2.2, 4.1})
    for (const int binary : {0, 1})
      {
        const std::string file = folder / "bricks.msh";
        gmsh::initialize(0, nullptr, false, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::open(geometry);
        gmsh::model::mesh::generate(3);
        gmsh::option::setNumber("Mesh.MshFileVersion", version);
        gmsh::option::setNumber("Mesh.Binary", binary);
        gmsh::write(file);
        gmsh::finalize();

        SCOPED_TRACE(testing::Message() << version << " binary " << binary);
        const SerialMesh mesh = read_gmsh(file);
        EXPECT_EQ(mesh.cells.size(), n_cells);
        expect_bricks(mesh);
      }
}

// Halving the target size makes about eight times as many cells (somewhat fewer
// while many of them are at the surface).
TEST(GmshMesh, ElementSize)
{
  const TemporaryFolder folder;
  const std::string     file = folder.write("bricks.geo", bricks);
  EXPECT_EQ(read_gmsh(file, "", "0.4").cells.size(),
            read_gmsh(file).cells.size());
  const double     coarse = read_gmsh(file, "", "0.2").cells.size();
  const SerialMesh fine   = read_gmsh(file, "", "0.1");
  EXPECT_GT(fine.cells.size() / coarse, 6);
  EXPECT_LT(fine.cells.size() / coarse, 9);
  expect_bricks(fine);
}

// gmsh scales what it writes.
TEST(GmshMesh, ScalingFactor)
{
  const TemporaryFolder folder;
  const SerialMesh      mesh =
    read_gmsh(folder.write("box.geo",
                           "SetFactory(\"OpenCASCADE\");\n"
                           "Mesh.ScalingFactor = 0.5;\n"
                           "Box(1) = {0, 0, 0, 1, 2, 3};\n"));
  EXPECT_NEAR(total(region_volumes(mesh)), 6 / 8., 1e-12);
}

// Straight cells along a curved surface are remarked on, also if they have as
// many nodes as curved cells.
TEST(GmshMesh, StraightCellsOfTenNodes)
{
  const TemporaryFolder    folder;
  std::vector<std::string> remarks[2];
  for (const int order : {1, 2})
    {
      const std::string file = folder / "rod.msh";
      write_shapes(file, [&] {
        gmsh::model::occ::addCylinder(0, 0, 0, 0, 0, 1, 1);
        gmsh::model::occ::synchronize();
        gmsh::option::setNumber("Mesh.MeshSizeMax", 0.4);
        gmsh::option::setNumber("Mesh.SecondOrderLinear", 1);
        gmsh::option::setNumber("Mesh.ElementOrder", order);
        gmsh::model::mesh::generate(3);
      });
      const SerialMesh mesh = read_gmsh(file);
      EXPECT_EQ(mesh.geometry_degree, 1u);
      remarks[order - 1] = mesh.remarks;
    }
  EXPECT_EQ(remarks[0].size(), 1u);
  EXPECT_EQ(remarks[0], remarks[1]);
}

// Without physical groups everything is region 0 and there are no boundaries.
TEST(GmshMesh, NoPhysicalGroups)
{
  const TemporaryFolder folder;
  SerialMesh            mesh = read_gmsh(folder.write("box.geo",
                                           "SetFactory(\"OpenCASCADE\");\n"
                                                      "Box(1) = {0, 0, 0, 1, 2, 3};\n"));
  check_mesh(mesh);
  EXPECT_NEAR(region_volumes(mesh).at(0), 6, 1e-12);
  EXPECT_TRUE(mesh.regions.names.empty());
  EXPECT_TRUE(mesh.boundaries.names.empty());
  EXPECT_TRUE(mesh.faces.empty());
}

TEST(GmshMesh, CellsOfNoPhysicalVolumeAreLeftOut)
{
  const TemporaryFolder folder;
  SerialMesh            mesh =
    read_gmsh(folder.write("two.geo",
                           "SetFactory(\"OpenCASCADE\");\n"
                           "Box(1) = {0, 0, 0, 1, 1, 1};\n"
                           "Box(2) = {5, 0, 0, 1, 1, 1};\n"
                           "Physical Volume(\"a\", 1) = {1};\n"));
  check_mesh(mesh);
  EXPECT_NEAR(mesh_quality(mesh).volume, 1, 1e-13);
  ASSERT_EQ(mesh.remarks.size(), 1u);
  EXPECT_NE(mesh.remarks[0].find(" tetrahedra belong to no physical volume, "
                                 "though others do; they are left out"),
            std::string::npos);
}

// Numbers of nodes need not be consecutive, and the node 5 belongs to nothing.
TEST(GmshMesh, SparseAndUnusedNodes)
{
  const TemporaryFolder folder;
  SerialMesh            mesh =
    read_gmsh(folder.write("sparse.msh",
                           msh("5\n5 9 9 9\n" + unit_nodes.substr(2),
                               "1\n77 4 2 3 1 10 2000000 300 40000\n")));
  check_mesh(mesh);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_NEAR(region_volumes(mesh).at(3), 1. / 6, 1e-16);
  const SerialMesh large = read_gmsh(
    folder.write("large.msh",
                 msh("4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n5000000000 0 0 1\n",
                     "1\n77 4 2 3 1 1 2 3 5000000000\n")));
  EXPECT_EQ(large.vertices.size(), 4u);
}

TEST(GmshMesh, FileNames)
{
  const TemporaryFolder folder;
  EXPECT_EQ(message(""),
            "Mesh/gmsh/File: no mesh file: found an empty name; give the name "
            "of a .msh or .geo file, say");
  EXPECT_EQ(refusal([] { read_gmsh("../c.msh", "/nowhere/b"); }),
            "Mesh/gmsh/File: there is no mesh file: found '/nowhere/c.msh'");
  const std::string file = folder.write("x.mov", "");
  EXPECT_EQ(
    message(file),
    "Mesh/gmsh/File: the kind of mesh file is unknown: found '" + file +
      "'; allowed are .msh, .geo, .step, .stp, .iges, .igs, .brep, .stl, "
      ".ply, .obj, .off, "
      ".inp, .bdf, .nas, .unv, .vtk, .vtu, .mesh, .cgns, .med, .rmed, .h5");
}

// The element size of a finished mesh is fixed; an entry that asks for another
// one must not be ignored silently.
TEST(GmshMesh, ElementSizeOfAMesh)
{
  EXPECT_EQ(refusal(
              [] { read_gmsh("bracket.msh", source_path("meshes"), "0.01"); }),
            "Mesh/gmsh/Element size: only a geometry can be given an element "
            "size: found 0.01 for '" +
              source_path("meshes/bracket.msh") + "'; 0 is allowed");
}

TEST(GmshMesh, BrokenFiles)
{
  const TemporaryFolder folder;
  std::string           file = folder.write("text.msh", "Some text.\n");
  EXPECT_EQ(message(file),
            file + ": is no gmsh mesh: it must start with '$MeshFormat'");
  file = folder.write("empty.msh", "");
  EXPECT_EQ(message(file),
            file + ": is no gmsh mesh: it must start with '$MeshFormat'");
  file = folder.write("cut.msh",
                      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1");
  EXPECT_EQ(message(file),
            file + ": is no whole gmsh mesh: found no '$EndNodes'");
  file = folder.write("cut.msh",
                      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1\n"
                      "$EndNodes\n$Elements\n$EndElements\n");
  EXPECT_EQ(message(file), file + ": gmsh: Could not read nodes");
  file = folder.write(
    "syntax.geo",
    "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0;\nPoint(1) = {0, 0, 0};\n");
  EXPECT_EQ(message(file), file + ":2: gmsh: syntax error (;)");
  file = folder.write("flat.geo",
                      "SetFactory(\"OpenCASCADE\");\n"
                      "Box(1) = {0, 0, 0, 0, 1, 1};\n");
  EXPECT_EQ(message(file).find(file + ": gmsh: "), 0u) << message(file);
  file = folder.write("lost.msh",
                      msh(unit_nodes, "1\n1 4 2 1 1 10 2000000 300 9\n"));
  EXPECT_EQ(message(file),
            file + ": an element has the node 9, which the file does not "
                   "contain");
}

TEST(GmshMesh, NoTetrahedra)
{
  const TemporaryFolder folder;
  std::string file = folder.write("point.geo", "Point(1) = {0,0,0};\n");
  EXPECT_EQ(message(file), file + ": the mesh has no tetrahedra");
  file = folder.write("triangle.msh",
                      msh(unit_nodes, "1\n1 2 2 1 1 10 2000000 300\n"));
  EXPECT_EQ(message(file), file + ": the mesh has no tetrahedra");
}

// gmsh makes hexahedra and prisms by extruding layers; the file with pyramids
// is written by hand.
TEST(GmshMesh, OtherCells)
{
  const TemporaryFolder folder;
  const std::string     square =
    "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\n"
    "Transfinite Surface{1} = {};\nTransfinite Curve{:} = 3;\n";
  const std::string extrude = "Extrude {0, 0, 1} { Surface{1}; Layers{1}; "
                              "Recombine; }\n";
  const std::string allowed = "; allowed are 'Tetrahedron 4', 'Tetrahedron 10' "
                              "and 'Tetrahedron 20'";
  const std::string others  = ": cells other than tetrahedra with 4, 10 or 20 "
                              "nodes: found ";

  std::string file =
    folder.write("hex.geo", square + "Recombine Surface{1};\n" + extrude);
  EXPECT_EQ(message(file),
            file + others + "4 of the type 'Hexahedron 8'" + allowed);
  file = folder.write("prism.geo", square + extrude);
  EXPECT_EQ(message(file), file + others + "8 of the type 'Prism 6'" + allowed);
  file = folder.write("pyramid.msh",
                      msh("6\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n"
                          "6 0 0 -1\n",
                          "2\n1 7 2 1 1 1 2 3 4 5\n2 4 2 1 1 2 1 3 6\n"));
  EXPECT_EQ(message(file),
            file + others + "1 of the type 'Pyramid 5'" + allowed);
}

// gmsh passes on an inverted cell as it is.
TEST(GmshMesh, InvertedCell)
{
  const TemporaryFolder folder;
  const std::string     file =
    folder.write("inverted.msh",
                 msh(unit_nodes, "1\n1 4 2 1 1 2000000 10 300 40000\n"));
  EXPECT_EQ(refusal([&] {
              SerialMesh mesh = read_gmsh(file);
              check_mesh(mesh);
            }),
            file + ": 1 of 1 cells has no positive volume: found -0.166667 "
                   "(inverted) with the corners (1, 0, 0), (0, 0, 0), (0, 1, "
                   "0), (0, 0, 1); the last must see the others "
                   "counter-clockwise");
}

// Two boxes that touch but were not glued, so that each has its own mesh of the
// interface: a usual mistake with gmsh. The vertex is one that gmsh happens to
// make.
TEST(GmshMesh, UngluedBodies)
{
  const TemporaryFolder folder;
  const std::string     file = folder.write("unglued.geo",
                                        "SetFactory(\"OpenCASCADE\");\n"
                                            "Box(1) = {0, 0, 0, 1, 1, 1};\n"
                                            "Box(2) = {1, 0, 0, 1, 1, 1};\n");
  const std::string     text = refusal([&] {
    SerialMesh mesh = read_gmsh(file);
    check_mesh(mesh);
  });
  EXPECT_EQ(text.find(file + ": hanging node: the vertex at (1, "), 0u) << text;
  EXPECT_NE(text.find("(in gmsh: BooleanFragments or Coherence)"),
            std::string::npos);
}

// A cell or face of several groups is found by the name of each.
TEST(GmshMesh, GroupsThatOverlap)
{
  const TemporaryFolder folder;
  const std::string     file =
    folder.write("two_groups.geo",
                 "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 2, 3};\n"
                 "Physical Surface(\"a\", 3) = {1};\n"
                 "Physical Surface(\"b\", 5) = {1, 3};\n"
                 "Physical Surface(7) = {3, 5, 6};\n"
                 "Physical Volume(\"body\", 2) = {1};\n"
                 "Physical Volume(\"steel\", 4) = {1};\n");
  SerialMesh mesh = read_gmsh(file);
  check_mesh(mesh);
  EXPECT_NEAR(area(mesh, "a"), 6, 1e-13);
  EXPECT_NEAR(area(mesh, "b"), 9, 1e-13);
  EXPECT_NEAR(area(mesh, "7"), 7, 1e-13);
  const MeshNames regions("region", mesh.regions);
  EXPECT_EQ(regions.ids("body", ""), regions.ids("steel", ""));
  EXPECT_EQ(regions.name(mesh.cells[0].region), "body & steel");
}
