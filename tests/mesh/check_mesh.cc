// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Every kind of wrong mesh is refused with a message that says what and where;
// each is made by hand of a few cells, so that the place is known.

#include <corotet/mesh/check_mesh.h>

#include <gtest/gtest.h>

#include <limits>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet;
using namespace corotet::tests;

namespace
{
  // Two cells that share the triangle 0 1 2, above and below of z = 0.
  SerialMesh
  two_cells()
  {
    SerialMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.cells    = {{{{0, 1, 2, 3}}, 0}, {{{0, 2, 1, 4}}, 1}};
    mesh.faces    = {{{{3, 1, 2}}, 7}};
    mesh.boundaries.names = {{7, "top"}};
    mesh.origin           = "x.msh";
    return mesh;
  }

  std::string
  message(SerialMesh mesh)
  {
    return refusal([&] { check_mesh(mesh); });
  }
} // namespace

TEST(CheckMesh, AcceptsAGoodMesh)
{
  EXPECT_EQ(message(two_cells()), "nothing was refused");
}

// Cells that meet in one vertex or one edge only are conforming.
TEST(CheckMesh, AcceptsSharedVerticesAndEdges)
{
  SerialMesh mesh = two_cells();
  mesh.vertices.insert(mesh.vertices.end(),
                       {{-1, 0, 0}, {0, -1, 0}, {-1, 0, 0.5}});
  mesh.cells.push_back({{{0, 5, 6, 3}}, 0});
  EXPECT_EQ(message(mesh), "nothing was refused");
}

TEST(CheckMesh, NoCells)
{
  SerialMesh mesh = two_cells();
  mesh.cells.clear();
  EXPECT_EQ(message(mesh), "x.msh: the mesh has no tetrahedra");
  mesh.origin.clear();
  EXPECT_EQ(message(mesh), "Mesh/Type: the mesh has no tetrahedra");
}

TEST(CheckMesh, VertexOutOfRange)
{
  SerialMesh mesh           = two_cells();
  mesh.cells[1].vertices[3] = 5;
  EXPECT_EQ(message(mesh),
            "x.msh: a cell has the vertex 5; there are only the vertices 0 to "
            "4");
  mesh                      = two_cells();
  mesh.faces[0].vertices[0] = 9;
  EXPECT_EQ(message(mesh),
            "x.msh: a face of boundary 'top' has the vertex 9; there are only "
            "the vertices 0 to 4");
}

TEST(CheckMesh, CoordinateNotFinite)
{
  SerialMesh mesh     = two_cells();
  mesh.vertices[4][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(mesh),
            "x.msh: a vertex has the coordinates (0, 0, nan); they must be "
            "finite numbers");
}

TEST(CheckMesh, InvertedCell)
{
  SerialMesh mesh = two_cells();
  std::swap(mesh.cells[0].vertices[0], mesh.cells[0].vertices[1]);
  EXPECT_EQ(message(mesh),
            "x.msh: 1 of 2 cells has no positive volume: found -0.166667 "
            "(inverted) with the corners (1, 0, 0), (0, 0, 0), (0, 1, 0), "
            "(0, 0, 1); the last must see the others counter-clockwise");
}

// A cell that is exactly flat, one flat up to round-off, and one that has a
// vertex twice. A needle of width 1e-6 is not flat.
TEST(CheckMesh, ZeroVolume)
{
  for (const double z : {0., 1e-16, -1e-16})
    {
      SerialMesh mesh     = two_cells();
      mesh.vertices[3][2] = z;
      mesh.vertices[4][2] = -z;
      mesh.vertices[3][0] = 0.25;
      EXPECT_NE(message(mesh).find("x.msh: 2 of 2 cells have no positive "
                                   "volume: found a flat one (zero volume) "
                                   "with the corners (0, 0, 0), (1, 0, 0)"),
                std::string::npos)
        << message(mesh);
    }
  SerialMesh twice           = two_cells();
  twice.cells[0].vertices[3] = 0;
  EXPECT_NE(message(twice).find("zero volume"), std::string::npos);

  SerialMesh needle = two_cells();
  for (auto &vertex : needle.vertices)
    {
      vertex[1] *= 1e-6;
      vertex[2] *= 1e-6;
    }
  EXPECT_EQ(message(needle), "nothing was refused");
}

// A third cell on a face, a second one on the same side of a face (both volumes
// are positive), and a cell that is listed twice.
TEST(CheckMesh, OverlappingCells)
{
  SerialMesh mesh = two_cells();
  mesh.vertices.emplace_back(0.5, 0.5, 2);
  mesh.cells.push_back({{{0, 1, 2, 5}}, 0});
  EXPECT_EQ(message(mesh),
            "x.msh: cells overlap: the triangle with the centre (0.333333, "
            "0.333333, 0) is a face of 3 cells; at most two may share it, one "
            "on each side");
  mesh.cells.erase(mesh.cells.begin() + 1);
  EXPECT_EQ(message(mesh),
            "x.msh: cells overlap: the triangle with the centre (0.333333, "
            "0.333333, 0) is a face of 2 cells on the same side; at most two "
            "may share it, one on each side");
  mesh = two_cells();
  mesh.cells.push_back(mesh.cells[0]);
  EXPECT_NE(message(mesh).find("cells overlap"), std::string::npos);
}

