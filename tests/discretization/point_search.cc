// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The search for points in cells: a point that the map of a cell gives is found
// again in that cell, also if it is thin and strongly curved; points beyond the
// surface belong to no cell.

#include <corotet/discretization/nearby_cells.h>
#include <corotet/discretization/point_search.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "../curved_mesh.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  class Search
  {
  public:
    explicit Search(const Discretization &discretization)
      : disc(discretization)
      , search(discretization)
      , nearby(discretization)
    {}

    // The map and its Jacobian.
    std::pair<Point<3>, Tensor<2, 3>>
    map(const unsigned int cell, const Point<3> &xi) const
    {
      const auto  &fe    = disc.finite_element().base_element(0);
      const auto   nodes = disc.cell_nodes(cell);
      Point<3>     x;
      Tensor<2, 3> J;
      for (unsigned int i = 0; i < nodes.size(); ++i)
        {
          x += fe.shape_value(i, xi) * disc.node_position(nodes[i]);
          J += outer_product(Tensor<1, 3>(disc.node_position(nodes[i])),
                             fe.shape_grad(i, xi));
        }
      return {x, J};
    }

    // Whether a cell of any rank contains the point; checks also that all cells
    // that contain it are among those near it. Collective.
    bool
    is_in_body(const Point<3> &x) const
    {
      unsigned int n = 0, n_nearby = 0;
      for (unsigned int c = 0; c < disc.n_owned_cells(); ++c)
        n += search.find(c, x).has_value() ? 1 : 0;
      for (const unsigned int c : nearby.cells(x))
        n_nearby += search.find(c, x).has_value() ? 1 : 0;
      EXPECT_EQ(n_nearby, n) << x;
      return dealii::Utilities::MPI::sum(n, disc.communicator()) > 0;
    }

    // Points on the nodes and at random places of every cell are found in it.
    // Round-off of positions, 1e-15 lengths of a cell, is 400 times larger in
    // coordinates across the thickness.
    void
    expect_found() const
    {
      std::mt19937                           random(1);
      std::uniform_real_distribution<double> unit(0, 1);
      std::vector<Point<3>>                  places = map_points(disc.degree());
      for (unsigned int i = 0; i < 20; ++i)
        {
          Point<3> xi(unit(random), unit(random), unit(random));
          while (xi[0] + xi[1] + xi[2] > 1)
            xi = Point<3>(unit(random), unit(random), unit(random));
          places.push_back(xi);
        }
      for (unsigned int c = 0; c < disc.n_owned_cells(); ++c)
        for (const Point<3> &xi : places)
          {
            const Point<3> x     = map(c, xi).first;
            const auto     found = search.find(c, x);
            ASSERT_TRUE(found) << "cell " << c << ", " << xi;
            EXPECT_LT(found->distance(xi), 1e-10) << "cell " << c << ", " << xi;
            const auto cells = nearby.cells(x);
            EXPECT_TRUE(std::binary_search(cells.begin(), cells.end(), c))
              << "cell " << c << ", " << xi;
          }
    }

    // Moves a point of each face of the surface along its normal, by fractions
    // of the size of its cell, and checks on which side it is.
    void
    expect_surface_is_sharp(const double size) const
    {
      std::vector<Point<3>> inside, outside;
      for (const BoundaryFace &face : disc.boundary_faces())
        {
          // Face f is opposite to vertex 3 - f.
          const unsigned int opposite = 3 - face.face;
          double             lambda[4];
          const double       in_face[3] = {0.5, 0.2, 0.3};
          for (unsigned int v = 0, k = 0; v < 4; ++v)
            lambda[v] = v == opposite ? 0 : in_face[k++];
          const Point<3> xi(lambda[1], lambda[2], lambda[3]);
          const auto [x, J] = map(face.cell, xi);
          Tensor<1, 3> towards;
          for (unsigned int k = 0; k < 3; ++k)
            if (opposite == 0)
              towards[k] = -1;
            else
              towards[k] = opposite == k + 1 ? 1 : 0;
          Tensor<1, 3> normal = towards * invert(J);
          normal /= -normal.norm();
          inside.push_back(x + 1e-9 * size * normal);
          inside.push_back(x - 1e-6 * size * normal);
          outside.push_back(x + 1e-6 * size * normal);
          outside.push_back(x + 1e-3 * size * normal);
        }
      check(inside, true);
      check(outside, false);
    }

  private:
    // Checks the points of all ranks on each rank. Collective.
    void
    check(const std::vector<Point<3>> &points, const bool expected) const
    {
      for (const auto &list :
           dealii::Utilities::MPI::all_gather(disc.communicator(), points))
        for (const Point<3> &x : list)
          EXPECT_EQ(is_in_body(x), expected) << x;
    }

    const Discretization &disc;
    const PointSearch     search;
    const NearbyCells     nearby;
  };
} // namespace

