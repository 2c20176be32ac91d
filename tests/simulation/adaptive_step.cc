// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Time steps that adapt to their error.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../integrators.h"
#include "../refusal.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // A beam that swings far, first slowly, then pushed for a short time.
  std::string
  beam(const std::string &integration)
  {
    return box_mesh("4, 1, 1", "4, 1, 1") +
           element_text(1, "diagonal scaling") +
           rotation_at("quadrature points") + material_text(2e4) +
           fixed("x-min") + gravity("0; 4*exp(-40*(t-2)^2); -0.5*sin(t)^2") +
           newton_tolerances(1e-11) + linear_solver("direct", 1e-9) +
           integration;
  }

  std::string
  adaptive(const std::string &type,
           const double       target,
           const Entries      further = {})
  {
    return time_integration(
      type,
      4,
      0.05,
      {section("Adaptive step", {{"Enabled", true}, {"Target error", target}}),
       section("Adaptive step", further)});
  }
} // namespace

class Adaptive : public testing::TestWithParam<std::string>
{};

// The local error is of third order and the global one of second: over three
// decades of the target the error falls like its power 2/3.
TEST_P(Adaptive, ErrorFollowsTarget)
{
  if (!on_one_rank())
    GTEST_SKIP();
  // The reference has an error of 1e-7, as steps are 200 times shorter than the
  // push.
  CompleteRun reference(beam(time_integration("central difference", 4, 2e-4)));
  ASSERT_EQ(reference.run(), "");
  std::vector<double> errors, targets{1e-3, 1e-4, 1e-5, 1e-6};
  for (const double target : targets)
    {
      CompleteRun run(beam(adaptive(GetParam(), target)));
      ASSERT_EQ(run.run(), "");
      errors.push_back(largest_difference(run.simulation.state().u,
                                          reference.simulation.state().u) /
                       reference.simulation.state().u.linfty_norm());
      report(fmt::format("error for {:.0e}, {} steps, {} rejected",
                         target,
                         run.recorder().summary.steps,
                         run.recorder().records.back().rejected_steps),
             errors.back());
      // Steps must differ, as the push is shorter than the motion around it.
      double shortest = 1, longest = 0;
      for (const StepRecord &record : run.recorder().steps)
        {
          shortest = std::min(shortest, record.dt);
          longest  = std::max(longest, record.dt);
        }
      EXPECT_GT(longest, 2 * shortest);
    }
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_LT(errors[i + 1], errors[i]);
  const double power = std::log10(errors[0] / errors[3]) / 3;
  report("power of the target", power);
  EXPECT_NEAR(power, 2. / 3, 0.1);
}

INSTANTIATE_TEST_SUITE_P(
  Methods,
  Adaptive,
  testing::ValuesIn(integrators_with([](const TimeIntegrator &integrator) {
    return integrator.error_constant() > 0;
  })),
  [](const auto &info) { return letters_and_digits(info.param); });

// Results are at exact times whatever the steps are, and the energy budget does
// not include repeated steps.
TEST(AdaptiveStep, ResultsAtExactTimes)
{
  CompleteRun run(beam(adaptive("Newmark", 1e-3)));
  ASSERT_EQ(run.run({1000000, 0.3}), "");
  const auto &records = run.recorder().records;
  ASSERT_EQ(records.size(), 15u);
  for (unsigned int i = 0; i < 14; ++i)
    EXPECT_NEAR(records[i].time, 0.3 * i, 1e-14) << i;
  EXPECT_EQ(records[14].time, 4.);
  EXPECT_GT(records[14].rejected_steps, 0u);
  CompleteRun every(beam(adaptive("Newmark", 1e-3)));
  ASSERT_EQ(every.run({1, 0.3}), "");
  double sum = 0;
  for (const StepRecord &record : every.recorder().steps)
    sum += record.dt;
  EXPECT_NEAR(sum, 4, 1e-13);
  EXPECT_EQ(every.recorder().records.back().external_work,
            records.back().external_work);
}

