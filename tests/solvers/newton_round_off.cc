// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Newton's method ends at the round-off of residuals and increments, and for
// linear problems.

#include <gtest/gtest.h>

#include "scalar_problem.h"

using namespace corotet;
using namespace corotet::tests;

// A residual that round-off keeps from shrinking is accepted if the problem
// says that it is round-off; else it is a failure.
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

// A residual that may be round-off or not is only taken for round-off if an
// iteration has not reduced it.
TEST(Newton, PossibleRoundOffIsTriedFirst)
{
  class Doubtful : public Scalar
  {
  public:
    using Scalar::Scalar;

    Norm
    residual(Vector &r) override
    {
      Norm norm = Scalar::residual(r);
      norm.value += noise;
      // This bound of round-off is more than the residual at the start.
      norm.most_round_off = 2;
      return norm;
    }

    double noise = 0;
  };
  Doubtful root([](double x) { return x * x - 2; },
                [](double x) { return 2 * x; },
                1.);
  EXPECT_EQ(solve(root).round_off, NewtonReport::RoundOff::none);
  EXPECT_NEAR(root.x, std::sqrt(2.), 1e-9);
  root.x                    = 1;
  root.noise                = 1e-9;
  const NewtonReport report = solve(root);
  EXPECT_EQ(report.round_off, NewtonReport::RoundOff::of_residual);
  EXPECT_LE(report.iterations, 6u);
  EXPECT_NEAR(root.x, std::sqrt(2.), 1e-9);
}

// An increment below the round-off of x is the last one, whatever the residual.
TEST(Newton, RoundOffOfIncrementIsTheEnd)
{
  class Coarse : public Scalar
  {
  public:
    using Scalar::Scalar;

    Norm
    add(const double factor, const Vector &dx) override
    {
      Norm norm      = Scalar::add(factor, dx);
      norm.round_off = 1e-6;
      return norm;
    }
  };
  // The residual does not fall below 1e-3 near the start.
  Coarse root([](double x) { return x * x - 2 + (x < 1.5 ? 1e-3 : 0.); },
              [](double x) { return 1e5 * x; },
              1.4);
  const NewtonReport report = solve(root);
  EXPECT_EQ(report.iterations, 1u);
  EXPECT_EQ(report.round_off, NewtonReport::RoundOff::of_increment);
  EXPECT_NEAR(report.final_residual, std::abs(root.f(root.x)), 1e-15);
}

// The increment of a linear problem is not checked: a linear solver of the same
// tolerance leaves an error of that size.
TEST(Newton, LinearProblemIsSolvedOnce)
{
  class Line : public Scalar
  {
  public:
    using Scalar::Scalar;

    bool
    is_linear() const override
    {
      return linear;
    }

    bool linear = true;
  };
  // The slope is off by 2e-6, like the solution of an inexact linear solver.
  for (const bool linear : {true, false})
    {
      Line line([](double x) { return 1e-4 * (x - 1e3); },
                [](double) { return 1e-4 * (1 + 2e-6); },
                0.);
      line.linear = linear;
      EXPECT_EQ(solve(line, 1e-6).iterations, linear ? 1u : 2u);
      EXPECT_NEAR(line.x, 1e3, 1e-2);
    }
}
