// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The central difference method: its stable step, and motions just below and
// above it.

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../refusal.h"
#include "complete_run.h"
#include "stable_step.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  // The largest angular frequency of the linear body, from all eigenvalues.
  double
  exact_frequency(MovingBody &body)
  {
    const unsigned int               n = body.state.u.size();
    dealii::LAPACKFullMatrix<double> K(n), M(n);
    Vector                           unit(body.state.u), column(unit);
    for (unsigned int j = 0; j < n; ++j)
      {
        unit                  = 0;
        unit.local_element(j) = 1;
        const auto &fixed     = body.motion;
        fixed.set_zero(unit);
        body.elasticity.apply_tangent(column, unit);
        fixed.set_zero(column);
        for (unsigned int i = 0; i < n; ++i)
          K(i, j) = column.local_element(i);
        unit.local_element(j) = 1;
        body.mass.apply(column, unit);
        // Fixed unknowns must not share mass with others.
        if (fixed.is_prescribed()[j])
          column = 0;
        fixed.set_zero(column);
        if (fixed.is_prescribed()[j])
          column.local_element(j) = 1;
        for (unsigned int i = 0; i < n; ++i)
          M(i, j) = column.local_element(i);
      }
    // The largest eigenvalue lambda of K x = lambda M x.
    std::vector<dealii::Vector<double>> eigenvectors(1,
                                                     dealii::Vector<double>(n));
    K.compute_generalized_eigenvalues_symmetric(M, eigenvectors);
    double largest = 0;
    for (unsigned int i = 0; i < n; ++i)
      largest = std::max(largest, std::real(K.eigenvalue(i)));
    return std::sqrt(largest);
  }

  // Steps of the central difference method, with additional entries.
  std::string
  steps(const double end, const double step, const Entries own = {})
  {
    return time_integration("central difference",
                            end,
                            step,
                            {section("central difference", own)});
  }

  // A free bar that is bent, twisted and stretched, and spins.
  std::string
  spinning_bar(const unsigned int degree,
               const std::string &mass,
               const std::string &integration,
               const double       amplitude = 1)
  {
    return box_mesh("2, 1, 1", "2, 1, 1") + element_text(degree, mass) +
           rotation_at("quadrature points") + material_text(2e6) +
           initial_conditions(
             fmt::format("{0}*0.01*x^2; {0}*0.02*y*z; {0}*0.02*x*y", amplitude),
             fmt::format("-{0}*3*y; {0}*3*x; {0}*0.5*x^2", amplitude)) +
           integration;
  }
} // namespace

class StableStep
  : public testing::TestWithParam<std::tuple<unsigned int, std::string>>
{};

// The estimate is above the exact frequency by at most the tolerance, 1e-3.
TEST_P(StableStep, LargestFrequency)
{
  if (!on_one_rank())
    GTEST_SKIP();
  const auto &[degree, mass] = GetParam();
  MovingBody   body(box("2, 1, 1", "2, 1, 1", 0.),
                  element_text(degree, mass) + material_type("linear") +
                    fixed("x-min"));
  const double estimate =
    body.system.acceleration_solver().largest_frequencies(body.state).all;
  const double exact = exact_frequency(body);
  report("estimate / exact", estimate / exact);
  EXPECT_GE(estimate, exact * (1 - 1e-10));
  EXPECT_LE(estimate, exact * 1.001);
}

INSTANTIATE_TEST_SUITE_P(
  DegreesAndMasses,
  StableStep,
  testing::Values(std::make_tuple(1u, "consistent"),
                  std::make_tuple(1u, "row sum"),
                  std::make_tuple(1u, "diagonal scaling"),
                  std::make_tuple(2u, "consistent"),
                  std::make_tuple(2u, "diagonal scaling"),
                  std::make_tuple(3u, "consistent"),
                  std::make_tuple(3u, "diagonal scaling")));

// The frequency is proportional to 1 / sqrt(density), to the tolerance of the
// estimate, in any units: squares of frequencies are from 1e-40 to 1e40 times
// the usual ones.
TEST(Explicit, FrequencyInAnyUnits)
{
  const auto frequency = [](const double density) {
    MovingBody body(box("2, 1, 1", "4, 2, 2", 0.2),
                    element_text(2, "diagonal scaling") +
                      section("Material", {{"Density", density}}));
    return body.system.acceleration_solver()
      .largest_frequencies(body.state)
      .all;
  };
  const double expected = frequency(1000);
  for (const double factor : {1e-40, 1e-20, 1e-10, 1e10, 1e20, 1e40})
    EXPECT_NEAR(frequency(1000 * factor) * std::sqrt(factor) / expected,
                1,
                1e-3)
      << factor;
}

class Explicit : public testing::TestWithParam<unsigned int>
{};