// Before a load begins the body is at rest, and any step into the load has a
// large error. Such steps shrink to the smallest step and no further, however
// times are rounded in runs of many durations.
TEST(AdaptiveStep, LoadsThatBeginLater)
{
  if (!on_one_rank())
    GTEST_SKIP();
  const auto run =
    [](const double begin, const double end, const double least) {
      CompleteRun moved(
        box_mesh("1, 0.1, 0.1", "2, 1, 1") + fixed("x-min") +
        tractions(fmt::format("x-max: 0; 0; 1e3*ramp(t, {}, 0.2)", begin)) +
        time_integration("generalized-alpha",
                         end,
                         0.01,
                         {section("Adaptive step",
                                  {{"Enabled", true},
                                   {"Smallest step", least}})}));
      EXPECT_EQ(moved.run(), "") << begin << ' ' << end << ' ' << least;
      for (const StepRecord &record : moved.recorder().steps)
        EXPECT_GE(record.dt, (1 - 1e-6) * std::max(least, 1e-8))
          << begin << ' ' << end << ' ' << least;
    };
  for (const double end : {0.13, 0.2, 0.25, 0.3, 0.37})
    for (const double least : {0., 1e-7, 1e-6, 1e-5})
      run(0.1, end, least);
  run(0.01, 0.3, 0.);
  run(0.05, 0.3, 0.);
}

// A stiff block that spins freely, with damping by stiffness: after the first
// vibrations its speed is constant. Changes of the step disturb its stiff
// modes, which damping feeds on; steps that alternate in length would take 14 J
// from it, equal ones of 1 ms take 0.63 J. The exact value is 0.33 J.
TEST(AdaptiveStep, SpinningBlock)
{
  if (!on_one_rank())
    GTEST_SKIP();
  CompleteRun run(
    box_mesh("0.4, 0.2, 0.2", "2, 1, 1") +
    section("Mesh", {section("box", {{"Origin", "-0.2, -0.1, -0.1"}})}) +
    element_text(1) +
    section("Material", {{"Young's modulus", 1e8}, {"Density", 3000}}) +
    initial_conditions("0; 0; 0", "-40*y; 40*x; 0") +
    section("Damping", {{"Stiffness coefficient", 1e-4}}) +
    time_integration("generalized-alpha",
                     0.4,
                     0.001,
                     {section("Adaptive step", {{"Enabled", true}})}));
  ASSERT_EQ(run.run(), "");
  const StepRecord &last = run.recorder().records.back();
  report("dissipated energy [J]", last.dissipated_energy);
  report("rejected steps", last.rejected_steps);
  EXPECT_LE(last.dissipated_energy, 1.5);
  EXPECT_LE(10 * last.rejected_steps, last.step);
}

// A bar that vibrates along its axis while it flies at 100 m/s keeps its energy
// as if it did not fly: 2.5 J, of which the standard error takes 2e-4. Related
// to the distance of the flight, errors would take three quarters. Dashpots, of
// 1e-8 N s/m here, do not hold a body.
TEST(AdaptiveStep, FlyingBar)
{
  if (!on_one_rank())
    GTEST_SKIP();
  for (const std::string &dashpots :
       {std::string(),
        section("Supports", {{"Dashpots", "x-min: 1e-6; 1e-6; 1e-6"}})})
    {
      CompleteRun run(
        box_mesh("1, 0.1, 0.1", "8, 1, 1") + element_text(2) +
        section("Material",
                {{"Young's modulus", 1e7}, {"Poisson's ratio", 0}}) +
        rotation_at("quadrature points") + dashpots +
        initial_conditions("0; 0; 0", "100 - cos(pi*x); 0; 0") +
        time_integration("generalized-alpha",
                         0.1,
                         1e-4,
                         {section("Adaptive step", {{"Enabled", true}})}));
      ASSERT_EQ(run.run(), "");
      double largest = 0;
      for (const StepRecord &record : run.recorder().steps)
        if (record.time > 0.09)
          largest = std::max(largest, record.elastic_energy);
      EXPECT_NEAR(largest, 2.5, 0.005) << dashpots;
    }
}

