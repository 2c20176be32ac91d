// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Krylov methods for consistent tangents: symmetric indefinite and unsymmetric
// ones.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../body.h"
#include "../refusal.h"
#include "preconditioner_names.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  constexpr double tolerance = 1e-10;

  // A clamped bar of 4 x 1 x 1 in a state u, and its consistent tangent.
  struct Bar : public MovingBody
  {
    Bar(const unsigned int degree,
        const std::string &rotation,
        const std::string &method,
        const Entries      more = {})
      : MovingBody(box("4, 1, 1", "6, 2, 2", 0.1),
                   element_text(degree) + fixed("x-min") +
                     rotation_at(rotation) +
                     section("Newton", {{"Tangent", "consistent"}}) +
                     section("Linear solver",
                             {{"Method", method}, {"Tolerance", tolerance}}) +
                     section("Linear solver", more))
      , A(discretization, elasticity, mass, motion.is_prescribed())
      , J(A, elasticity, system.equation().terms)
    {}

    void
    linearize(const std::function<Tensor<1, 3>(const Point<3> &)> &displacement)
    {
      const Vector u = interpolate(displacement);
      elasticity.update_rotations(u);
      A.update(1., 0.);
      J.update({0., u, u}, Tangent::consistent, 1., 0.);
    }

    // A right hand side that is zero at supports; if it is axial, it does not
    // bend the bar at first.
    Vector
    load(const bool axial) const
    {
      Vector b = interpolate([axial](const Point<3> &x) {
        return axial ? Tensor<1, 3>({1., 0., 0.}) :
                       Tensor<1, 3>({std::sin(3 * x[0]), 1., x[1] * x[2]});
      });
      b.zero_out_ghost_values();
      motion.set_zero(b);
      return b;
    }

    struct Solution
    {
      Vector       x;
      unsigned int iterations;
      /// The relative residual |b - J x| / |b|.
      double residual;
    };

    Solution
    solve(const bool axial = false)
    {
      const Vector b = load(axial);
      Solution     solution{b, 0, 0};
      solution.iterations =
        LinearSolver(parameters.linear_solver)
          .solve(A, solution.x, b, discretization.node_positions(), &J);
      Vector r(b);
      J.vmult(r, solution.x);
      r -= b;
      solution.residual = norm(r) / norm(b);
      return solution;
    }

    // v . J v / |v| |J v| for the shape v in which a column buckles.
    double
    buckling_curvature() const
    {
      Vector v = interpolate([](const Point<3> &x) {
        return Tensor<1, 3>({-x[0] * (x[1] - 0.5), 0.5 * x[0] * x[0], 0.});
      });
      v.zero_out_ghost_values();
      motion.set_zero(v);
      Vector Jv(v);
      J.vmult(Jv, v);
      return (v * Jv) / (norm(v) * norm(Jv));
    }

    EffectiveOperator A;
    TangentOperator   J;
  };

  Tensor<1, 3>
  compressed(const Point<3> &x)
  {
    return Tensor<1, 3>({-0.2 * x[0], 0.05 * (x[1] - 0.5), 0.});
  }

  Tensor<1, 3>
  bent(const Point<3> &x)
  {
    const double angle = x[0] / 3;
    return Tensor<1, 3>({(3 - x[1]) * std::sin(angle) - x[0],
                         3 - (3 - x[1]) * std::cos(angle) - x[1],
                         0.02 * x[0] * x[2]});
  }
} // namespace

class Indefinite : public testing::TestWithParam<std::string>
{};

// Far beyond the buckling load, the bar's tangent has directions of negative
// curvature. All methods find the same solution; its residual is computed
// independently. The method "automatic" starts with conjugate gradients and
// goes on with MINRES.
TEST_P(Indefinite, AllMethodsAgree)
{
  for (const std::string &preconditioner : preconditioner_names())
    {
      // Jacobi needs thousands of iterations and tests nothing new.
      if (preconditioner == "jacobi")
        continue;
      Vector expected;
      for (const std::string method : {"minres", "gmres", "automatic"})
        {
          Bar bar(2, GetParam(), method, {{"Type", preconditioner}});
          bar.linearize(compressed);
          EXPECT_TRUE(bar.J.is_symmetric());
          EXPECT_LE(bar.buckling_curvature(), -1e-3);
          const Bar::Solution solution = bar.solve();
          report(fmt::format("iterations, {}, {}, {}",
                             GetParam(),
                             preconditioner,
                             method),
                 solution.iterations);
          EXPECT_LE(solution.residual, 1.01 * tolerance) << method;
          if (method == "minres")
            expected = solution.x;
          // The condition number of this bar is below 1e5.
          EXPECT_LE(largest_difference(solution.x, expected),
                    1e-5 * expected.linfty_norm())
            << method;
        }
    }
}

