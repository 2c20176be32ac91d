// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Names of edges and corners: from files, after refinement, on ranks, and in
// the report. Lengths of lines and numbers of vertices are known from the
// bodies.

#include <corotet/base/text.h>
#include <corotet/mesh/abaqus_file.h>
#include <corotet/mesh/edges.h>
#include <corotet/mesh/mesh_report.h>

#include <gtest/gtest.h>

#include <numbers>

#include "mesh/edges.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;

// The parts of a refined edge have its names, and no other edge gets one;
// corners stay where they are.
TEST(NamedEdges, SurviveRefinement)
{
  SerialMesh mesh = box_with("belt: plane 0 0 0.5 0 0 1, part: belt and x-min",
                             "tip: sphere 2 1 1 0.1");
  const std::size_t n_edges = mesh.edges.size();
  refine_uniformly(mesh, 2);
  EXPECT_EQ(mesh.edges.size(), 4 * n_edges);
  EXPECT_NEAR(edge_length(mesh, "belt"), 6, 1e-12);
  EXPECT_NEAR(edge_length(mesh, "part"), 1, 1e-13);
  for (const auto &[ends, id] : mesh.edges)
    for (const unsigned int v : ends)
      EXPECT_NEAR(mesh.vertices[v][2], 0.5, 1e-14);
  EXPECT_EQ(corner_places(mesh, "tip"),
            (std::vector<std::array<double, 3>>{{{2, 1, 1}}}));
  EXPECT_TRUE(mesh.remarks.empty());
}

// The halves of curved edges lie on the curve: the error of a circle's chords
// decreases by a factor of four with each refinement.
TEST(NamedEdges, OnCurves)
{
  const TemporaryFolder folder;
  const std::string     file =
    folder.write("x.geo",
                 "SetFactory(\"OpenCASCADE\");\n"
                 "Cylinder(1) = {0, 0, 0, 0, 0, 1, 1};\n"
                 "e = 0.001;\n"
                 "Physical Curve(\"rim\") = Curve In BoundingBox{-1-e, -1-e, "
                 "1-e, 1+e, 1+e, 1+e};\n"
                 "Physical Volume(\"body\") = {1};\n");
  const double circle = 2 * std::numbers::pi;
  for (const std::string degree : {"2", "3"})
    {
      SerialMesh mesh = read_gmsh(file, "", "0.5", degree);
      check_mesh(mesh);
      const double coarse = circle - edge_length(mesh, "rim");
      refine_uniformly(mesh, 1);
      const double fine = circle - edge_length(mesh, "rim");
      EXPECT_NEAR(coarse / fine, 4, 0.1);
    }
}

namespace
{
  // A body with names in all dimensions: an edge on its surface, an edge inside
  // of it, a line that is no part of it, a corner, and a point without a name.
  const std::string geometry = R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 2, 1};
Point(100) = {0.5, 0.5, 0.5};
Point(101) = {0.5, 1.5, 0.5};
Line(100) = {100, 101};
Curve{100} In Volume{1};
Point(102) = {5, 5, 5};
Point(103) = {5, 5, 6};
Line(101) = {102, 103};
e = 1e-3;
Physical Volume("body") = {1};
Physical Curve("edge") = Curve In BoundingBox{-e, -e, -e, e, 2 + e, e};
Physical Curve("wire", 4) = {100};
Physical Curve("elsewhere") = {101};
Physical Curve("two of them") = {100, Curve In BoundingBox{-e, -e, -e, e, 2 + e, e}};
Physical Point("tip") = Point In BoundingBox{1 - e, 2 - e, 1 - e, 1 + e, 2 + e, 1 + e};
Physical Point(9) = {100};
)";

  void
  expect_names(SerialMesh mesh, const std::string &remark)
  {
    check_mesh(mesh);
    EXPECT_NEAR(edge_length(mesh, "edge"), 2, 1e-12);
    EXPECT_NEAR(edge_length(mesh, "wire"), 1, 1e-12);
    EXPECT_NEAR(edge_length(mesh, "4"), 1, 1e-12);
    EXPECT_NEAR(edge_length(mesh, "two of them"), 3, 1e-12);
    ASSERT_EQ(corner_places(mesh, "tip").size(), 1u);
    EXPECT_NEAR(corner_places(mesh, "tip")[0][1], 2, 1e-14);
    ASSERT_EQ(corner_places(mesh, "9").size(), 1u);
    EXPECT_NEAR(corner_places(mesh, "9")[0][1], 0.5, 1e-14);
    const std::string remarks = join(mesh.remarks, "\n");
    EXPECT_NE(remarks.find(remark), std::string::npos) << remarks;
  }
} // namespace

