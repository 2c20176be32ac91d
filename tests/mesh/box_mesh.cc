// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The generated box: its volume, the areas of its sides, its names, its
// conformity and its shape are known exactly.

#include <corotet/mesh/box_mesh.h>
#include <corotet/mesh/check_mesh.h>

#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mesh/dealii_mesh.h"
#include "mesh/tools.h"

using namespace corotet;
using namespace corotet;
using namespace corotet::tests;

namespace
{
  SerialMesh
  make_box(const std::string &origin,
           const std::string &size,
           const std::string &cells)
  {
    BoxMesh                  source;
    dealii::ParameterHandler prm;
    source.declare_parameters(prm);
    prm.set("Origin", origin);
    prm.set("Size", size);
    prm.set("Cells", cells);
    return source.create("");
  }
} // namespace

// A cuboid has five cells. The areas of the sides are checked for even and odd
// numbers of cuboids (neighbouring ones are mirrored, which must fit for both).
// The tolerance, 1e-13, is the round-off of sums of n positive terms.
TEST(BoxMesh, VolumeAndSides)
{
  SerialMesh mesh = make_box("-1, 2, 0.5", "2, 0.5, 0.25", "5, 2, 3");
  check_mesh(mesh);
  EXPECT_TRUE(mesh.remarks.empty());
  EXPECT_EQ(mesh.cells.size(), 5u * 5 * 2 * 3);
  EXPECT_EQ(mesh.vertices.size(), 6u * 3 * 4);
  EXPECT_EQ(mesh.faces.size(), 4u * (5 * 2 + 5 * 3 + 2 * 3));
  EXPECT_NEAR(region_volumes(mesh).at(0), 0.25, 1e-13);
  EXPECT_EQ(mesh.regions.names,
            (std::map<unsigned int, std::string>{{0, "body"}}));

  const std::map<std::string, double> expected = {{"x-min", 0.125},
                                                  {"x-max", 0.125},
                                                  {"y-min", 0.5},
                                                  {"y-max", 0.5},
                                                  {"z-min", 1},
                                                  {"z-max", 1}};
  const auto                          areas    = boundary_areas(mesh);
  ASSERT_EQ(areas.size(), 6u);
  for (const auto &[id, area] : areas)
    EXPECT_NEAR(area, expected.at(mesh.boundaries.names.at(id)), 1e-13);

  // Each side is exactly where its name says: coordinates of corners are not
  // computed.
  const double place[6] = {-1, 1, 2, 2.5, 0.5, 0.75};
  for (const SerialMesh::Face &face : mesh.faces)
    for (const unsigned int v : face.vertices)
      EXPECT_NEAR(mesh.vertices[v][face.boundary / 2],
                  place[face.boundary],
                  1e-15);
}

// A cube's five cells are a regular tetrahedron (70.53 degrees, 1) and four
// corners: between a side and the cut acos(1/sqrt(3)), longest edge sqrt(2),
// inradius 3V/A = (1/2) / (3/2 + sqrt(3)/2), so an aspect ratio of
// (1 + sqrt(3)) / 2.
TEST(BoxMesh, Quality)
{
  const SerialMesh  mesh    = make_box("0, 0, 0", "3, 3, 3", "3, 3, 3");
  const MeshQuality quality = mesh_quality(mesh);
  EXPECT_NEAR(quality.volume, 27, 1e-12);
  EXPECT_NEAR(quality.smallest_dihedral_angle,
              std::acos(1 / std::sqrt(3.)) * 180 / std::acos(-1.),
              1e-12);
  EXPECT_NEAR(quality.worst_aspect_ratio, (1 + std::sqrt(3.)) / 2, 1e-13);
}

// The defaults that the documentation states make a valid mesh.
TEST(BoxMesh, Defaults)
{
  SerialMesh mesh = BoxMesh().create("");
  check_mesh(mesh);
  EXPECT_EQ(mesh.cells.size(), 50u);
  EXPECT_NEAR(mesh_quality(mesh).volume, 0.01, 1e-16);
}

TEST(BoxMesh, Refusals)
{
  EXPECT_EQ(refusal([] { make_box("0,0,0", "1,1,1", "10000,10000,1"); }),
            "Mesh/box/Cells: too many cells: found 10000 x 10000 x 1, which "
            "makes 5e+08 tetrahedra and, with elements of degree 1, 6e+08 "
            "unknowns; at most 1e8 tetrahedra are allowed");
  // Coordinates so large that they have no digits left for the cells; also a
  // plate whose thickness is below the round-off of its size.
  const std::string allowed =
    "; allowed are coordinates up to 1e10 times the shortest edge";
  EXPECT_EQ(refusal([] { make_box("1e17, 0, 0", "1,1,1", "2,1,1"); }),
            "Mesh/box/Origin: cells are lost in the round-off of coordinates: "
            "found cells with edges of 0.5 m and coordinates up to 1e+17 m" +
              allowed);
  EXPECT_EQ(refusal([] { make_box("0, 0, 0", "1e30,1,1e-30", "1,1,1"); }),
            "Mesh/box/Origin: cells are lost in the round-off of coordinates: "
            "found cells with edges of 1e-30 m and coordinates up to 1e+30 m" +
              allowed);
  EXPECT_EQ(make_box("9e9, 0, 0", "1,1,1", "1,1,1").cells.size(), 5u);
  for (const std::string size : {"1, 1", "1, 0, 1", "1, -1, 1", "1, a, 1"})
    EXPECT_THROW(make_box("0,0,0", size, "1,1,1"), dealii::ExceptionBase)
      << size;
  for (const std::string cells : {"1, 1", "1, 0, 1", "1, 1.5, 1"})
    EXPECT_THROW(make_box("0,0,0", "1,1,1", cells), dealii::ExceptionBase)
      << cells;
}

// The cells are those of deal.II's generator, in its order; so are the faces,
// in any order.
TEST(BoxMesh, IsDealIIs)
{
  dealii::Triangulation<3> tria;
  dealii::GridGenerator::subdivided_hyper_rectangle_with_simplices(
    tria, {4, 3, 1}, {-1, 2, 0.5}, {1, 2.5, 0.75}, true);
  const SerialMesh expected = make_serial_mesh(tria);
  const SerialMesh mesh     = make_box("-1, 2, 0.5", "2, 0.5, 0.25", "4, 3, 1");
  ASSERT_EQ(mesh.vertices.size(), expected.vertices.size());
  for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
    EXPECT_LE(mesh.vertices[v].distance(expected.vertices[v]), 1e-15);
  ASSERT_EQ(mesh.cells.size(), expected.cells.size());
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    EXPECT_EQ(mesh.cells[c].vertices, expected.cells[c].vertices);
  const auto faces_of = [](const SerialMesh &mesh) {
    std::multiset<std::pair<std::set<unsigned int>, unsigned int>> faces;
    for (const SerialMesh::Face &face : mesh.faces)
      faces.emplace(std::set<unsigned int>(face.vertices.begin(),
                                           face.vertices.end()),
                    face.boundary);
    return faces;
  };
  EXPECT_EQ(faces_of(mesh), faces_of(expected));
}
