// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Straight cells along curved surfaces are noticed by their facets; surfaces
// that are made of planes are not taken for curved.

#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/facets.h>
#include <corotet/mesh/hdf5_mesh.h>
#include <corotet/mesh/imported_mesh.h>

#include <gtest/gtest.h>

#include "../body.h"
#include "../temporary_folder.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;

namespace
{
  // Names of the boundaries that look curved after the vertices have moved.
  std::set<std::string>
  curved(SerialMesh mesh, const std::function<Point<3>(const Point<3> &)> &map)
  {
    for (Point<3> &x : mesh.vertices)
      x = map(x);
    std::set<std::string> result;
    for (const unsigned int id : faceted_boundaries(mesh))
      result.insert(id == no_boundary ? "none" : mesh.boundaries.names.at(id));
    return result;
  }

  // Moves a point of the bar [0, n] x [0, 1]^2, which is bent to a part of a
  // polygon of inner radius 3, with an angle [degrees] at each unit of x.
  Point<3>
  bent(const Point<3> &x, const double angle)
  {
    const double turn   = angle * dealii::numbers::PI / 180;
    const double radius = 3 + x[2];
    // A point between two corners of the polygon lies on its side.
    const double corner = std::floor(x[0] + 1e-10), s = x[0] - corner;
    const auto   at = [&](const double k) {
      return Point<3>(radius * std::sin(k * turn),
                      x[1],
                      radius * std::cos(k * turn));
    };
    return at(corner) + s * (at(corner + 1) - at(corner));
  }

  const std::set<std::string> none, inner_and_outer{"z-min", "z-max"};
} // namespace

// The sides have one cell each: the bar is taken for a faceted cylinder if
// neighbouring sides differ by up to 42 degrees.
TEST(Facets, OfCylinders)
{
  for (const double angle : {0.5, 5., 15., 30., 40.})
    EXPECT_EQ(curved(box("6, 1, 1", "6, 2, 2"),
                     [&](const Point<3> &x) { return bent(x, angle); }),
              inner_and_outer)
      << angle;
}

// A plane that is cut into cells is not taken for facets: the same polygons
// with sides of two cells that have vertices inside, with few sides, or with
// sharp edges.
TEST(Facets, OfPolyhedra)
{
  const auto same = [](const Point<3> &x) { return x; };
  EXPECT_EQ(curved(box("1, 1, 1", "1, 1, 1"), same), none);
  EXPECT_EQ(curved(box("2, 1, 1", "6, 3, 3", 0.1), same), none);
  for (const double angle : {5., 15., 30., 45., 60.})
    {
      const auto bend = [&](const Point<3> &x) { return bent(x, angle); };
      EXPECT_EQ(curved(box("6, 1, 1", "12, 4, 2"), bend), none) << angle;
      EXPECT_EQ(curved(box("3, 1, 1", "3, 1, 1"), bend), none) << angle;
    }
  for (const double angle : {45., 60., 90.})
    EXPECT_EQ(curved(box("3, 1, 1", "3, 2, 2"),
                     [&](const Point<3> &x) { return bent(x, angle); }),
              none)
      << angle;
}

// Three narrow sides, a wide one with vertices inside, and three narrow ones: a
// curved surface needs four narrow sides in a row.
TEST(Facets, OfSidesThatAWideOneSeparates)
{
  const double corners[] = {0, 1, 2, 3, 5, 6, 7, 8};
  EXPECT_EQ(curved(box("8, 1, 1", "8, 2, 2"),
                   [&](const Point<3> &x) {
                     const auto *next =
                       std::upper_bound(corners, corners + 7, x[0] + 1e-10);
                     const double begin = *(next - 1);
                     return bent({next - corners - 1 +
                                    (x[0] - begin) / (*next - begin),
                                  x[1],
                                  x[2]},
                                 20);
                   }),
            none);
}

// The remark names the boundaries and says what to do; there is only one.
TEST(Facets, Remark)
{
  SerialMesh mesh = box("6, 1, 1", "6, 2, 2");
  remark_facets(mesh, {});
  EXPECT_TRUE(mesh.remarks.empty());
  std::set<unsigned int> boundaries{no_boundary};
  for (const auto &[id, name] : mesh.boundaries.names)
    if (name == "z-min")
      boundaries.insert(id);
  remark_facets(mesh, boundaries);
  ASSERT_EQ(mesh.remarks.size(), 1u);
  for (const std::string word :
       {"z-min", "surfaces without a name", "Geometry degree"})
    EXPECT_NE(mesh.remarks[0].find(word), std::string::npos) << word;
}

// Meshes of other programs are checked for facets, too. A mesh file of corotet
// keeps the remark, as ranks that read it have only parts of the surface.
TEST(Facets, OfFiles)
{
  SerialMesh mesh = box("6, 1, 1", "6, 2, 2");
  for (Point<3> &x : mesh.vertices)
    x = bent(x, 15);
  ImportedMesh imported;
  imported.nodes = mesh.vertices;
  for (const SerialMesh::Cell &cell : mesh.cells)
    imported.cells.insert(imported.cells.end(),
                          cell.vertices.begin(),
                          cell.vertices.end());
  for (const SerialMesh::Face &face : mesh.faces)
    imported.face_sets[mesh.boundaries.names.at(face.boundary)].push_back(
      face.vertices);
  SerialMesh read = serial_mesh(imported);
  check_mesh(read);
  ASSERT_EQ(read.remarks.size(), 1u);
  EXPECT_NE(read.remarks[0].find("curved surfaces (z-min, z-max)"),
            std::string::npos)
    << read.remarks[0];
  const TemporaryFolder folder;
  const std::string     file = folder / "body.h5", again = folder / "again.h5";
  write_hdf5_mesh(file, read);
  write_hdf5_mesh(again, read_hdf5_mesh(file));
  EXPECT_EQ(read_hdf5_mesh(again).remarks, read.remarks);
  read.faceted = {};
  write_hdf5_mesh(file, read);
  EXPECT_TRUE(read_hdf5_mesh(file).remarks.empty());
}
