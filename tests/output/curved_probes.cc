// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Probes in curved cells.

#include <corotet/output/probes.h>
#include <corotet/output/stress_probes.h>

#include <gtest/gtest.h>

#include "../curved_mesh.h"
#include "../refusal.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

// Probes inside of all cells, on their faces and edges, some of which lie on
// the curved surface, and at vertices. The elements represent affine
// displacements exactly, so errors are the round-off of 20 terms of order one.
TEST(Probes, CurvedCells)
{
  const std::vector<Point<3>> places{{0.2, 0.3, 0.4},
                                     {0.5, 0.1, 0.},
                                     {0.3, 0., 0.3},
                                     {1. / 3, 1. / 3, 1. / 3},
                                     {0., 0.7, 0.},
                                     {1., 0., 0.}};
  const auto                  affine = [](const Point<3> &x) {
    return Tensor<1, 3>({1 + x[0] - 2 * x[1], x[2] - 3 * x[0], x[1] + x[2]});
  };
  for (const unsigned int degree : {2u, 3u})
    {
      const SerialMesh        mesh = half_curved_box(degree);
      const MapAtPoints       map(degree, places);
      std::vector<ProbePoint> points;
      for (const SerialMesh::Cell &cell : mesh.cells)
        for (unsigned int i = 0; i < places.size(); ++i)
          if (cell.curve != SerialMesh::straight)
            points.push_back({"p" + std::to_string(points.size()),
                              map.position(curved_nodes(mesh, cell), i)});
      ASSERT_EQ(points.size(), 40 * places.size());

      const MovingBody body(mesh, element_text(degree));
      const Probes     probes(points, body.discretization);
      const auto       values = probes.displacements(body.interpolate(affine));
      for (unsigned int p = 0; p < points.size(); ++p)
        EXPECT_LT((values[p] - affine(points[p].position)).norm(), 1e-13)
          << points[p].position;

      // This point is beyond the end at x = 2 + 0.2 z.
      EXPECT_EQ(refusal([&] {
                  Probes({{"a", {2.21, 0.7, 1.}}}, body.discretization);
                }).substr(0, 55),
                "Output/Probes: probe 'a' at (2.21, 0.7, 1) lies outside");
    }
}

// A probe that is a little off a curved surface, z = 1 + x^2 / 5, is evaluated
// at the nearest point of the surface, to 1e-12, as Newton's method finds it.
// So are probes beside the plane x = 0 and beside an edge, beyond y = 0 as
// well.
TEST(Probes, BesideTheSurface)
{
  const auto affine = [](const Point<3> &x) {
    return Tensor<1, 3>({1 + x[0] - 2 * x[1], x[2] - 3 * x[0], x[1] + x[2]});
  };
  for (const unsigned int degree : {2u, 3u})
    {
      const SerialMesh mesh =
        curved(box("2, 1, 1", "4, 2, 2"), degree, [](const Point<3> &x) {
          return Point<3>(x[0], x[1], x[2] + x[0] * x[0] / 5);
        });
      std::vector<ProbePoint> points;
      std::vector<Point<3>>   nearest;
      const auto add = [&](const Point<3> &foot, const Tensor<1, 3> &normal) {
        nearest.push_back(foot);
        points.push_back({"p" + std::to_string(points.size()),
                          foot + 0.02 * normal / normal.norm()});
      };
      for (const double x : {0.03, 0.5, 0.77, 1.3, 1.9})
        for (const double y : {0.1, 0.5, 0.83})
          add({x, y, 1 + x * x / 5}, Tensor<1, 3>({-0.4 * x, 0., 1.}));
      add({0, 0.3, 0.4}, Tensor<1, 3>({-1., 0., 0.}));
      add({0, 0, 0.6}, Tensor<1, 3>({-1., -2., 0.}));

      const MovingBody body(mesh, element_text(degree));
      EXPECT_THROW(Probes(points, body.discretization), InputError);
      Log          log(MPI_COMM_SELF, true);
      const Probes probes(points, body.discretization, &log);
      const auto   values = probes.displacements(body.interpolate(affine));
      for (unsigned int p = 0; p < points.size(); ++p)
        EXPECT_LT((values[p] - affine(nearest[p])).norm(), 1e-12)
          << points[p].position;
      EXPECT_NO_THROW(StressProbes(points, body.discretization, false, &log));
      // This point is more than a fifth of a cell away.
      EXPECT_THROW(Probes({{"far", {-0.2, 0.5, 0.5}}},
                          body.discretization,
                          &log),
                   InputError);
    }
}

// Displacement and stress probes at all nodes of a thin, strongly curved shell:
// at vertices, on edges and on faces. Positions, and so displacements, have the
// round-off of sums of 20 terms of order one.
TEST(Probes, NodesOfThinCurvedCells)
{
  const auto affine = [](const Point<3> &x) {
    return Tensor<1, 3>({1 + x[0] - 2 * x[1], x[2] - 3 * x[0], x[1] + x[2]});
  };
  for (const unsigned int degree : {2u, 3u})
    {
      const SerialMesh        mesh = thin_shell(4, degree);
      std::vector<ProbePoint> points;
      for (const Point<3> &x : mesh.curved_nodes)
        points.push_back({"p" + std::to_string(points.size()), x});
      const MovingBody body(mesh, element_text(degree));
      const Probes     probes(points, body.discretization);
      const auto       values = probes.displacements(body.interpolate(affine));
      for (unsigned int p = 0; p < points.size(); ++p)
        EXPECT_LT((values[p] - affine(points[p].position)).norm(), 1e-13)
          << points[p].position;
      EXPECT_NO_THROW(StressProbes(points, body.discretization));
      EXPECT_THROW(Probes({{"a", {0, 0, 1}}}, body.discretization), InputError);
    }
}