// gmsh's physical curves and points name edges and corners, whoever refines the
// mesh; those that no cell has are left out.
TEST(NamedEdges, FromGmsh)
{
  const TemporaryFolder folder;
  const std::string     file   = folder.write("x.geo", geometry);
  const std::string     remark = " lines of 'elsewhere' are not in the cells";
  for (const std::string degree : {"1", "2", "3"})
    expect_names(read_gmsh(file, "", "0.6", degree), remark);
  expect_names(read_gmsh(file, "", "0.6", "1", 1), remark);
  SerialMesh mesh = read_gmsh(file, "", "0.6");
  refine_uniformly(mesh, 1);
  expect_names(mesh, remark);
  // The same mesh, written by gmsh in its own formats.
  for (const double version : {2.2, 4.1})
    {
      gmsh::initialize(0, nullptr, false, false);
      gmsh::option::setNumber("General.Terminal", 0);
      gmsh::open(file);
      gmsh::option::setNumber("Mesh.MshFileVersion", version);
      gmsh::model::mesh::generate(3);
      gmsh::write(folder / "x.msh");
      gmsh::finalize();
      expect_names(read_gmsh(folder / "x.msh"), remark);
    }
}

// Lines between vertices that are no edge of a cell, as a damaged file may have
// them, are left out: here diagonals of a cuboid.
TEST(NamedEdges, OfNoCell)
{
  SerialMesh mesh = tests::box("1, 1, 1", "1, 1, 1");
  for (unsigned int a = 0; a < 8; ++a)
    for (unsigned int b = 0; b < a; ++b)
      mesh.edges.push_back({{{a, b}}, 3});
  mesh.edges.push_back({{{0, 1}}, 3});
  mesh.edge_names.names[3] = "all";
  mesh.vertices.emplace_back(5, 5, 5);
  mesh.corners      = {{8, 0}, {7, 0}, {7, 0}};
  mesh.corner_names = {{{0, "point"}}, {}};
  check_mesh(mesh);
  // Of the 28 pairs of vertices, 18 are edges of cells: the twelve edges of the
  // cuboid, and a diagonal of each side.
  EXPECT_EQ(mesh.edges.size(), 18u);
  EXPECT_NEAR(edge_length(mesh, "all"), 12 + 6 * std::sqrt(2.), 1e-14);
  EXPECT_EQ(mesh.corners.size(), 1u);
  EXPECT_EQ(mesh.remarks,
            (std::vector<std::string>{
              "10 lines of 'all' are no edge of a tetrahedron; they are left "
              "out",
              "1 points of 'point' are no corner of a tetrahedron; they are "
              "left out"}));
  mesh.corners.push_back({9, 0});
  EXPECT_NE(refusal([&] { check_mesh(mesh); })
              .find("a named corner has the vertex 9; there are only the "
                    "vertices 0 to 8"),
            std::string::npos);
}

// Nodes of a set that are on none of its faces become edges, if all nodes of an
// edge are in the set, and else corners. If the node in the middle of an edge
// is not in the set, the edge is not.
TEST(NamedEdges, SetsOfNodes)
{
  const TemporaryFolder folder;
  const std::string     text =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,.5,0,0\n6,.5,.5,0\n"
    "7,0,.5,0\n8,0,0,.5\n9,.5,0,.5\n10,0,.5,.5\n"
    "*ELEMENT, TYPE=C3D10, ELSET=all\n1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10\n"
    "*NSET, NSET=edge\n1, 5, 2\n*NSET, NSET=ends\n1, 2\n"
    "*NSET, NSET=middle\n5, 4\n"
    "*NSET, NSET=face and point\n1, 2, 3, 5, 6, 7, 4\n"
    "*NSET, NSET=face and edge\n1, 2, 3, 5, 6, 7, 4, 8\n"
    "*ELEMENT, TYPE=T3D3, ELSET=truss\n3, 1, 8, 4\n";
  SerialMesh mesh = serial_mesh(read_abaqus_file(folder.write("x.inp", text)));
  check_mesh(mesh);
  EXPECT_EQ(MeshNames("edge", mesh.edge_names).known(),
            (std::vector<std::string>{"edge", "face and edge", "truss"}));
  EXPECT_NEAR(edge_length(mesh, "edge"), 1, 1e-15);
  EXPECT_NEAR(edge_length(mesh, "face and edge"), 1, 1e-15);
  EXPECT_NEAR(edge_length(mesh, "truss"), 1, 1e-15);
  using Places = std::vector<std::array<double, 3>>;
  EXPECT_EQ(corner_places(mesh, "ends"), (Places{{{0, 0, 0}}, {{1, 0, 0}}}));
  EXPECT_EQ(corner_places(mesh, "middle"), (Places{{{0, 0, 1}}}));
  EXPECT_EQ(corner_places(mesh, "face and point"), (Places{{{0, 0, 1}}}));
  EXPECT_NEAR(area(mesh, "face and point"), 0.5, 1e-15);
  EXPECT_NEAR(area(mesh, "face and edge"), 0.5, 1e-15);
  EXPECT_EQ(mesh.remarks.size(), 1u);
  EXPECT_EQ(mesh.remarks.at(0).find("1 nodes of the set 'middle' are no "
                                    "corners of tetrahedra on the surface"),
            0u)
    << mesh.remarks.at(0);
}