class ThinCells
  : public testing::TestWithParam<std::tuple<unsigned int, Element>>
{};

TEST_P(ThinCells, PointsAreFound)
{
  const auto &[n, element] = GetParam();
  const MovingBody body(thin_shell(n, element.degree()), element_text(element));
  const Search     search(body.discretization);
  search.expect_found();
  search.expect_surface_is_sharp(1. / n);
}

INSTANTIATE_TEST_SUITE_P(
  PointSearch,
  ThinCells,
  testing::Combine(testing::Values(4u, 8u),
                   testing::Values(Element(2),
                                   Element(3),
                                   Element::quadratic_with_bubbles())));

// Cells of ordinary shape, half of which are straight.
TEST(PointSearch, HalfCurvedBox)
{
  for (const auto &[q, element] : curved_elements)
    {
      const MovingBody body(half_curved_box(q), element_text(element));
      const Search     search(body.discretization);
      search.expect_found();
      search.expect_surface_is_sharp(0.5);
    }
}

// Distances, nodes and cells found for points in the body and around it are
// compared with a search through all cells and nodes; and the search considers
// few cells only.
TEST(NearbyCells, AreThoseOfAllCells)
{
  const MovingBody body(box("2, 1, 1", "20, 10, 10"), element_text(Element(2)));
  const Discretization                  &disc = body.discretization;
  const NearbyCells                      nearby(disc);
  std::mt19937                           random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  const double                           outside     = 0.2;
  std::size_t                            n_looked_at = 0;
  const unsigned int                     n_points    = 200;
  for (unsigned int k = 0; k < n_points; ++k)
    {
      const Point<3> x(3 * unit(random) - 0.5,
                       2 * unit(random) - 0.5,
                       2 * unit(random) - 0.5);
      double         distance = std::numeric_limits<double>::infinity();
      for (unsigned int n = 0; n < disc.n_owned_nodes(); ++n)
        distance = std::min(distance, disc.node_position(n).distance(x));
      EXPECT_DOUBLE_EQ(nearby.distance_to_nodes(x), distance);

      const double              reach = 1.5 * distance;
      std::vector<unsigned int> nodes, cells;
      for (unsigned int n = 0; n < disc.n_owned_nodes(); ++n)
        if (disc.node_position(n).distance(x) <= reach)
          nodes.push_back(n);
      EXPECT_EQ(nearby.nodes(x, reach), nodes);

      for (unsigned int c = 0; c < disc.n_owned_cells(); ++c)
        {
          const Tensor<1, 3> xi =
            disc.geometry(c).inverse_jacobian *
            (x - disc.node_position(disc.cell_nodes(c)[0]));
          if (std::min({xi[0], xi[1], xi[2], 1 - xi[0] - xi[1] - xi[2]}) >=
              -outside)
            cells.push_back(c);
        }
      const auto found = nearby.cells(x, outside);
      EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
      EXPECT_TRUE(
        std::includes(found.begin(), found.end(), cells.begin(), cells.end()))
        << x;
      n_looked_at += nearby.cells(x).size();
    }
  // Each box has 64 cells, and a point is in a few boxes only.
  EXPECT_LT(n_looked_at, 0.05 * n_points * disc.n_owned_cells());
}