// In 100,000 steps of 0.9 of the stable step, the energy of a free body that
// spins and vibrates changes by less than a percent. Within that it changes by
// second order in the step, and moves as energy spreads to the fast modes.
TEST_P(Explicit, EnergyDoesNotDrift)
{
  if (!on_one_rank())
    GTEST_SKIP();
#ifdef DEBUG
  const unsigned int n_steps = 2000;
#else
  const unsigned int n_steps = 100000;
#endif
  const unsigned int degree = GetParam();
  const std::string  mass   = "diagonal scaling";
  const double       dt =
    0.9 * stable_step(spinning_bar(degree, mass, steps(1, 1e-9)));
  CompleteRun run(spinning_bar(degree, mass, steps(n_steps * dt, dt)));
  ASSERT_EQ(run.run({100, 0.}), "");
  EXPECT_EQ(run.recorder().summary.steps, n_steps);
  const auto  &records = run.recorder().records;
  const double total   = records[0].kinetic_energy + records[0].elastic_energy;
  double       largest = 0;
  for (const StepRecord &record : records)
    largest = std::max(largest, std::abs(record.energy_balance));
  report(fmt::format("largest change of energy, P{}", degree), largest / total);
  EXPECT_LE(largest, 0.01 * total);
  // Every step conserves both momenta.
  EXPECT_LE((records.back().momentum - records[0].momentum).norm(),
            1e-9 * records[0].momentum.norm());
}

// A step above the stable step is refused. If that is switched off, the run
// fails as unstable, even only 5 % above. A step just below is fine.
TEST_P(Explicit, UnstableStep)
{
  if (!on_one_rank())
    GTEST_SKIP();
  const unsigned int degree = GetParam();
  const auto         bar    = [&](const double dt, const bool refuse) {
    return spinning_bar(degree,
                        "diagonal scaling",
                        steps(1e4 * dt,
                              dt,
                                         {{"Refuse unstable steps", refuse}}),
                        0.01);
  };
  const double stable = stable_step(bar(1e-9, true));
  const auto text = refusal([&] { CompleteRun run(bar(1.05 * stable, true)); });
  EXPECT_EQ(text.find("Time integration/Time step: found a step of "), 0u)
    << text;
  EXPECT_NE(text.find(fmt::format("up to the stable step, {:.6g} s", stable)),
            std::string::npos)
    << text;
  CompleteRun unstable(bar(1.05 * stable, false));
  const auto  message = unstable.run({10, 0.});
  EXPECT_NE(message.find("the motion is unstable"), std::string::npos)
    << message;
  // The saved state is from before the failure.
  EXPECT_TRUE(std::isfinite(unstable.recorder().displacement.linfty_norm()));
  EXPECT_EQ(unstable.recorder().summary.status, "failed");
  // So the true limit is within five percent of the estimate. The body vibrates
  // with strains of 1e-4, which change the tangent.
  CompleteRun just_stable(bar(0.98 * stable, true));
  EXPECT_EQ(just_stable.run({100, 0.}), "");
}

// The program chooses 0.9 of the stable step, or less so that results are at
// exact times; the motion is that with the same step given. New estimates
// change the step a little.
TEST_P(Explicit, OwnStep)
{
  const unsigned int degree = GetParam();
  const auto         bar = [&](const double step, const unsigned int interval) {
    return spinning_bar(degree,
                        "diagonal scaling",
                        steps(0.02,
                              step,
                                      {{"Steps between estimates", interval}}));
  };
  CompleteRun own(bar(0, 1000000));
  ASSERT_EQ(own.run({1000000, 0.005}), "");
  const auto &records = own.recorder().records;
  ASSERT_EQ(records.size(), 5u);
  for (unsigned int i = 0; i < 5; ++i)
    EXPECT_NEAR(records[i].time, 0.005 * i, 1e-15);
  const double dt = records[1].dt;
  EXPECT_LE(dt, 0.9 * stable_step(bar(1e-9, 1)));
  EXPECT_NEAR(0.005 / dt, std::round(0.005 / dt), 1e-9);
  CompleteRun given(bar(dt, 1000000));
  ASSERT_EQ(given.run({1000000, 0.}), "");
  const double size = given.simulation.state().u.linfty_norm();
  EXPECT_LE(largest_difference(own.simulation.state().u,
                               given.simulation.state().u),
            1e-10 * size);
  CompleteRun following(bar(0, 3));
  ASSERT_EQ(following.run({1, 0.005}), "");
  EXPECT_EQ(following.recorder().records.back().time, 0.02);
  double shortest = 1, longest = 0;
  for (const StepRecord &record : following.recorder().steps)
    {
      shortest = std::min(shortest, record.dt);
      longest  = std::max(longest, record.dt);
    }
  EXPECT_LE(longest, 1.1 * shortest);
}

