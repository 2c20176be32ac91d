// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The report on a mesh: the numbers for bodies that are known.

#include <corotet/mesh/mesh_report.h>

#include <gtest/gtest.h>

#include <chrono>

#include "../body.h"
#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // The report on a box of 1 x 2 x 3 of five tetrahedra.
  std::string
  report(const std::function<void(SerialMesh &)> &change = [](SerialMesh &) {})
  {
    SerialMesh mesh = tests::box("1, 2, 3", "1, 1, 1");
    change(mesh);
    return mesh_report(mesh);
  }

  void
  expect_line(const std::string &text, const std::string &line)
  {
    EXPECT_NE(text.find(line + "\n"), std::string::npos)
      << line << " is not in\n"
      << text;
  }
} // namespace

TEST(MeshReport, Box)
{
  const std::string text = report();
  expect_line(text, "5 cells, 8 vertices, volume 6");
  expect_line(text, "Boundaries: area, faces, extent");
  expect_line(text,
              "  x-min             6        2  (0, 0, 0) to (0, 2, 3), flat, "
              "normal (-1, 0, 0)");
  expect_line(text,
              "  z-max             2        2  (0, 0, 3) to (1, 2, 3), flat, "
              "normal (0, 0, 1)");
}

// The line of a name counts all its faces, also those with other names; a name
// whose faces are not plane has no normal.
TEST(MeshReport, NamesThatOverlap)
{
  const std::string text = report([](SerialMesh &mesh) {
    std::vector<unsigned int *> ids;
    std::vector<std::size_t>    members;
    for (SerialMesh::Face &face : mesh.faces)
      ids.push_back(&face.boundary);
    for (std::size_t i = 0; i < ids.size(); ++i)
      members.push_back(i);
    mesh.boundaries.add("skin", members, ids);
  });
  expect_line(text, "  skin             22       12  (0, 0, 0) to (1, 2, 3)");
  expect_line(text,
              "  x-min             6        2  (0, 0, 0) to (0, 2, 3), flat, "
              "normal (-1, 0, 0)");
}

// The dihedral angles in a cube: the middle cell is regular, with six angles of
// 70.53 degrees; the four others have three right angles and three of 54.74
// degrees.
TEST(MeshReport, Shapes)
{
  SerialMesh        mesh = box("1, 1, 1", "1, 1, 1");
  const std::string text = mesh_report(mesh);
  expect_line(text, "       50-80  60.00 %  " + std::string(24, '#'));
  expect_line(text, "      80-100  40.00 %  " + std::string(16, '#'));
  expect_line(text, "       1-1.5 100.00 %  " + std::string(40, '#'));
}

// Bodies that only touch are not one body.
TEST(MeshReport, Bodies)
{
  EXPECT_EQ(report().find("bodies"), std::string::npos);
  const std::string text = report([](SerialMesh &mesh) {
    const unsigned int n = mesh.vertices.size();
    for (unsigned int v = 0; v < n; ++v)
      mesh.vertices.push_back(mesh.vertices[v] + dealii::Point<3>(1, 0, 0));
    const auto cells = mesh.cells;
    for (SerialMesh::Cell cell : cells)
      {
        for (unsigned int &v : cell.vertices)
          v += n;
        mesh.cells.push_back(cell);
      }
  });
  expect_line(text,
              "2 bodies without a common node, and each moves on its own");
}

// Each cell has a name of its own: the time grows with the number of names, not
// with its square, which would be half a minute here.
TEST(MeshReport, ManyNames)
{
  using Clock        = std::chrono::steady_clock;
  const auto seconds = [](const SerialMesh &mesh) {
    const auto start = Clock::now();
    mesh_report(mesh);
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  SerialMesh   mesh    = box("1, 1, 1", "20, 20, 20");
  const double of_few  = seconds(mesh);
  unsigned int n_cells = 0;
  for (SerialMesh::Cell &cell : mesh.cells)
    cell.region = n_cells++;
  EXPECT_LT(seconds(mesh), 10 * of_few + 1) << n_cells;
}
