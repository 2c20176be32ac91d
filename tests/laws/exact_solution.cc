// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Body forces from an exact displacement, compared with differences of the
// stress; other tests check the stress.

#include <corotet/base/exceptions.h>
#include <corotet/laws/linear.h>
#include <corotet/material/exact_solution.h>

#include <gtest/gtest.h>

#include <cmath>

#include "../all_laws.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  // A displacement that rotates by about 90 degrees, and stretches and shears
  // by some ten percent.
  const std::string text = "-x - y - t^2*0.2*sin(3*x+y)*cos(z); x - y + "
                           "t^2*0.15*cos(2*y-x+z); t^3*0.1*sin(2*x+y)*exp(z)";

  const IsotropicMaterial material = isotropic_material(10., 0.3, 2.);
  const Point<3>          x(0.2, 0.4, 0.3);
  const double            t = 0.8;

  // The divergence of the stress by central differences of fourth order: their
  // error is about h^4 = 1e-12 times derivatives of size 100, and their
  // round-off 1e-15 / h.
  Tensor<1, 3>
  divergence_by_differences(const ExactSolution &solution,
                            const MaterialLaw   &law)
  {
    const double h = 1e-3;
    Tensor<1, 3> result;
    for (unsigned int b = 0; b < 3; ++b)
      {
        const auto stress = [&](const double offset) {
          Point<3> y = x;
          y[b] += offset;
          return solution.stress(material, law, y, t);
        };
        const Tensor<2, 3> derivative =
          (8. * (stress(h) - stress(-h)) - (stress(2 * h) - stress(-2 * h))) /
          (12 * h);
        for (unsigned int a = 0; a < 3; ++a)
          result[a] += derivative[a][b];
      }
    return result;
  }
} // namespace

TEST(ExactSolution, Displacement)
{
  const ExactSolution solution(text);
  EXPECT_TRUE(solution.depends_on_time());
  EXPECT_FALSE(ExactSolution("x; y; z^2").depends_on_time());
  const auto u = solution.displacement(x, t);
  EXPECT_NEAR(u[2],
              std::pow(t, 3) * 0.1 * std::sin(0.8) * std::exp(0.3),
              1e-15);
  const auto grad_u = solution.gradient(x, t);
  EXPECT_NEAR(grad_u[2][0],
              std::pow(t, 3) * 0.2 * std::cos(0.8) * std::exp(0.3),
              1e-15);
  EXPECT_NEAR(grad_u[2][2], u[2], 1e-15);
  const Expression velocity(solution.velocity_text(), 3, "Entry");
  EXPECT_NEAR(velocity.vector_value(x, t)[2], 3 * u[2] / t, 1e-14);
}

TEST(ExactSolution, BodyForce)
{
  const ExactSolution solution(text);
  for (const NamedLaw &named : all_laws())
    {
      const MaterialLaw &law        = *named.law;
      const auto         divergence = divergence_by_differences(solution, law);
      const auto         statics =
        solution.body_force(material, law, /* with_inertia = */ false, x, t);
      const auto dynamics =
        solution.body_force(material, law, /* with_inertia = */ true, x, t);
      for (unsigned int a = 0; a < 3; ++a)
        EXPECT_NEAR(statics[a], -divergence[a], 1e-9) << named.name;
      // u_z is of third order in t.
      EXPECT_NEAR(dynamics[2] - statics[2],
                  material.density * 6 * solution.displacement(x, t)[2] /
                    (t * t),
                  1e-13);
    }
}

// A rigid motion has stress in linear elasticity only.
TEST(ExactSolution, RigidMotion)
{
  const ExactSolution solution(
    "x*(cos(t)-1) - y*sin(t); x*sin(t) + y*(cos(t)-1); 1");
  for (const NamedLaw &law : nonlinear_laws())
    {
      // The tolerance is some ten roundings of F, 1e-16 each, times moduli of
      // some 10 Pa.
      EXPECT_LT(solution.stress(material, *law.law, x, t).norm(), 1e-14);
      EXPECT_LT(solution.body_force(material, *law.law, false, x, t).norm(),
                1e-13);
    }
  EXPECT_GT(solution.stress(material, *linear_law(), x, t).norm(), 1.);
}

TEST(ExactSolution, Refusal)
{
  EXPECT_THROW(ExactSolution("x; y"), InputError);
  EXPECT_THROW(ExactSolution("x; y; abs(z)"), InputError);
}