// Each step between records is made in one sweep over the cells. The motion and
// the budget are those of single steps.
TEST_P(Explicit, ManySteps)
{
  const std::string bar = box_mesh("2, 1, 1", "2, 1, 1") +
                          element_text(GetParam(), "diagonal scaling") +
                          material_text(2e5) + fixed("x-min") +
                          tractions("x-max: 0; 1; 0") + gravity("0; 0; -3") +
                          steps(0.5, 5e-4);
  CompleteRun many(bar), single(bar);
  ASSERT_EQ(many.run({70, 0.13}), "");
  ASSERT_EQ(single.run(), "");
  // Recorded are every 70th of 1000 steps, three results at 260, 520 and 780,
  // and the end.
  EXPECT_EQ(many.recorder().steps.size(), 14u + 3u + 1u);
  const double size = single.simulation.state().u.linfty_norm();
  EXPECT_GT(size, 0.01);
  // The tolerance is the round-off of 1000 steps.
  EXPECT_LE(largest_difference(many.simulation.state().u,
                               single.simulation.state().u),
            1e-11 * size);
  for (const StepRecord &record : many.recorder().steps)
    {
      const StepRecord &other = single.recorder().records[record.step];
      EXPECT_NEAR(record.time, other.time, 1e-14);
      EXPECT_NEAR(record.dt, other.dt, 1e-14);
      EXPECT_NEAR(record.kinetic_energy,
                  other.kinetic_energy,
                  1e-9 * other.external_work);
      EXPECT_NEAR(record.external_work,
                  other.external_work,
                  1e-9 * other.external_work);
      EXPECT_LE((record.reaction - other.reaction).norm(),
                1e-9 * other.reaction.norm());
    }
}

INSTANTIATE_TEST_SUITE_P(Degrees, Explicit, testing::Values(1u, 2u, 3u));

// With a consistent mass each step solves by conjugate gradients, whose number
// of iterations does not grow with the mesh [Wathen 1987].
TEST(Explicit, ConsistentMass)
{
  for (const unsigned int degree : {1, 2, 3})
    {
      unsigned int iterations[2];
      for (const unsigned int i : {0, 1})
        {
          MovingBody body(box("1, 1, 1",
                              fmt::format("{0}, {0}, {0}", 3 << i),
                              0.2),
                          element_text(degree, "consistent") +
                            section("Loads", {{"Body force", "0; y^2; x"}}));
          iterations[i] =
            body.system.solve_acceleration(body.state, 0.).linear_iterations;
        }
      report(fmt::format("iterations, P{}", degree), iterations[0]);
      report(fmt::format("iterations on a finer mesh, P{}", degree),
             iterations[1]);
      EXPECT_LE(iterations[1], 1.15 * iterations[0] + 1);
    }
}

namespace
{
  // The whole bar moves by t^2 / 2 along x with its support: @p gravity_x is
  // the acceleration of gravity that this takes with this @p damping.
  void
  expect_rigid_motion(const std::string &damping, const std::string &gravity_x)
  {
    for (const std::string mass : {"row sum", "consistent"})
      {
        constexpr double T = 1;
        CompleteRun      run(
          box_mesh("1, 0.2, 0.2", "5, 1, 1") +
          section("Discretization", {{"Degree", 1}, {"Mass", mass}}) +
          material_type("linear") + material_text(1e5) +
          displacements("x-min: 0.5*t^2; 0; 0") +
          gravity(gravity_x + "; 0; 0") + damping +
          time_integration("central difference", T, 0.001));
        ASSERT_EQ(run.run(), "");
        const Vector &u = run.recorder().displacement;
        for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
          // The tolerance is the round-off of 1000 steps.
          EXPECT_NEAR(u.local_element(i), i % 3 == 0 ? 0.5 * T * T : 0, 1e-12)
            << mass;
        if (damping.find("Mass") != std::string::npos)
          continue;
        for (const StepRecord &step : run.recorder().steps)
          EXPECT_NEAR(step.dissipated_energy, 0, 1e-20) << mass;
      }
  }
} // namespace

// Damping by stiffness does not damp a rigid motion, as velocities of supports
// and of other nodes are taken at the same time.
TEST(Explicit, DampingSeesNoRigidMotion)
{
  expect_rigid_motion(section("Damping", {{"Stiffness coefficient", 0.01}}),
                      "1");
}

// Damping by mass uses the velocity at the end of the half step, of supports,
// too.
TEST(Explicit, DampingByMassTakesVelocitiesToCome)
{
  expect_rigid_motion(section("Damping", {{"Mass coefficient", 2}}), "1 + 2*t");
}

// There is no stable step where all unknowns are prescribed.
TEST(CentralDifference, NothingIsFree)
{
  EXPECT_NE(refusal([] {
              CompleteRun run(
                box_mesh("1, 1, 1", "1, 1, 1") + material_text(1e3, 0.3, 1000) +
                displacements(on_all_sides("0.01 * sin(5 * t); 0; 0")) +
                steps(1, 0));
              run.run();
            })
              .find("Time integration/Time step: found 0, the stable step, "
                    "which there is none of"),
            std::string::npos);
}

// The message names the step that fails, however long ago the last row was
// written.
TEST(CentralDifference, NamesTheStepThatFails)
{
  CompleteRun       run(box_mesh("1, 1, 1", "1, 1, 1") +
                  material_text(1e3, 0.3, 1000) + fixed("x-min") +
                  gravity("0; 0; if(t > 0.155 & t < 0.175, 0 / 0, 1)") +
                  steps(1, 0.01));
  const std::string found = run.run({1000, 0.});
  EXPECT_TRUE(found.starts_with("step 16 (t = 0.15): ")) << found;
}