// An internal set, which a program has made for itself, does not hide a set of
// the other kind with the same name.
TEST(NamedEdges, InternalSets)
{
  const TemporaryFolder folder;
  const std::string     text =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n"
    "*ELEMENT, TYPE=C3D4, ELSET=all\n1, 1, 2, 3, 4\n"
    "*NSET, NSET=floor\n1, 2, 3\n*ELSET, ELSET=Floor, INTERNAL\n1\n"
    "*ELSET, ELSET=first\n1\n*NSET, NSET=first, INTERNAL\n1, 2, 4\n";
  SerialMesh mesh = serial_mesh(read_abaqus_file(folder.write("x.inp", text)));
  check_mesh(mesh);
  EXPECT_EQ(MeshNames("boundary", mesh.boundaries).known(),
            std::vector<std::string>{"floor"});
  EXPECT_EQ(MeshNames("region", mesh.regions).known(),
            (std::vector<std::string>{"all", "first"}));
}

// The report has a line for each name, below the boundaries.
TEST(NamedEdges, Report)
{
  const std::string text =
    mesh_report(box_with("belt: plane 0 0 0.5 0 0 1",
                         "ends: box 0 0 0 2 0 0 and sphere 0 0 0 0.3"));
  EXPECT_NE(text.find("Edges: length, edges of cells, extent\n"
                      "  belt             6       24  (0, 0, 0.5) to (2, 1, "
                      "0.5)\n"
                      "Corners: vertices, extent\n"
                      "  ends         2  (0, 0, 0) to (0.25, 0, 0)\n"),
            std::string::npos)
    << text;
}

// Ranks get the named edges and corners of their cells: each edge once for each
// cell around it, as many on all ranks as on one, with the same names.
TEST(NamedEdges, OnRanks)
{
  const auto sums = [](const MPI_Comm comm) {
    SerialMesh mesh;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      mesh = box_with("belt: plane 0 0 0.5 0 0 1", "tip: sphere 2 1 1 0.1");
    Log                   log(comm, true);
    const Mesh            whole(mesh, 1, 1., comm, log);
    std::array<double, 3> result{};
    std::vector<Point<3>> x;
    std::vector<dealii::Triangulation<3>::cell_iterator> cells;
    for (const auto &cell : whole.triangulation().active_cell_iterators())
      cells.push_back(cell);
    EXPECT_EQ(whole.places().edges.known(), std::vector<std::string>{"belt"});
    for (const auto &[cell, edge, id] : whole.named_edges())
      {
        EXPECT_EQ(id, whole.places().edges.ids("belt", "").at(0));
        const Point<3> a = cells[cell]->vertex(ends_of_edges[edge][0]);
        const Point<3> b = cells[cell]->vertex(ends_of_edges[edge][1]);
        EXPECT_NEAR(a[2], 0.5, 1e-14);
        EXPECT_NEAR(b[2], 0.5, 1e-14);
        result[0] += 1;
        result[1] += a.distance(b);
      }
    for (const auto &[cell, vertex, id] : whole.named_corners())
      {
        EXPECT_EQ(id, whole.places().corners.ids("tip", "").at(0));
        EXPECT_LT(cells[cell]->vertex(vertex).distance(Point<3>(2, 1, 1)),
                  1e-14);
        result[2] += 1;
      }
    for (double &value : result)
      value = dealii::Utilities::MPI::sum(value, comm);
    return result;
  };
  const auto here = sums(MPI_COMM_WORLD), alone = sums(MPI_COMM_SELF);
  EXPECT_EQ(here[0], alone[0]);
  EXPECT_NEAR(here[1], alone[1], 1e-12);
  EXPECT_EQ(here[2], alone[2]);
  EXPECT_GT(here[0], 48);
}
