// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Probes: a displacement that the elements represent exactly (a polynomial of
// their degree) is found exactly anywhere in the body; a point outside is
// refused.

#include <corotet/output/probes.h>

#include <gtest/gtest.h>

#include <random>

#include "support.h"

using namespace corotet;
using namespace test_output;
using dealii::Point;
using dealii::Tensor;

namespace
{
  Tensor<1, 3>
  polynomial(const Point<3> &x, const unsigned int degree)
  {
    Tensor<1, 3> u;
    u[0] = 1 + std::pow(x[0] - 2 * x[1], degree);
    u[1] = std::pow(x[2], degree) - 3 * x[0];
    u[2] = std::pow(x[0] + x[1] + x[2], degree);
    return u;
  }
} // namespace

// The probes are 200 random points, the corners of the box, and vertices inside
// it. The tolerance is the round-off of 20 terms of order one, some 1e-15 each.
TEST(Probes, PolynomialIsExact)
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<ProbePoint>                points;
  for (unsigned int i = 0; i < 200; ++i)
    {
      const double a = unit(random), b = unit(random), c = unit(random);
      points.push_back({"p" + std::to_string(i), {a, 0.5 * b, 0.25 * c}});
    }
  for (const Point<3> &vertex : distorted_box().vertices)
    points.push_back({"p" + std::to_string(points.size()), vertex});

  for (const unsigned int degree : {1, 2, 3})
    {
      ModelBody body(degree);
      for (unsigned int n = 0; n < body.discretization.n_local_nodes(); ++n)
        {
          const Tensor<1, 3> u =
            polynomial(body.discretization.node_position(n), degree);
          for (unsigned int c = 0; c < 3; ++c)
            body.displacement.local_element(3 * n + c) = u[c];
        }
      const Probes probes(points, body.discretization);
      const auto   values = probes.displacements(body.displacement);
      ASSERT_EQ(values.size(), points.size());
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          EXPECT_EQ(probes.names()[p], points[p].name);
          EXPECT_LT((values[p] - polynomial(points[p].position, degree)).norm(),
                    2e-14)
            << points[p].position;
        }
    }
}

// A point on the surface, up to round-off, counts as inside; one beyond does
// not.
TEST(Probes, SurfaceBelongsToTheBody)
{
  ModelBody body(2);
  EXPECT_NO_THROW(Probes({{"a", {1 + 1e-12, 0.3, 0.1}}}, body.discretization));
  EXPECT_THROW(Probes({{"a", {1 + 1e-6, 0.3, 0.1}}}, body.discretization),
               InputError);
}

TEST(Probes, OutsideIsRefused)
{
  ModelBody body(1);
  try
    {
      const Probes probes({{"in", {0.5, 0.1, 0.1}}, {"tip", {1.5, 0.5, 0.25}}},
                          body.discretization);
      ADD_FAILURE() << "no error";
    }
  catch (const InputError &error)
    {
      EXPECT_EQ(error.entry, "Output/Probes");
      EXPECT_STREQ(error.what(),
                   "probe 'tip' at (1.5, 0.5, 0.25) lies outside the body, 0.5 "
                   "m from its nearest node; the body has x in [0, 1], y in "
                   "[0, 0.5], z in [0, 0.25] (m)");
    }
}

TEST(Probes, NoneIsFine)
{
  ModelBody    body(1);
  const Probes probes({}, body.discretization);
  EXPECT_TRUE(probes.displacements(body.displacement).empty());
}
