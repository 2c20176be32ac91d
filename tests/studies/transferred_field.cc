// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A field on one mesh that is evaluated in the cells of another: polynomials of
// the elements' degree are reproduced wherever a rank has such cells, and so
// are their norms.

#include <corotet/discretization/point_search.h>
#include <corotet/operators/error_norms.h>
#include <corotet/studies/transferred_field.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>

#include "body.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;

namespace
{
  PointDisplacement
  cubic(const Point<3> &x)
  {
    PointDisplacement u;
    u.value[0]       = x[0] * x[0] * x[1];
    u.value[1]       = x[2];
    u.value[2]       = 1 - x[1] * x[1] * x[1];
    u.gradient[0][0] = 2 * x[0] * x[1];
    u.gradient[0][1] = x[0] * x[0];
    u.gradient[1][2] = 1;
    u.gradient[2][1] = -3 * x[1] * x[1];
    return u;
  }
} // namespace

TEST(TransferredField, ReproducesPolynomials)
{
  const MovingBody body(box("1, 1, 1", "3, 3, 3", 0.2),
                        element_text(Element(3)));
  const Vector     u =
    body.interpolate([](const Point<3> &x) { return cubic(x).value; });
  // The other mesh has other cells, distributed differently over ranks.
  const MovingBody other(box("1, 1, 1", "4, 5, 6"), element_text(Element(2)));
  const Discretization  &target = other.discretization;
  const TransferredField field(body.discretization, u, target);
  const auto             expect_cubic = [&](const Point<3> &x) {
    const PointDisplacement found = field.value(x);
    // The tolerance is some ten times the round-off of coordinates, shape
    // functions and their sum.
    EXPECT_LT((found.value - cubic(x).value).norm(), 1e-14) << x;
    EXPECT_LT((found.gradient - cubic(x).gradient).norm(), 1e-13) << x;
  };
  for (unsigned int c = 0; c < target.n_owned_cells(); ++c)
    for (const unsigned int n : target.cell_nodes(c))
      {
        Point<3> x = target.node_position(n);
        if (x[0] == 1)
          x[0] += 1e-15;
        expect_cubic(x);
      }
  // Corners, sides, inner points, and one that is outside by round-off: at
  // least one rank with a cell at the point finds it.
  const PointSearch search(target);
  for (const Point<3> x : {Point<3>(0, 0, 0),
                           Point<3>(1, 1, 1),
                           Point<3>(1, 0.3, 0.77),
                           Point<3>(0.123, 0.456, 0.789),
                           Point<3>(1 + 1e-15, 0.5, 0.5),
                           Point<3>(0.9, 0.1, 0.2)})
    {
      unsigned int n_found = 0;
      for (unsigned int c = 0; c < target.n_owned_cells(); ++c)
        if (search.find(c, x))
          {
            expect_cubic(x);
            ++n_found;
          }
      EXPECT_GT(dealii::Utilities::MPI::sum(n_found, MPI_COMM_WORLD), 0u) << x;
    }
}

// The rule is exact for these functions: their integrals over the unit cube
// were computed by hand.
TEST(ErrorNorms, ExactForPolynomials)
{
  const MovingBody body(box("1, 1, 1", "2, 2, 2", 0.2),
                        element_text(Element(3)));
  const Vector     u =
    body.interpolate([](const Point<3> &x) { return cubic(x).value; });
  const auto      &materials = body.materials;
  const ErrorNorms exact =
    error_norms(body.discretization, materials, u, cubic);
  EXPECT_LT(exact.error.L2, 1e-14);
  EXPECT_LT(exact.error.H1, 1e-13);
  EXPECT_NEAR(exact.reference.L2,
              std::sqrt(1. / 15 + 1. / 3 + 1 - 2. / 4 + 1. / 7),
              1e-14);
  EXPECT_NEAR(exact.reference.H1,
              std::sqrt(4. / 9 + 1. / 5 + 1 + 9. / 5),
              1e-14);
  // A uniaxial strain of one has eps : C : eps = lambda + 2 mu.
  const ErrorNorms strained =
    error_norms(body.discretization, materials, u, [](const Point<3> &x) {
      PointDisplacement v = cubic(x);
      v.value[0] += x[0];
      v.gradient[0][0] += 1;
      return v;
    });
  const IsotropicMaterial &material = materials.begin()->second;
  EXPECT_NEAR(strained.error.L2, std::sqrt(1. / 3), 1e-14);
  EXPECT_NEAR(strained.error.energy,
              std::sqrt(material.lambda + 2 * material.mu),
              1e-13 * std::sqrt(material.lambda));
}
