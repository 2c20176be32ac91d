// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Newton's method where the exact tangent gives no descent and a definite
// tangent replaces it.

#include <corotet/base/exceptions.h>
#include <corotet/solvers/newton.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../memory_archive.h"
#include "scalar_problem.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // The gradient of the energy x^4 / 4 - x^2 / 2, with a definite tangent, 1,
  // or without one. At the start the exact slope 3 x^2 - 1 is -1e-4: its
  // direction leads up in energy, and 3,850 to the left, where the residual is
  // 1e11 times larger. That of the definite tangent leads down, to 1.
  class DoubleWell : public Scalar
  {
  public:
    explicit DoubleWell(const bool has_definite_tangent)
      : Scalar([](double x) { return x * x * x - x; },
               exact_slope,
               std::sqrt((1 - 1e-4) / 3))
      , has_definite_tangent(has_definite_tangent)
    {
      with_energy = true;
    }

    bool
    use_definite_tangent(const bool use) override
    {
      if (!has_definite_tangent)
        return false;
      if (use)
        slope = [](double) { return 1.; };
      else
        slope = exact_slope;
      return true;
    }

  private:
    static double
    exact_slope(const double x)
    {
      return 3 * x * x - 1;
    }

    const bool has_definite_tangent;
  };
} // namespace

// With an energy, a direction must be one of descent: where a search would go
// along one of ascent, the definite tangent replaces the exact one, once; then
// the exact one goes on with its order. Without a definite tangent the method
// fails.
TEST(Newton, DefiniteTangentStandsIn)
{
  DoubleWell         double_well(true);
  const NewtonReport report = solve(double_well);
  EXPECT_NEAR(double_well.x, 1, 1e-12) << report.text();
  ASSERT_GE(report.history.size(), 3u);
  EXPECT_TRUE(report.history[0].definite) << report.text();
  for (std::size_t k = 1; k < report.history.size(); ++k)
    EXPECT_FALSE(report.history[k].definite) << report.text();
  EXPECT_NEAR(report.observed_order(), 2, 0.1);

  DoubleWell indefinite(false);
  EXPECT_NE(failure(indefinite).find("found no descent along its direction"),
            std::string::npos);
}

namespace
{
  // x^2 - 2, whose exact slope cannot be used in the first iteration.
  class HardStart : public Scalar
  {
  public:
    explicit HardStart(const bool is_hard)
      : Scalar([](double x) { return x * x - 2; }, {}, 2)
      , is_hard(is_hard)
    {}

    bool
    use_definite_tangent(const bool use) override
    {
      is_definite = use;
      return true;
    }

    unsigned int
    solve_linearized(Vector       &dx,
                     const Vector &r,
                     const double  tolerance) override
    {
      if (is_hard && !is_definite && x == 2)
        {
          ++n_failed;
          throw ComputationError("too many iterations");
        }
      slope = [=, this](double x) { return is_definite ? 4. : 2 * x; };
      return Scalar::solve_linearized(dx, r, tolerance);
    }

    unsigned int n_failed = 0;

  private:
    const bool is_hard;
    bool       is_definite = false;
  };
} // namespace

// After a failure at the start of a solve, the exact tangent is not tried there
// for some solves; the pauses get longer, and a success makes it the first
// choice again.
TEST(Newton, PausesOfTheExactTangent)
{
  const NewtonParameters parameters;
  Newton                 newton(parameters), restarted(parameters);
  const auto             fails = [](Newton &method, const bool is_hard) {
    HardStart    problem(is_hard);
    NewtonReport report;
    method.solve(problem, Vector(1), report);
    EXPECT_NEAR(problem.x, std::sqrt(2.), 1e-8);
    EXPECT_FALSE(report.history.back().definite);
    return problem.n_failed > 0;
  };
  std::vector<unsigned int> failed;
  for (unsigned int n = 0; n < 60; ++n)
    {
      if (n == 3)
        {
          MemoryArchive archive;
          newton.transfer(archive);
          archive.reading = true;
          restarted.transfer(archive);
        }
      const bool has_failed = fails(newton, true);
      if (has_failed)
        failed.push_back(n);
      if (n >= 3)
        {
          EXPECT_EQ(fails(restarted, true), has_failed) << n;
        }
    }
  EXPECT_EQ(failed, (std::vector<unsigned int>{0, 2, 5, 10, 19, 36, 53}));
  for (unsigned int n = 60; n < 71; ++n)
    EXPECT_FALSE(fails(newton, false));
  EXPECT_TRUE(fails(newton, true));
  EXPECT_FALSE(fails(newton, true));
  EXPECT_TRUE(fails(newton, true));
}