// An interface each side of which has its own vertices: at the same positions,
// or a round-off apart.
TEST(CheckMesh, DuplicateNodes)
{
  for (const double gap : {0., 1e-15})
    {
      SerialMesh mesh = two_cells();
      mesh.vertices.insert(mesh.vertices.end(),
                           {{0, 0, -gap}, {1, 0, -gap}, {0, 1, -gap}});
      mesh.cells[1].vertices = {{5, 7, 6, 4}};
      EXPECT_NE(message(mesh).find("x.msh: duplicate nodes: two vertices are "
                                   "at ("),
                std::string::npos)
        << message(mesh);
      EXPECT_NE(message(mesh).find("; cells that meet there must share one "
                                   "(in gmsh: BooleanFragments or Coherence)"),
                std::string::npos);
    }
}

// An interface with a gap: what counts is its width relative to the length of
// edges.
TEST(CheckMesh, GapsInBodiesOfAnySize)
{
  for (const double size : {1e-9, 1., 1e9})
    for (const double gap : {1e-7, 1e-9})
      {
        SerialMesh mesh = two_cells();
        mesh.vertices.insert(mesh.vertices.end(),
                             {{0, 0, -gap}, {1, 0, -gap}, {0, 1, -gap}});
        mesh.cells[1].vertices = {{5, 7, 6, 4}};
        for (dealii::Point<3> &p : mesh.vertices)
          p *= size;
        EXPECT_EQ(message(mesh).find("duplicate nodes") != std::string::npos,
                  gap < 1e-8)
          << size << ": " << message(mesh);
      }
}

// Below the interface the edge from (1,0,0) to (0,1,0) is cut in two.
TEST(CheckMesh, HangingNodeOnAnEdge)
{
  SerialMesh mesh = two_cells();
  mesh.vertices.emplace_back(0.5, 0.5, 0);
  mesh.cells[1].vertices = {{0, 5, 1, 4}};
  mesh.cells.push_back({{{0, 2, 5, 4}}, 1});
  EXPECT_EQ(message(mesh),
            "x.msh: hanging node: the vertex at (0.5, 0.5, 0) lies on a face "
            "of a cell without being its corner; cells must meet in whole "
            "faces (in gmsh: BooleanFragments or Coherence)");
}

// Below the interface the triangle is cut in three.
TEST(CheckMesh, HangingNodeInAFace)
{
  SerialMesh mesh = two_cells();
  mesh.vertices.emplace_back(0.25, 0.25, 0);
  mesh.cells[1].vertices = {{0, 5, 1, 4}};
  mesh.cells.push_back({{{0, 2, 5, 4}}, 1});
  mesh.cells.push_back({{{1, 5, 2, 4}}, 1});
  EXPECT_NE(message(mesh).find("hanging node: the vertex at (0.25, 0.25, 0)"),
            std::string::npos)
    << message(mesh);
}

// A square that is cut along one diagonal above and along the other below:
// every vertex is shared, no face is.
TEST(CheckMesh, CrossingDiagonals)
{
  SerialMesh mesh;
  mesh.vertices = {
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}};
  mesh.cells = {{{{0, 1, 2, 4}}, 0},
                {{{0, 2, 3, 4}}, 0},
                {{{0, 3, 1, 5}}, 0},
                {{{1, 3, 2, 5}}, 0}};
  EXPECT_NE(message(mesh).find("Mesh/Type: not conforming: the faces of two "
                               "cells overlap at ("),
            std::string::npos)
    << message(mesh);
}

TEST(CheckMesh, FaceOfNoCell)
{
  SerialMesh mesh        = two_cells();
  mesh.faces[0].vertices = {{0, 3, 4}};
  EXPECT_EQ(message(mesh),
            "x.msh: boundary 'top' has the triangle with the centre (0, 0, "
            "0), which is no face of a cell");
}

// The same boundary may be listed twice for a face, two boundaries may not.
TEST(CheckMesh, FaceOfTwoBoundaries)
{
  SerialMesh mesh = two_cells();
  mesh.faces.push_back({{{2, 1, 3}}, 7});
  EXPECT_EQ(refusal([&] { check_mesh(mesh); }), "nothing was refused");
  EXPECT_EQ(mesh.faces.size(), 1u);
  mesh.faces.push_back({{{1, 2, 3}}, 8});
  EXPECT_EQ(message(mesh),
            "x.msh: the face with the centre (0.333333, 0.333333, 0.333333) "
            "belongs to the boundaries 'top' and 8; a face has one boundary "
            "at most");
}

// A named interface between two regions is no part of the surface.
TEST(CheckMesh, FacesInsideAreIgnored)
{
  SerialMesh mesh = two_cells();
  mesh.faces.push_back({{{2, 1, 0}}, 9});
  check_mesh(mesh);
  ASSERT_EQ(mesh.faces.size(), 1u);
  EXPECT_EQ(mesh.faces[0].boundary, 7u);
  ASSERT_EQ(mesh.remarks.size(), 1u);
  EXPECT_EQ(mesh.remarks[0],
            "boundary 9 has 1 faces inside the body; they are ignored");
}
