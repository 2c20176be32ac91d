// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Bodies that touch rigid obstacles: statics, impact, friction.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  const StepRecord &
  last(CompleteRun &run)
  {
    return run.recorder().records.back();
  }
} // namespace

// A press moves by 0.1 m onto a bar without Poisson's effect: bar and pressure
// are springs in a row, so the pressure is 0.1 / (L / E + 1 / k). Newton's
// method ends after three iterations: where the bar does not yet touch, where
// it touches, and the check.
TEST(Contact, PressedBar)
{
  for (const unsigned int degree : {1, 2, 3})
    {
      CompleteRun run(
        box_mesh("1, 1, 2", "1, 1, 3") + element_text(degree) +
        material_type("linear") + material_text(1e6, 0) + fixed("z-min") +
        section("Contact",
                {{"Obstacles", "press: plane 0 0 2 0 0 -1"},
                 {"Motions", "press: 0; 0; -0.1 * t"},
                 {"Stiffness", "press: 1e8"}}) +
        section("Time integration",
                {{"Type", "static"}, section("static", {{"Load steps", 2}})}));
      EXPECT_EQ(run.run(), "");
      // Sides of the bar touch, too, where they are inside of the press: with a
      // depth d of 5e-4 m, an area of less than 4 d.
      const double depth = 0.1 / (2e-6 + 1e-8) / 1e8;
      EXPECT_NEAR(last(run).contact_forces[0].second[2] / -(1e8 * depth),
                  1,
                  4 * depth);
      EXPECT_NEAR(last(run).reaction[2] / (1e8 * depth), 1, 4 * depth);
      EXPECT_NEAR(last(run).energy_balance / last(run).elastic_energy, 0, 1e-6);
      EXPECT_LE(last(run).newton_iterations, 4u);
    }
}

// In statics the account of energy begins with the body at rest, which is
// inside of two obstacles here, one of which moves: the guess that Newton's
// method begins with does not matter.
TEST(Contact, BalanceDoesNotDependOnTheGuess)
{
  StepRecord results[2];
  for (const bool has_guess : {false, true})
    {
      CompleteRun run(
        box_mesh("1, 0.2, 0.2", "4, 1, 1") + element_text(2) +
        material_text(1e7, 0.3) + fixed("x-min") +
        initial_conditions(has_guess ? "1e-6 * x; 0; 0" : "0; 0; 0",
                           "0; 0; 0") +
        section("Contact",
                {{"Obstacles",
                  "floor: plane 0 0 0.001 0 0 1, top: plane 0 0 0.199 0 0 -1"},
                 {"Motions", "top: 0; 0; -0.002 * t"},
                 {"Stiffness", "floor: 1e8, top: 1e8"}}) +
        section("Time integration",
                {{"Type", "static"}, section("static", {{"Load steps", 4}})}));
      EXPECT_EQ(run.run(), "");
      results[has_guess] = last(run);
    }
  // The energies are some 10 J, and known to Newton's tolerance.
  EXPECT_GT(results[0].contact_energy, 10);
  EXPECT_NEAR(results[1].elastic_energy, results[0].elastic_energy, 1e-5);
  EXPECT_NEAR(results[1].external_work, results[0].external_work, 1e-5);
  EXPECT_NEAR(results[1].energy_balance, results[0].energy_balance, 1e-5);
}

// A block falls on an inclined plane and slides down: the impulse of the plane
// is the change of the momentum without that of gravity, and the energy is kept
// but for friction, to the error of the time integration, which is of second
// order.
TEST(Contact, ImpulseAndEnergy)
{
  double error[2];
  for (const unsigned int i : {0, 1})
    {
      CompleteRun run(
        box_mesh("1, 1, 0.5", "2, 2, 1") + element_text(2) +
        rotation_at("quadrature points") + material_text(1e6, 0.3) +
        initial_conditions("0; 0; 0", "0; 0; -0.5") +
        section("Loads", {{"Gravity", "0; 0; -9.81"}}) +
        section("Contact",
                {{"Obstacles", "slope: plane 0 0 -0.01 0.3 0 1"},
                 {"Friction", "slope: 0.2"},
                 {"Slip velocity", 0.01}}) +
        time_integration("implicit midpoint", 0.1, 1e-3 / (1 + i)));
      EXPECT_EQ(run.run(), "");
      dealii::Tensor<1, 3> impulse;
      for (const StepRecord &record : run.recorder().steps)
        {
          impulse += record.dt * record.contact_forces[0].second;
          impulse[2] -= record.dt * 9.81 * 500;
        }
      const StepRecord &first = run.recorder().records.front();
      // Forces are those at the middle of steps, where the equation of motion
      // holds: the tolerance is that of Newton's method.
      EXPECT_NEAR((impulse - (last(run).momentum - first.momentum)).norm(),
                  0,
                  1e-6 * first.momentum.norm());
      EXPECT_GT(last(run).friction_work, 1);
      EXPECT_EQ(last(run).friction_work, last(run).dissipated_energy);
      error[i] = std::abs(last(run).energy_balance);
    }
  EXPECT_LT(error[0], 0.01 * 125);
  EXPECT_LT(error[1], 0.5 * error[0]);
}

