// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Newton's method on scalar equations whose roots are known.

#include <corotet/solvers/newton.h>

#include <gtest/gtest.h>

#include "../body.h"
#include "../memory_archive.h"
#include "scalar_problem.h"

using namespace corotet;
using namespace corotet::tests;

TEST(Newton, QuadraticConvergence)
{
  Scalar             root([](double x) { return x * x - 2; },
              [](double x) { return 2 * x; },
              1.);
  const NewtonReport report = solve(root);
  EXPECT_LE(report.iterations, 6u);
  EXPECT_NEAR(root.x, std::sqrt(2.), 1e-12);
  tests::report("observed order", report.observed_order());
  EXPECT_NEAR(report.observed_order(), 2, 0.1);
}

// With the slope of the secant through the last two points the order is 1.618.
TEST(Newton, OrderOfTheSecantMethod)
{
  double             last_x = 2.1, last_f = last_x * last_x - 2;
  Scalar             root([](double x) { return x * x - 2; },
              [&](double x) {
                const double f     = x * x - 2;
                const double slope = (f - last_f) / (x - last_x);
                last_x             = x;
                last_f             = f;
                return slope;
              },
              2.);
  const NewtonReport report = solve(root);
  EXPECT_NEAR(root.x, std::sqrt(2.), 1e-12);
  tests::report("observed order", report.observed_order());
  EXPECT_NEAR(report.observed_order(), 1.62, 0.15);
}

// Linear convergence has order 1. The order is undefined if increments are not
// even halved, for only two iterations, and if steps were shortened.
TEST(Newton, OrderOfLinearConvergence)
{
  const auto order = [](const double slope) {
    Scalar root([](double x) { return x * x - 2; },
                [=](double) { return slope; },
                1.);
    return solve(root, 1e-6).observed_order();
  };
  EXPECT_NEAR(order(4.), 1, 0.05);
  EXPECT_TRUE(std::isnan(order(7.)));

  NewtonReport report;
  report.history = {{1e-3, 1e-2, 1., false, 1}, {1e-6, 1e-4, 1., false, 1}};
  EXPECT_TRUE(std::isnan(report.observed_order()));
  report.history.push_back({1e-12, 1e-8, 1., false, 1});
  EXPECT_NEAR(report.observed_order(), 2, 1e-12);
  // Increments of the size of round-off do not count for the order.
  report.history.push_back({1e-16, 1e-16, 1., false, 1});
  EXPECT_NEAR(report.observed_order(), 2, 1e-12);
  report.history[1].length = 0.5;
  EXPECT_TRUE(std::isnan(report.observed_order()));
}

TEST(Newton, TextOfTheReport)
{
  NewtonReport report;
  report.iterations        = 3;
  report.linear_iterations = 12;
  report.first_residual    = 1;
  report.history           = {{0.5, 0.1, 1., false, 2},
                              {0.25, 0.05, 0.25, false, 4},
                              {1e-3, 1e-2, 1., true, 6}};
  EXPECT_EQ(report.text(),
            "Newton 3 iterations, linear 12; residual 1.0e+00 5.0e-01 2.5e-01 "
            "1.0e-03; increment 1.0e-01 5.0e-02 (x 0.25) 1.0e-02 (frozen)");
  report.history = {{1e-2, 1e-2, 1., false, 2},
                    {1e-4, 1e-4, 1., false, 4},
                    {1e-8, 1e-8, 1., false, 6}};
  EXPECT_EQ(report.text(),
            "Newton 3 iterations, linear 12; residual 1.0e+00 1.0e-02 1.0e-04 "
            "1.0e-08; increment 1.0e-02 1.0e-04 1.0e-08; order 2.00");
}

// A solve tells the next one how many iterations to expect: each linear solve
// before the last one is only as accurate as a small part of what quadratic
// convergence will leave. The first solve, and all iterations from the expected
// last one on, get the full tolerance.
TEST(Newton, LinearSolvesAreAsGoodAsNeeded)
{
  NewtonParameters parameters;
  Newton           newton(parameters);
  const auto       solve_from = [&](Newton &method, const double start) {
    Scalar       root([](double x) { return x * x - 2; },
                [](double x) { return 2 * x; },
                start);
    NewtonReport report;
    Vector       x(1);
    method.solve(root, x, report);
    EXPECT_NEAR(root.x, std::sqrt(2.), 1e-8);
    return root.tolerances;
  };
  EXPECT_EQ(solve_from(newton, 3.), std::vector<double>(5, 0.));

  MemoryArchive archive;
  newton.transfer(archive);
  archive.reading = true;
  Newton restarted(parameters);
  restarted.transfer(archive);
  const std::vector<double> second = solve_from(newton, 5.);
  EXPECT_EQ(solve_from(restarted, 5.), second);
  ASSERT_EQ(second.size(), 6u);
  // Errors of half a digit, one, two and four digits of eight, times a factor.
  EXPECT_NEAR(second[0], 0.03 * std::pow(10, -0.5), 1e-15);
  EXPECT_NEAR(second[1], 0.03 * 1e-1, 1e-15);
  EXPECT_NEAR(second[2], 0.03 * 1e-2, 1e-16);
  EXPECT_NEAR(second[3], 0.03 * 1e-4, 1e-18);
  EXPECT_EQ(second[4], 0);
  EXPECT_EQ(second[5], 0);
}

