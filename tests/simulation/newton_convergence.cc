// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Newton's method in statics with large rotations: the observed order with the
// consistent tangent, and the iterations with the frozen one.

#include <corotet/time_integration/load_stepping.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../all_laws.h"
#include "../body.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // Linear convergence takes hundreds of iterations; the limit is lower where
  // they are expensive.
  unsigned int
  max_iterations(const unsigned int degree)
  {
    return degree == 3 ? 100 : 300;
  }

  // Laws that need at most ten iterations for the step from 40 to 80 degrees.
  bool
  takes_far_steps(const NamedLaw &law)
  {
    return law.name == "corotational, quadrature points" ||
           law.name == "corotational, cell centre";
  }

  // A clamped bar of 1 x 0.1 x 0.1 under a dead traction at its tip,
  // multiplied by the time.
  struct Cantilever : public MovingBody
  {
    // The tip rotates by 40 degrees under the traction @p first, by 80 degrees
    // under @p second: P L^2 / EI is some 1.7 and 8.7 (elastica); linear
    // tetrahedra are far stiffer in bending.
    static constexpr double
    first(const unsigned int degree)
    {
      return degree == 1 ? 2.6 * EI / A : 1.7 * EI / A;
    }

    static constexpr double
    second(const unsigned int degree)
    {
      return degree == 1 ? 13 * EI / A : 8.7 * EI / A;
    }

    Cantilever(const unsigned int degree,
               const NamedLaw    &law,
               const std::string &tangent)
      : MovingBody(box("1, 0.1, 0.1", degree == 1 ? "20, 2, 2" : "10, 1, 1"),
                   element_text(degree) + law.text + material_text(E) +
                     fixed("x-min") + tractions("x-max: 0; 0; t") +
                     section("Newton",
                             {{"Tangent", tangent},
                              {"Maximum iterations", max_iterations(degree)}}) +
                     newton_tolerances(1e-12) + linear_solver("direct", 1e-12))
    {
      load_stepping.proportional = false;
    }

    StageReport
    load(const double from, const double to)
    {
      return load_stepping.step(system, {from, to - from, 1.}, state);
    }

    // The largest rotation of a cell [degrees].
    double
    angle()
    {
      system.equation().evaluate(state, 0., 1.);
      double largest = 0;
      for (const double cell :
           elasticity.cell_results(system.equation().displacement())
             .rotation_angle)
        largest = std::max(largest, cell);
      return dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD) * 180 /
             dealii::numbers::PI;
    }

    static constexpr double E = 1e6, A = 0.01, EI = E * A * A / 12;

    LoadStepping load_stepping;
  };
} // namespace

class NewtonConvergence
  : public testing::TestWithParam<std::tuple<unsigned int, unsigned int>>
{};

// The bar goes from 40 to 80 degrees in a single step.
TEST_P(NewtonConvergence, QuadraticWithTheConsistentTangent)
{
  const auto &[degree, number] = GetParam();
  const NamedLaw &law          = nonlinear_laws()[number];
  if (!takes_far_steps(law))
    GTEST_SKIP() << "takes more iterations for so large a step";
  const double      first  = Cantilever::first(degree);
  const double      second = Cantilever::second(degree);
  const std::string what   = fmt::format(", P{}, {}", degree, law.name);

  Cantilever body(degree, law, "consistent");
  Cantilever frozen(degree, law, "frozen rotation");
  for (const double part : {0., 0.25, 0.5, 0.75})
    body.load(part * first, (part + 0.25) * first);
  EXPECT_NEAR(body.angle(), 40, 2);
  frozen.state = body.state;

  const StageReport exact = body.load(first, second);
  EXPECT_NEAR(body.angle(), 80, 2);
  report("observed order" + what, exact.order);
  report("iterations" + what, exact.newton_iterations);
  EXPECT_GE(exact.order, 1.8);
  EXPECT_LE(exact.newton_iterations, 10u);

  // The frozen tangent takes far more iterations, or too many. One rank is
  // enough to check this.
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  try
    {
      const StageReport linear = frozen.load(first, second);
      report("iterations with the frozen tangent" + what,
             linear.newton_iterations);
      EXPECT_GE(linear.newton_iterations, 10 * exact.newton_iterations);
      // Both reach the same equilibrium, to their tolerance.
      EXPECT_LE(largest_difference(frozen.state.u, body.state.u), 1e-9);
    }
  catch (const ComputationError &error)
    {
      report("no convergence of the frozen tangent within" + what,
             max_iterations(degree));
    }
}

// Hyperelastic laws take more iterations where a body rotates far in one step,
// so the step is smaller; near the solution all laws converge equally fast.
TEST_P(NewtonConvergence, QuadraticNearTheSolution)
{
  const auto &[degree, number] = GetParam();
  const NamedLaw &law          = nonlinear_laws()[number];
  if (law.name.starts_with("corotational"))
    GTEST_SKIP() << "is at round-off too soon for an order";
  const double first = Cantilever::first(degree);
  Cantilever   body(degree, law, "consistent");
  for (const double part : {0., 0.25, 0.5, 0.75})
    body.load(part * first, (part + 0.25) * first);
  const StageReport exact = body.load(first, 1.2 * first);
  const std::string what  = fmt::format(", P{}, {}", degree, law.name);
  report("observed order" + what, exact.order);
  report("iterations" + what, exact.newton_iterations);
  EXPECT_GE(exact.order, 1.8);
  EXPECT_LE(exact.newton_iterations, 6u);
}

INSTANTIATE_TEST_SUITE_P(
  All,
  NewtonConvergence,
  testing::Combine(testing::Values(1u, 2u, 3u),
                   testing::Range<unsigned int>(0, nonlinear_laws().size())));