// Bounds are kept; steps of the smallest size are accepted with any error.
TEST(AdaptiveStep, Bounds)
{
  if (!on_one_rank())
    GTEST_SKIP();
  CompleteRun run(beam(adaptive(
    "Newmark", 1e-9, {{"Smallest step", 0.02}, {"Largest step", 0.04}})));
  ASSERT_EQ(run.run(), "");
  const auto &steps = run.recorder().steps;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i)
    {
      EXPECT_GE(steps[i].dt, 0.02 * (1 - 1e-12));
      EXPECT_LE(steps[i].dt, 0.04 * (1 + 1e-12));
    }
  EXPECT_GE(steps.size(), 190u);
  // The largest step is far below the first one. Without a smallest step the
  // error still counts, so steps are repeated.
  CompleteRun tiny(beam(time_integration(
    "Newmark",
    2e-3,
    1e4,
    {section("Adaptive step", {{"Enabled", true}, {"Target error", 1e-12}}),
     section("Adaptive step", {{"Largest step", 1e-3}})})));
  ASSERT_EQ(tiny.run(), "");
  EXPECT_LT(tiny.recorder().steps.front().dt, 0.9e-3);
  const auto text = refusal([] {
    CompleteRun(beam(adaptive(
      "Newmark", 1e-3, {{"Smallest step", 0.2}, {"Largest step", 0.1}})));
  });
  EXPECT_EQ(text,
            "Time integration/Adaptive step/Smallest step: found 0.2; allowed: "
            "at most the largest step, 0.1");
  EXPECT_EQ(refusal([] {
              CompleteRun(beam(adaptive("BDF2", 1e-3)));
            }).find("Time integration/Adaptive step/Enabled: found true;"),
            0u);
  EXPECT_EQ(refusal([] {
              CompleteRun(beam(time_integration("Newmark", 4, 0)));
            }).find("Time integration/Time step: found 0;"),
            0u);
}

// The run begins with steps of a millionth of the given one, in which the
// matrix is nearly all mass. Rotations of vertices, used for bodies of
// stretched cells, have no mass where they are the same everywhere.
TEST(AdaptiveStep, ShortStepsOfThinBodies)
{
  const auto energy = [](const std::string &solver) {
    CompleteRun run(
      box_mesh("0.5, 0.1, 0.05", "4, 4, 2") + element_text(2) +
      material_text(3e3, 0.45) + fixed("x-min") + gravity("0; 0; -1") +
      section("Supports", {{"Dashpots", "z-min: 0; 0; 100"}}) +
      linear_solver(solver, 1e-8) +
      time_integration("generalized-alpha",
                       0.1,
                       0.001,
                       {section("Adaptive step", {{"Enabled", true}})}));
    EXPECT_EQ(run.run(), "") << solver;
    return run.recorder().records.back().kinetic_energy;
  };
  // The tolerance is that of Newton's method and of the steps.
  const double direct = energy("direct");
  EXPECT_NEAR(energy("p-multigrid"), direct, 1e-6 * direct);
}

// Damping by stiffness that stops motion at once, and weight that is not in
// balance at the start: a first step that is far too long is made again with
// the mean acceleration of a shorter one. With that of the first length the
// step went down to the smallest one, 5e-8 s.
TEST(AdaptiveStep, StiffStart)
{
  CompleteRun run(
    box_mesh("2, 1, 1", "2, 1, 1") + element_text(1) + material_text(1e5) +
    fixed("x-min") + gravity("0; 0; -9.81") +
    section("Damping", {{"Stiffness coefficient", 0.05}}) +
    initial_conditions("0; 0; 0", "0; x * x; 0") + newton_tolerances(1e-12) +
    linear_solver("direct", 1e-12) +
    time_integration("generalized-alpha",
                     0.01,
                     0.05,
                     {section("Adaptive step",
                              {{"Enabled", true}, {"Target error", 1e-8}})}));
  ASSERT_EQ(run.run(), "");
  EXPECT_GT(run.recorder().steps.front().dt, 1e-6);
}
