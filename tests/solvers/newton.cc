// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Newton's method on scalar equations whose roots are known.

#include <corotet/solvers/newton.h>

#include <gtest/gtest.h>

#include "../body.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // f(x) = 0 with a given approximation of f'(x).
  class Scalar : public NewtonProblem
  {
  public:
    Scalar(std::function<double(double)> f,
           std::function<double(double)> slope,
           const double                  start)
      : f(std::move(f))
      , slope(std::move(slope))
      , x(start)
    {}

    Norm
    residual(Vector &r) override
    {
      r = -f(x);
      return {std::abs(f(x)), 1.};
    }

    unsigned int
    solve_linearized(Vector &dx, const Vector &r) override
    {
      dx = r;
      dx *= 1 / slope(x);
      return 1;
    }

    Norm
    add(const double factor, const Vector &dx) override
    {
      x += factor * dx.local_element(0);
      return {std::abs(factor * dx.local_element(0)), std::abs(x)};
    }

    void
    keep() override
    {
      kept = x;
    }

    void
    restore() override
    {
      x = kept;
    }

    std::function<double(double)> f, slope;
    double                        x;
    double                        kept = 0;
  };

  NewtonReport
  solve(Scalar &problem, const double tolerance = 1e-12)
  {
    Newton newton;
    newton.residual_tolerance  = tolerance;
    newton.increment_tolerance = tolerance;
    NewtonReport report;
    newton.solve(problem, Vector(1), report);
    return report;
  }

  std::string
  failure(Scalar &problem)
  {
    try
      {
        solve(problem);
      }
    catch (const ComputationError &error)
      {
        return error.what();
      }
    return "it converged";
  }
} // namespace

TEST(Newton, QuadraticConvergence)
{
  Scalar root([](double x) { return x * x - 2; },
              [](double x) { return 2 * x; },
              1.);
  EXPECT_LE(solve(root).iterations, 6u);
  EXPECT_NEAR(root.x, std::sqrt(2.), 1e-12);
}

// With the slope frozen at 4 the error shrinks by |1 - f'/4| = 0.29 per
// iteration. The estimate of the error that is left must hold what it says.
TEST(Newton, LinearConvergenceIsEstimated)
{
  Scalar             root([](double x) { return x * x - 2; },
              [](double) { return 4.; },
              1.);
  const NewtonReport report = solve(root, 1e-6);
  EXPECT_LE(std::abs(root.x - std::sqrt(2.)), 1e-6 * std::sqrt(2.));
  // 0.29^11 < 1e-6 < 0.29^10, and the start is 0.41 away.
  EXPECT_GE(report.iterations, 9u);
  EXPECT_LE(report.iterations, 13u);
}

TEST(Newton, LinearProblemTakesOneIteration)
{
  Scalar line([](double x) { return 3 * x - 6; },
              [](double) { return 3.; },
              100.);
  EXPECT_EQ(solve(line).iterations, 1u);
  EXPECT_NEAR(line.x, 2, 1e-14);
  EXPECT_EQ(solve(line).iterations, 0u) << "a solved problem takes none";
}

// A residual that round-off keeps from shrinking: accepted if the problem says
// that it is round-off, else a failure.
TEST(Newton, RoundOffIsAccepted)
{
  class Noisy : public Scalar
  {
  public:
    using Scalar::Scalar;

    Norm
    residual(Vector &r) override
    {
      Norm norm = Scalar::residual(r);
      norm.value += 1e-9;
      norm.round_off = round_off;
      return norm;
    }

    double round_off = 0;
  };
  Noisy root([](double x) { return x * x - 2; },
             [](double x) { return 2 * x; },
             1.);
  EXPECT_EQ(failure(root).find("Newton's method found no descent"), 0u);
  root.x         = 1;
  root.round_off = 2e-9;
  EXPECT_LE(solve(root).iterations, 6u);
  EXPECT_NEAR(root.x, std::sqrt(2.), 1e-9);
}

TEST(Newton, Failures)
{
  Scalar no_root([](double x) { return x * x + 1; },
                 [](double x) { return 2 * x; },
                 1.1);
  EXPECT_EQ(failure(no_root).find("Newton's method "), 0u);
  EXPECT_NE(failure(no_root).find(": the residual is "), std::string::npos);
  Scalar slow([](double x) { return x; }, [](double) { return 50.; }, 1.);
  EXPECT_EQ(failure(slow).find("Newton's method converges too slowly"), 0u);
  Scalar not_finite([](double x) { return std::sqrt(x); },
                    [](double) { return 1.; },
                    -1.);
  EXPECT_EQ(failure(not_finite),
            "the forces are not finite in Newton iteration 0");
}
