// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The size of displacements that errors of adaptive steps are compared with.

#include <corotet/simulation/size_of_motion.h>

#include <gtest/gtest.h>

#include "two_cubes.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  const Tensor<1, 3> apart({3., 0., 0.}), at_an_edge({1., 1., 0.});

  // A displacement whose mean is zero in each cube, plus translations of both.
  Vector
  motion(const MovingBody &body, const double first, const double second)
  {
    return body.interpolate([&](const Point<3> &x) {
      const bool   is_second = x[0] > 1;
      const double y         = is_second ? 3.5 : 0.5;
      return Tensor<1, 3>({0.1 * (x[0] - y), 0., is_second ? second : first});
    });
  }

  double
  size(const MovingBody &body, const Vector &u)
  {
    const auto springs =
      body.system.equation().terms.springs(body.reference, 0.);
    return SizeOfMotion(body, springs.get())(u);
  }
} // namespace

// Two cubes of which one is held: the translation of the other one does not
// count. Of free cubes no translation counts, each for itself.
TEST(SizeOfMotion, TranslationsOfFreeBodies)
{
  for (const std::string &text : {fixed("x-min"), std::string()})
    {
      const MovingBody body(two_cubes(apart), text);
      const double     alone = body.root_mean_square(motion(body, 0, 0));
      EXPECT_GT(alone, 0.01);
      EXPECT_NEAR(size(body, motion(body, 0, 10)), alone, 1e-13 * 10);
      if (text.empty())
        {
          EXPECT_NEAR(size(body, motion(body, -7, 10)), alone, 1e-13 * 10);
        }
      else
        {
          const Vector u = motion(body, -7, 0);
          EXPECT_NEAR(size(body, u), body.root_mean_square(u), 1e-13 * 7);
        }
    }
}

// Springs hold a body, and so does a body that it has an edge in common with.
TEST(SizeOfMotion, BodiesThatAreHeld)
{
  const auto expect_held = [](const MovingBody &body) {
    const Vector u = motion(body, 0, 10);
    EXPECT_EQ(size(body, u), body.root_mean_square(u));
  };
  expect_held(
    MovingBody(two_cubes(apart),
               fixed("x-min") +
                 section("Supports", {{"Elastic", "second x-max: 0; 0; 1"}})));
  expect_held(MovingBody(two_cubes(at_an_edge), fixed("x-min")));
}
