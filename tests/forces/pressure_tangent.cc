// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The derivative of follower pressures against differences of their force.

#include <gtest/gtest.h>

#include "../operators/random_states.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  // The force terms of a box of 1 x 2 x 1.
  struct UnderPressure : public MovingBody
  {
    UnderPressure(const Element      element,
                  const std::string &pressure,
                  const std::string &type = "corotational")
      : MovingBody(box("1, 2, 1", "2, 3, 2", 0.2),
                   element_text(element) + material_type(type) +
                     pressures(pressure))
    {}

    void
    linearize(const double time, const Vector &u)
    {
      system.equation().terms.linearize({time, u, u}, Tangent::consistent);
    }

    Vector
    force(const double time, const Vector &u)
    {
      Vector f(u);
      f.zero_out_ghost_values();
      system.equation().terms.external_force(f, {time, u, u}, 1.);
      return f;
    }

    Vector
    derivative(const Vector &v, const double factor)
    {
      Vector f(v);
      f.zero_out_ghost_values();
      f = 0;
      subtract(f, v, -factor);
      return f;
    }

    void
    subtract(Vector &f, const Vector &v, const double factor)
    {
      system.equation().terms.subtract_linearized(
        f, v, factor, 0., Tangent::consistent);
    }

    // A displacement that bends, stretches and shears every side.
    Vector
    shape() const
    {
      return interpolate([](const Point<3> &x) {
        return Tensor<1, 3>({std::sin(2 * x[1]) + 0.1 * x[0] * x[2],
                             0.3 * x[0] * x[2] - 0.2 * x[1],
                             std::cos(2 * x[0]) * x[1]});
      });
    }
  };
} // namespace

class PressureTangent : public testing::TestWithParam<Element>
{};

// A pressure that varies in space and time, on three sides that meet in edges.
// The force is quadratic in u, so central differences are exact up to their
// round-off, 1e-16 / 1e-2.
TEST_P(PressureTangent, IsTheDerivative)
{
  UnderPressure body(GetParam(),
                     "z-max: (1+x*y^2)*t, x-max: sin(3*y)+z, y-min: 2-x*z");
  const Vector  v = random_direction(body), u = body.shape();
  const double  t = 3, h = 1e-2, factor = -0.7;
  EXPECT_TRUE(body.system.equation().terms.follows_motion());
  Vector difference = body.force(t, moved(u, h, v));
  difference -= body.force(t, moved(u, -h, v));
  difference *= factor / (2 * h);
  body.linearize(t, u);
  const Vector found = body.derivative(v, factor);
  const double error =
    largest_difference(found, difference) / difference.linfty_norm();
  report("relative difference, " + std::to_string(GetParam().n_nodes()) +
           " nodes",
         error);
  EXPECT_GT(difference.linfty_norm(), 1e-2);
  EXPECT_LE(error, 1e-12);
}

// The derivative is added to the vector f.
TEST_P(PressureTangent, Adds)
{
  UnderPressure body(GetParam(), "z-max: 1+x");
  const Vector  v = random_direction(body);
  body.linearize(0., body.shape());
  const Vector once = body.derivative(v, 2.);
  Vector       twice(once);
  body.subtract(twice, v, -2.);
  twice.add(-2., once);
  EXPECT_LE(twice.linfty_norm(), 1e-14 * once.linfty_norm());
}

// A uniform pressure on the whole surface has a potential, the volume, so its
// derivative is symmetric. On a part of the surface it is not.
TEST_P(PressureTangent, SymmetricOnAClosedSurface)
{
  for (const bool closed : {true, false})
    {
      UnderPressure body(GetParam(), closed ? on_all_sides("7") : "x-max: 7");
      const Vector  v = random_direction(body), w = body.shape();
      body.linearize(0., body.shape());
      const Vector Kv = body.derivative(v, 1.), Kw = body.derivative(w, 1.);
      const double asymmetry = std::abs(w * Kv - v * Kw) / (norm(w) * norm(Kv));
      if (closed)
        EXPECT_LE(asymmetry, 1e-13);
      else
        EXPECT_GE(asymmetry, 1e-4);
    }
}

// In linear elasticity pressures act on the surface at rest, so they have no
// derivative.
TEST_P(PressureTangent, NoneInLinearElasticity)
{
  UnderPressure body(GetParam(), "z-max: 1", "linear");
  EXPECT_FALSE(body.system.equation().terms.follows_motion());
  EXPECT_FALSE(
    body.system.equation().terms.has_linearization(Tangent::consistent));
}

INSTANTIATE_TEST_SUITE_P(Elements,
                         PressureTangent,
                         testing::Values(Element(1),
                                         Element(2),
                                         Element(3),
                                         Element::quadratic_with_bubbles()));