// With the slope frozen at 4 the error shrinks by |1 - f'/4| = 0.29 per
// iteration. The estimated remaining error must be an upper bound.
TEST(Newton, LinearConvergenceIsEstimated)
{
  Scalar             root([](double x) { return x * x - 2; },
              [](double) { return 4.; },
              1.);
  const NewtonReport report = solve(root, 1e-6);
  EXPECT_LE(std::abs(root.x - std::sqrt(2.)), 1e-6 * std::sqrt(2.));
  // The number of iterations follows from 0.29^11 < 1e-6 < 0.29^10, with an
  // error of 0.41 at the start.
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

// The failure tells how many iterations would be needed and how many are left.
TEST(Newton, SlowConvergenceIsToldInNumbers)
{
  Scalar slow([](double x) { return x; }, [](double) { return 50.; }, 1.);
  const std::string text = failure(slow);
  EXPECT_NE(text.find("at the rate of its last 6 iterations it needs 1356 "
                      "more, and 38 of 50 are left"),
            std::string::npos)
    << text;
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

// A residual like that of a slender body: the first full step raises it by two
// orders of magnitude, and full steps from there reduce it quickly. There is no
// line search and no way back.
TEST(Newton, FullStepsThroughALargeResidual)
{
  // f is 0.9 (x - 1) below 1, and steep beyond: x - 1 + 1e4 (x - 1)^2. From 0
  // with the slope 0.81 the first step lands at 1.11.
  Scalar wall(
    [](double x) {
      return x < 1 ? 0.9 * (x - 1) : x - 1 + 1e4 * (x - 1) * (x - 1);
    },
    [](double x) { return x < 1 ? 0.81 : 1 + 2e4 * (x - 1); },
    0.);
  const NewtonReport report = solve(wall);
  EXPECT_NEAR(wall.x, 1, 1e-12);
  EXPECT_EQ(report.line_searches, 0u);
  EXPECT_EQ(wall.n_restored, 0u);
  EXPECT_GE(report.history[0].residual, 100 * report.first_residual);
  for (const NewtonIteration &iteration : report.history)
    EXPECT_EQ(iteration.length, 1.);
}

// atan(x) from 2: full steps diverge to ever larger |x|, so the watchdog
// returns to the start and searches, with and without an energy. With an energy
// it is more patient.
TEST(Newton, LineSearch)
{
  for (const auto &[start, with_energy] :
       {std::pair<double, bool>{2., false}, {2., true}, {20., true}})
    {
      Scalar root([](double x) { return std::atan(x); },
                  [](double x) { return 1 / (1 + x * x); },
                  start);
      root.with_energy          = with_energy;
      const NewtonReport report = solve(root);
      tests::report("iterations", report.iterations);
      EXPECT_NEAR(root.x, 0, 1e-12);
      EXPECT_GE(report.line_searches, 1u);
      EXPECT_GE(root.n_restored, 2u);
      unsigned int n_short = 0;
      for (const NewtonIteration &iteration : report.history)
        n_short += iteration.length < 1 ? 1 : 0;
      EXPECT_EQ(n_short, report.line_searches);
    }
}

// log(x) - 1 from 10: the first full step leads to x < 0, where there is no
// logarithm. The search shortens the step until there is one.
TEST(Newton, BacksOffFromWhatIsNotFinite)
{
  for (const bool with_energy : {false, true})
    {
      Scalar root([](double x) { return std::log(x) - 1; },
                  [](double x) { return 1 / x; },
                  10.);
      root.with_energy          = with_energy;
      const NewtonReport report = solve(root);
      EXPECT_NEAR(root.x, std::exp(1.), 1e-11);
      ASSERT_GE(report.history.size(), 1u);
      EXPECT_LT(report.history[0].length, 1.);
      // After a step to where the residual is not finite, a tenth of it is
      // tried.
      EXPECT_GE(report.line_searches, 1u);
      EXPECT_LE(report.line_searches, 4u);
      EXPECT_NEAR(report.observed_order(), 2, 0.1);
    }
}

// A linearly implicit solve takes one iteration, whatever the residual is then.
TEST(Newton, LinearlyImplicit)
{
  Scalar           root([](double x) { return x * x - 2; },
              [](double x) { return 2 * x; },
              1.);
  NewtonParameters parameters;
  parameters.linearly_implicit = true;
  NewtonReport report;
  Newton(parameters).solve(root, Vector(1), report);
  EXPECT_EQ(report.iterations, 1u);
  EXPECT_EQ(root.x, 1.5);
}