// Where negative curvature is found late, MINRES starts from the solution that
// conjugate gradients have reached.
TEST_P(Indefinite, MinresGoesOn)
{
  Vector expected;
  for (const bool automatic : {false, true})
    {
      Bar bar(2, GetParam(), automatic ? "automatic" : "minres");
      bar.linearize(compressed);
      const Bar::Solution solution = bar.solve(true);
      report(fmt::format("iterations, {}, axial load, {}",
                         GetParam(),
                         automatic ? "automatic" : "minres"),
             solution.iterations);
      EXPECT_LE(solution.residual, 1.01 * tolerance);
      if (!automatic)
        expected = solution.x;
      const double difference = largest_difference(solution.x, expected);
      EXPECT_LE(difference, 1e-5 * expected.linfty_norm());
      // If "automatic" had used MINRES from the start, every digit would be
      // equal.
      EXPECT_EQ(difference > 0, automatic);
    }
}

INSTANTIATE_TEST_SUITE_P(Rotations,
                         Indefinite,
                         testing::Values("quadrature points",
                                         "cell centre, variational"));

// With one rotation per cell above degree 1 the tangent is unsymmetric: GMRES
// is used, also by "automatic".
TEST(Unsymmetric, Gmres)
{
  Vector expected;
  for (const std::string method : {"gmres", "automatic"})
    {
      Bar bar(2, "cell centre", method);
      bar.linearize(bent);
      EXPECT_FALSE(bar.J.is_symmetric());
      const Bar::Solution solution = bar.solve();
      report("iterations, " + method, solution.iterations);
      EXPECT_LE(solution.residual, 1.01 * tolerance);
      if (method == "gmres")
        expected = solution.x;
      EXPECT_EQ(largest_difference(solution.x, expected), 0.);
    }
}

// With a positive tangent "automatic" uses conjugate gradients to the end: the
// numbers of iterations are equal.
TEST(Positive, ConjugateGradientsGoOn)
{
  unsigned int iterations[2];
  for (const bool automatic : {false, true})
    {
      Bar bar(2,
              "quadrature points",
              automatic ? "automatic" : "conjugate gradients");
      bar.linearize(
        [](const Point<3> &x) { return Tensor<1, 3>({0.05 * x[0], 0., 0.}); });
      const Bar::Solution solution = bar.solve();
      EXPECT_LE(solution.residual, 1.01 * tolerance);
      iterations[automatic] = solution.iterations;
    }
  EXPECT_EQ(iterations[0], iterations[1]);
}

// Methods and operators that do not fit the tangent are refused before anything
// is computed.
TEST(Unsymmetric, Refusals)
{
  const std::string not_symmetric =
    "Linear solver/Method: found {}; allowed: automatic or gmres, as this "
    "tangent is not symmetric";
  for (const std::string method : {"conjugate gradients", "minres"})
    EXPECT_EQ(refusal([&] { Bar(2, "cell centre", method); }),
              fmt::format(fmt::runtime(not_symmetric), method));
  EXPECT_EQ(refusal([] { Bar(1, "cell centre", "conjugate gradients"); }),
            "nothing was refused");
  EXPECT_EQ(refusal([] { Bar(2, "quadrature points", "minres"); }),
            "nothing was refused");
  for (const std::string rotation : {"quadrature points", "cell centre"})
    EXPECT_EQ(
      refusal([&] {
        Bar(2, rotation, "automatic", {{"Operator", "assembled"}});
      }).find("Linear solver/Operator: found assembled; allowed: matrix-free"),
      0u);
}