// A block that slides at 1 m/s on a plane stops after v^2 / (2 mu g), with all
// of its energy lost to friction, by implicit and by explicit steps. The slip
// velocity makes the way longer by w / v, and the block's own elasticity and
// its fall by the depth of contact count, too: some percent.
TEST(Contact, SlidesAndStops)
{
  for (const std::string type : {"generalized-alpha", "central difference"})
    {
      CompleteRun run(
        box_mesh("1, 1, 0.2", "3, 3, 1") + element_text(1) +
        material_text(1e7, 0.3) + initial_conditions("0; 0; 0", "1; 0; 0") +
        section("Loads", {{"Gravity", "0; 0; -9.81"}}) +
        section("Damping", {{"Stiffness coefficient", 1e-4}}) +
        section("Contact",
                {{"Obstacles", "floor: plane 0 0 0 0 0 1"},
                 {"Friction", "floor: 0.5"},
                 {"Slip velocity", 0.005}}) +
        time_integration(type, 0.3, type == "central difference" ? 0. : 2e-3));
      EXPECT_EQ(run.run({100, 0.}), "");
      const double way =
        run.simulation.body().root_mean_square(run.recorder().displacement);
      const double expected = 1 / (2 * 0.5 * 9.81);
      EXPECT_NEAR(way / expected, 1, 0.05) << type;
      EXPECT_NEAR(last(run).friction_work / 100, 1, 0.05) << type;
      EXPECT_LT(last(run).kinetic_energy, 0.01 * 100) << type;
    }
}

// A belt takes a block along: friction does work on the block, and its motion
// is not taken for an unstable one.
TEST(Contact, BeltDrivesABlock)
{
  CompleteRun run(box_mesh("1, 1, 0.2", "3, 3, 1") + element_text(1) +
                  material_text(1e7, 0.3) +
                  section("Loads", {{"Gravity", "0; 0; -9.81"}}) +
                  section("Damping", {{"Stiffness coefficient", 1e-3}}) +
                  section("Contact",
                          {{"Obstacles", "belt: plane 0 0 0 0 0 1"},
                           {"Motions", "belt: 2 * t; 0; 0"},
                           {"Friction", "belt: 0.5"},
                           {"Slip velocity", 0.02}}) +
                  time_integration("generalized-alpha", 1, 5e-3));
  EXPECT_EQ(run.run(), "");
  // The mass is 200 kg.
  EXPECT_NEAR(last(run).momentum[0] / 400, 1, 0.01);
  EXPECT_LT(last(run).dissipated_energy, -300);
}

// Stable steps are found for contact that is still to come: with a stiff
// obstacle they are shorter, and a fall on it is stable.
TEST(Contact, StableStep)
{
  const std::string text = box_mesh("1, 1, 1", "2, 2, 2") + element_text(1) +
                           material_text(1e6, 0.3) +
                           initial_conditions("0; 0; 0", "0; 0; -1");
  double step[2];
  for (const unsigned int i : {0, 1})
    {
      CompleteRun run(
        text +
        section("Contact",
                {{"Obstacles", "floor: plane 0 0 -0.01 0 0 1"},
                 {"Stiffness", i == 0 ? "floor: 1e3" : "floor: 1e9"}}) +
        time_integration("central difference", i == 0 ? 0.02 : 0.1, 0));
      EXPECT_EQ(run.run(), "");
      step[i] = run.recorder().steps.front().dt;
      // Steps just below the bound take the beginning and the end of contact in
      // turns.
      EXPECT_NEAR(last(run).energy_balance / last(run).kinetic_energy, 0, 0.03);
    }
  EXPECT_LT(step[1], 0.2 * step[0]);
}

// Faces as large as the body do not make contact soft: one cubic cell for each
// edge of a cube, pressed by 2 %. The depth is some 5 % of the way.
TEST(Contact, DefaultStiffnessOfACube)
{
  for (const unsigned int n : {1, 2, 4})
    {
      CompleteRun run(
        box_mesh("1, 1, 1", fmt::format("{0}, {0}, {0}", n)) + element_text(3) +
        material_type("linear") + material_text(1e6, 0) + fixed("z-min") +
        section("Contact",
                {{"Obstacles", "press: plane 0 0 1 0 0 -1"},
                 {"Boundaries", "z-max"},
                 {"Motions", "press: 0; 0; -0.02 * t"}}) +
        section("Time integration",
                {{"Type", "static"}, section("static", {{"Load steps", 1}})}));
      EXPECT_EQ(run.run(), "");
      // Bar and pressure are springs in a row, of 1 m / E and h / (10 E).
      const double force = 0.02 * 1e6 / (1 + 0.1 / n);
      EXPECT_NEAR(last(run).contact_forces[0].second[2] / -force, 1, 1e-7);
    }
}

// Two planes at the same place press twice: the stable step knows.
TEST(Contact, StableStepOfTwoObstacles)
{
  CompleteRun run(
    box_mesh("1, 1, 1", "2, 2, 2") + element_text(1) + material_text(1e6, 0.3) +
    initial_conditions("0; 0; 0", "0; 0; -1") +
    section("Contact",
            {{"Obstacles",
              "a: plane 0 0 -0.01 0 0 1, b: plane 0 0 -0.01 0 0 1"},
             {"Stiffness", "a: 1e9, b: 1e9"}}) +
    time_integration("central difference", 0.1, 0));
  EXPECT_EQ(run.run(), "");
  EXPECT_NEAR(last(run).energy_balance / last(run).kinetic_energy, 0, 0.03);
}

// Obstacles are no supports in statics.
TEST(Contact, IsNoSupport)
{
  try
    {
      CompleteRun run(
        box_mesh("1, 1, 1", "1, 1, 1") + element_text(1) +
        section("Contact", {{"Obstacles", "floor: plane 0 0 0 0 0 1"}}) +
        section("Time integration", {{"Type", "static"}}));
      FAIL();
    }
  catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("cannot move without strain"),
                std::string::npos);
    }
}
