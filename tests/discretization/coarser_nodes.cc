// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The nodes of the next coarser element: positions, ownership, and the
// embedding of coarser functions in finer ones.

#include <corotet/discretization/coarser_nodes.h>
#include <corotet/discretization/tetrahedron.h>

#include <gtest/gtest.h>

#include "../body.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  class CoarserNodesTest : public testing::TestWithParam<Element>
  {
  protected:
    CoarserNodesTest()
      : log(MPI_COMM_WORLD, true)
      , mesh(box("2, 1, 1", "4, 2, 3", 0.2), 0, 1., MPI_COMM_WORLD, log)
      , fine(mesh, GetParam())
      , coarse(fine)
    {}

    // Interpolates a function at the coarser nodes, whose positions follow from
    // the vertices of the cells.
    Vector
    interpolate(const std::function<Tensor<1, 3>(const Point<3> &)> &function)
    {
      Vector u;
      coarse.initialize_vector(u);
      for (unsigned int c = 0; c < coarse.n_local_cells(); ++c)
        for (unsigned int i = 0; i < coarse.n_nodes_per_cell(); ++i)
          {
            const auto at = [&](const unsigned int v) {
              return fine.node_position(fine.cell_nodes(c)[v]);
            };
            Point<3> x = at(std::min(i, 3u));
            if (i >= 4)
              x = (at(tetrahedron::edges[i - 4][0]) +
                   Tensor<1, 3>(at(tetrahedron::edges[i - 4][1]))) /
                  2;
            const unsigned int n = coarse.cell_nodes(c)[i];
            for (unsigned int a = 0; a < 3; ++a)
              u.local_element(3 * n + a) = function(x)[a];
          }
      return u;
    }

    Log            log;
    Mesh           mesh;
    Discretization fine;
    CoarserNodes   coarse;
  };

  Tensor<1, 3>
  polynomial(const Point<3> &x, const unsigned int degree)
  {
    Tensor<1, 3> u({x[0] - 2 * x[1], 1 + x[2], 3 * x[1]});
    if (degree > 1)
      u += Tensor<1, 3>({x[0] * x[1], x[2] * x[2] - x[1] * x[2], x[0] * x[0]});
    return u;
  }
} // namespace

// The number of nodes is deal.II's, and each node has one owner.
TEST_P(CoarserNodesTest, AreThoseOfTheElement)
{
  const Discretization same(mesh, GetParam().coarser());
  EXPECT_EQ(coarse.n_global_nodes(), same.n_global_nodes());
  EXPECT_EQ(coarse.degree(), same.degree());
  EXPECT_EQ(coarse.n_local_cells(), same.n_local_cells());
  // The coarser node at a vertex has the number of the finer node there as key.
  for (unsigned int c = 0; c < coarse.n_local_cells(); ++c)
    for (unsigned int v = 0; v < 4; ++v)
      EXPECT_EQ(coarse.key(coarse.cell_nodes(c)[v]), fine.cell_nodes(c)[v]);
}

// A coarser polynomial is the same function on the finer nodes.
TEST_P(CoarserNodesTest, EmbeddingIsExact)
{
  Vector u, expected;
  fine.initialize_vector(u);
  fine.initialize_vector(expected);
  const auto function = [](const Point<3> &x) {
    return polynomial(x, GetParam().coarser().degree());
  };
  for (unsigned int n = 0; n < fine.n_owned_nodes(); ++n)
    for (unsigned int a = 0; a < 3; ++a)
      {
        u.local_element(3 * n + a) = 1;
        expected.local_element(3 * n + a) =
          1 + function(fine.node_position(n))[a];
      }
  Vector coarse_u = interpolate(function);
  // prolongate_add() needs ghost values, which their owners send.
  coarse_u.zero_out_ghost_values();
  coarse_u.update_ghost_values();
  coarse.prolongate_add(u, coarse_u);
  // The round-off of values of O(10).
  EXPECT_LE(largest_difference(u, expected), 1e-13);
}

// Restriction is the transpose: (P c, f) = (c, P^T f).
TEST_P(CoarserNodesTest, RestrictionIsTheTranspose)
{
  Vector f, Pc, r;
  fine.initialize_vector(f);
  fine.initialize_vector(Pc);
  coarse.initialize_vector(r);
  Vector c = interpolate(
    [](const Point<3> &x) { return Tensor<1, 3>({x[0] * x[1], 2., x[2]}); });
  for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
    f.local_element(i) = std::cos(i);
  c.zero_out_ghost_values();
  c.update_ghost_values();
  coarse.prolongate_add(Pc, c);
  c.zero_out_ghost_values();
  coarse.restrict_to(r, f);
  EXPECT_NEAR((Pc * f) / (c * r), 1., 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Elements,
                         CoarserNodesTest,
                         testing::Values(Element(2),
                                         Element(3),
                                         Element::quadratic_with_bubbles()));
