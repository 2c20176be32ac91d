// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Curved cells need the same nodes on common edges and faces, and consistent
// data.

#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/mesh.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../curved_mesh.h"
#include "../refusal.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;

namespace
{
  // Two cells with a common face, each with a map of this degree, and the z of
  // all nodes lifted by a quadratic function.
  SerialMesh
  two_cells(const unsigned int degree)
  {
    SerialMesh mesh;
    mesh.vertices = {Point<3>(0, 0, 0),
                     Point<3>(1, 0, 0),
                     Point<3>(0, 1, 0),
                     Point<3>(0, 0, 1),
                     Point<3>(1, 1, 1)};
    mesh.cells    = {{{{0, 1, 2, 3}}, 0}, {{{1, 2, 3, 4}}, 0}};
    return curved(mesh, degree, [](Point<3> x) {
      x[2] += 0.1 * x[0] * x[1];
      return x;
    });
  }

  // Moves the node of the second cell that is closest to @p x by @p by.
  void
  move_node(SerialMesh &mesh, const Point<3> &x, const Point<3> &by)
  {
    const auto begin = mesh.curved_nodes.begin() + mesh.n_map_nodes();
    *std::min_element(begin,
                      mesh.curved_nodes.end(),
                      [&](const Point<3> &a, const Point<3> &b) {
                        return a.distance(x) < b.distance(x);
                      }) += by;
  }

  std::string
  refusal_of(SerialMesh mesh, const unsigned int degree = 3)
  {
    const std::string alone = refusal([&] { check_mesh(mesh, degree); });
    // A mesh that is spread over ranks is checked in another place.
    Log log(MPI_COMM_WORLD, true);
    EXPECT_EQ(refusal([&] { Mesh(mesh, 0, 1., MPI_COMM_WORLD, log, degree); }),
              alone);
    return alone;
  }

  const std::string fine = "nothing was refused";

  std::string
  different(const std::string &side,
            const double       distance,
            const std::string &place)
  {
    return fmt::format("Mesh/Type: cells with a common {} have different nodes "
                       "there: found nodes that are {} apart near {}; allowed "
                       "is one place for all cells",
                       side,
                       distance,
                       place);
  }
} // namespace

// A node of a common edge is moved in one cell, as far as round-off may do it,
// and farther. The edge is 1.41 long.
TEST(CommonNodes, OfEdges)
{
  for (const unsigned int degree : {2u, 3u})
    {
      SCOPED_TRACE(degree);
      SerialMesh mesh = two_cells(degree);
      EXPECT_EQ(refusal_of(mesh), fine);
      const double   at = degree == 2 ? 0.5 : 1. / 3;
      const Point<3> x(1 - at, at, 0.1 * at * (1 - at));
      move_node(mesh, x, Point<3>(0, 0, 1e-6));
      EXPECT_EQ(refusal_of(mesh), fine);
      move_node(mesh, x, Point<3>(0, 0, 0.001 - 1e-6));
      EXPECT_EQ(refusal_of(mesh), different("edge", 0.001, "(0.5, 0.5, 0)"));
    }
}

// One of the cells is straight; the other one is bent by 0.025, or by as little
// as the few digits of a file may hide. The longest edge is 1.41 long.
TEST(CommonNodes, OfAStraightCell)
{
  SerialMesh mesh     = two_cells(2);
  mesh.cells[1].curve = SerialMesh::straight;
  mesh.curved_nodes.resize(mesh.n_map_nodes());
  EXPECT_EQ(refusal_of(mesh), different("edge", 0.025, "(0.5, 0.5, 0)"));
  for (Point<3> &x : mesh.curved_nodes)
    x[2] -= 0.08 * x[0] * x[1];
  EXPECT_EQ(refusal_of(mesh), fine);
}

TEST(CommonNodes, OfFaces)
{
  SerialMesh mesh = two_cells(3);
  move_node(mesh, Point<3>(1. / 3, 1. / 3, 1. / 3), Point<3>(0, 0, 0.1));
  EXPECT_EQ(refusal_of(mesh),
            different("face", 0.1, "(0.333333, 0.333333, 0.333333)"));
}

// Elements of degree 1 do not use the curves, but refinements do.
TEST(CommonNodes, ElementsOfDegree1)
{
  SerialMesh mesh = two_cells(2);
  move_node(mesh, Point<3>(0.5, 0.5, 0), Point<3>(0, 0, 0.1));
  Log log(MPI_COMM_WORLD, true);
  EXPECT_EQ(refusal([&] { Mesh(mesh, 0, 1., MPI_COMM_WORLD, log, 1); }), fine);
  EXPECT_EQ(refusal([&] { Mesh(mesh, 1, 1., MPI_COMM_WORLD, log, 1); }),
            different("edge", 0.1, "(0.5, 0.5, 0)"));
}

// Mistakes that only a source of one's own can make.
TEST(CommonNodes, InconsistentData)
{
  const auto message = [](const auto &change) {
    SerialMesh mesh = two_cells(2);
    change(mesh);
    return refusal_of(mesh);
  };
  EXPECT_EQ(message([](SerialMesh &mesh) { mesh.curved_nodes.resize(13); }),
            "Mesh/Type: 2 curved cells of degree 2 have 13 nodes; they need 10 "
            "each");
  EXPECT_EQ(message([](SerialMesh &mesh) { mesh.cells[1].curve = 5; }),
            "Mesh/Type: a curved cell has the number 5 among 2; each must have "
            "one of its own, from 0 on");
  EXPECT_EQ(message([](SerialMesh &mesh) { mesh.cells[1].curve = 0; }),
            "Mesh/Type: a curved cell has the number 0 among 2; each must have "
            "one of its own, from 0 on");
  EXPECT_EQ(message([](SerialMesh &mesh) { mesh.geometry_degree = 4; }),
            "Mesh/Type: curved cells have the degree 4; allowed are 2 and 3");
  EXPECT_EQ(message([](SerialMesh &mesh) { mesh.curved_nodes[1][0] += 0.2; }),
            "Mesh/Type: a curved cell has the node (1.2, 0, 0) for its vertex "
            "(1, 0, 0); the first four nodes must be the vertices");
  EXPECT_EQ(message([](SerialMesh &mesh) {
              mesh.curved_nodes[15][1] = std::nan("");
            }),
            "Mesh/Type: a node of a curved cell has the coordinates (0, nan, "
            "0.5); they must be finite numbers");
}

TEST(CommonNodes, MoreRefinementsThanAskedFor)
{
  SerialMesh mesh    = two_cells(2);
  mesh.n_refinements = 2;
  Log log(MPI_COMM_WORLD, true);
  EXPECT_EQ(refusal([&] { Mesh(mesh, 1, 1., MPI_COMM_WORLD, log, 2); }),
            "Mesh/Type: found 2 refinements by the source of the mesh; "
            "allowed: at most 1, the number that was asked for");
}
