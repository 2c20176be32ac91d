// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Bodies on springs and dashpots in motion: stable steps, decay, absorbed
// waves, and the energy budget.

#include <gtest/gtest.h>

#include <cmath>

#include "../integrators.h"
#include "supported_box.h"

using namespace corotet;
using namespace corotet::tests;

// The stable step depends on the springs: if they are far stiffer than the
// body, the largest frequency grows like sqrt(k).
TEST(ElasticSupports, StableStep)
{
  double omega[2];
  for (const unsigned int i : {0, 1})
    {
      MovingBody body(box("1, 1, 1", "2, 2, 2"),
                      element_text(Element::quadratic_with_bubbles()) +
                        material_text(1) +
                        supports(i == 0 ? "z-min: 1e8; 1e8; 1e8" :
                                          "z-min: 4e8; 4e8; 4e8"));
      omega[i] =
        body.system.acceleration_solver().largest_frequencies(body.state).all;
    }
  EXPECT_NEAR(omega[1] / omega[0], 2, 2e-3);
  EXPECT_GT(omega[0], 1e3);
}

// Damping by stiffness uses the stiffness of cells, not of springs, which would
// make the step 70 times shorter here. Just below the bound the energy decays,
// with a balance of round-off; 10 % above it the fastest mode, that of the
// springs, grows.
TEST(ElasticSupports, StableStepWithDampingByStiffness)
{
  const std::string text =
    box_mesh("1, 0.5, 0.5", "2, 1, 1") + element_text(1, "row sum") +
    material_type("linear") + material_text(1e6) +
    supports("x-min: 1e12; 1e12; 1e12") +
    section("Damping", {{"Stiffness coefficient", 1e-3}});
  MovingBody body(box("1, 0.5, 0.5", "2, 1, 1"),
                  text + time_integration("central difference", 1, 0));
  MovingBody of_cells(box("1, 0.5, 0.5", "2, 1, 1"),
                      element_text(1, "row sum") + material_type("linear") +
                        material_text(1e6));
  const auto [all, damped] =
    body.system.acceleration_solver().largest_frequencies(body.state);
  const double without = of_cells.system.acceleration_solver()
                           .largest_frequencies(of_cells.state)
                           .all;
  // Both estimates of frequencies are too large by less than 1e-3.
  EXPECT_NEAR(damped / without, 1, 1e-3);
  EXPECT_GT(all, 5 * damped);
  const double bound =
    4 / (1e-3 * damped * damped + std::hypot(1e-3 * damped * damped, 2 * all));
  for (const double factor : {0.99, 1.1})
    {
      CompleteRun run(
        text + initial_conditions("0; 0; 0", "1; 1; 1") +
        section("Time integration",
                {section("central difference",
                         {{"Refuse unstable steps", factor < 1}})}) +
        time_integration("central difference",
                         2000 * factor * bound,
                         factor * bound));
      const std::string message = run.run();
      EXPECT_EQ(message.empty(), factor < 1) << message;
      if (factor > 1)
        continue;
      EXPECT_NEAR(last_record(run).energy_balance, 0, 1e-10);
      EXPECT_GT(last_record(run).dissipated_energy, 1);
    }
}

// A thousandth below the stable step the energy of the fastest mode, computed
// from two velocities, is many times the initial energy, but does not grow
// further: the motion is not unstable.
TEST(ElasticSupports, CloseToTheStableStep)
{
  CompleteRun run(
    box_mesh("1, 0.5, 0.5", "2, 1, 1") + element_text(1, "row sum") +
    material_type("linear") + material_text(1e6) +
    supports("x-min: 1e12; 1e12; 1e12") +
    initial_conditions("0; 0; 0", "1; 1; 1") +
    section("Time integration",
            {section("central difference", {{"Safety factor", 1}})}) +
    time_integration("central difference", 0.1, 0));
  EXPECT_EQ(run.run({100, 0.}), "");
  double largest = 0;
  for (const StepRecord &record : run.recorder().records)
    {
      largest = std::max(largest, record.elastic_energy);
      // The tolerance is the round-off of energies that cancel.
      EXPECT_NEAR(record.energy_balance, 0, 1e-12 * largest + 1e-9);
    }
  const StepRecord &first = run.recorder().records.front();
  report("largest energy / what was put in", largest / first.kinetic_energy);
  EXPECT_GT(largest, 20 * first.kinetic_energy);
}

// A stiff block of 1 kg with u = v = 0.1 m at the start, on springs of 4 N/m
// and critical dashpots, c = 2 sqrt(k m) = 4 N s/m: u = (u_0 + (v_0 + 2 u_0) t)
// exp(-2 t). The relative error of the trapezoidal rule is some (omega dt)^2 /
// 12 = 3e-6; central differences have half of that for their own dt, with the
// other sign. The block itself yields by 1e-6.
TEST(ElasticSupports, CriticalDamping)
{
  for (const std::string method : {"implicit midpoint", "central difference"})
    {
      const bool  is_explicit = method == "central difference";
      CompleteRun run(
        supported_box("1, 1, 1", "1, 1, 1", is_explicit ? 4e3 : 4e6) +
        element_text(Element::quadratic_with_bubbles()) +
        supports("z-min: 4; 4; 4", "", "z-min: 4; 4; 4") +
        initial_conditions("0; 0; 0.1", "0; 0; 0.1") +
        time_integration(method, 1, is_explicit ? 5e-4 : 2.5e-3));
      ASSERT_EQ(run.run(), "");
      EXPECT_NEAR(mean_displacement(run, 2),
                  (0.1 + 0.3) * std::exp(-2),
                  is_explicit ? 1e-4 : 1e-6);
      const StepRecord &record = last_record(run);
      EXPECT_NEAR(record.energy_balance, 0, 1e-12);
      EXPECT_GT(record.dissipated_energy, 0.01);
    }
}

// A wave f(x - c t) runs along a bar of c = 1 m/s and Z = rho c = 1 N s/m^3
// into dashpots: the reflected amplitude is (Z - c_d) / (Z + c_d) of it, and
// the reflected energy the square of that. The pulse is sin^4 over a length of
// 1 m; cells of 1/24 m represent its energy to 1e-4, and half a dozen such
// errors add up to 1e-3.
TEST(ElasticSupports, DashpotsAbsorbWaves)
{
  for (const std::string method : {"implicit midpoint", "central difference"})
    for (const double damping : {1., 3., 0.5})
      {
        const std::string s = "max(0, min(1, x - 0.5))";
        // The initial state of the wave is u = -int f and v = f, as sigma = E
        // u' and u' = -f.
        CompleteRun run(
          supported_box("2, 0.1, 0.1", "48, 1, 1", 1.) +
          element_text(Element::quadratic_with_bubbles()) +
          supports("", "", fmt::format("x-max: {}; 0; 0", damping)) +
          initial_conditions(
            fmt::format("-(3 / 8 * ({0}) - sin(2 * pi * ({0})) / (4 * pi) + "
                        "sin(4 * pi * ({0})) / (32 * pi)); 0; 0",
                        s),
            fmt::format("sin(pi * ({}))^4; 0; 0", s)) +
          time_integration(method,
                           1.75,
                           method == "central difference" ? 0. : 0.0125));
        ASSERT_EQ(run.run(), "");
        const StepRecord &first  = run.recorder().records.front();
        const StepRecord &record = last_record(run);
        const double      energy = first.kinetic_energy + first.elastic_energy;
        const double      left = record.kinetic_energy + record.elastic_energy;
        const double      R    = (1 - damping) / (1 + damping);
        EXPECT_NEAR(left / energy, R * R, 1e-3);
        EXPECT_NEAR(record.dissipated_energy / energy, 1 - R * R, 1e-3);
        EXPECT_NEAR(record.energy_balance, 0, 1e-11 * energy);
      }
}

// Dashpots take the whole momentum: a block of 1 kg at 1 m/s on dashpots of c =
// 2 N s/m comes to rest after m v / c = 0.5 m, for any step; a step of 0.2 s
// takes a fifth of the velocity in its first half. In the sum over all steps
// mass and force cancel, so only round-off and tolerances remain.
TEST(ElasticSupports, DashpotsTakeTheMomentum)
{
  for (const std::string mass : {"row sum", "consistent"})
    {
      CompleteRun run(
        supported_box("1, 1, 1", "1, 1, 1", 1.) +
        section("Discretization", {{"Degree", 1}, {"Mass", mass}}) +
        supports("", "", "z-min: 2; 2; 2") +
        section("Damping", {{"Stiffness coefficient", 0.05}}) +
        initial_conditions("0; 0; 0", "0; 0; 1") +
        time_integration("central difference", 600, 0.2));
      ASSERT_EQ(run.run(), "");
      EXPECT_NEAR(mean_displacement(run, 2), 0.5, 1e-10);
      EXPECT_NEAR(last_record(run).energy_balance, 0, 1e-12);
    }
}

// A free bar of Z = rho c = 200^(1/2) N s/m^3 that flies at 1 m/s is braked at
// its end by dashpots of r Z, which dissipate r Z / (1 + r)^2 W until the wave
// returns. In one step the dashpots' force at the first velocity would exceed
// the momentum of the end. Cells of 1/8 m smear the wave: 4 % here.
TEST(ElasticSupports, ExplicitStartWithStrongDashpots)
{
  const double Z = std::sqrt(200.), end = 0.5;
  for (const std::string mass : {"row sum", "consistent"})
    for (const double r : {5., 10., 100.})
      {
        CompleteRun run(
          supported_box("4, 1, 1", "32, 1, 1", 200.) +
          section("Discretization", {{"Degree", 1}, {"Mass", mass}}) +
          supports("", "", fmt::format("x-max: {}; 0; 0", r * Z)) +
          initial_conditions("0; 0; 0", "1; 0; 0") +
          time_integration("central difference", end, 0.));
        ASSERT_EQ(run.run(), "");
        const double expected = r * Z / ((1 + r) * (1 + r)) * end;
        EXPECT_NEAR(last_record(run).dissipated_energy,
                    expected,
                    0.05 * expected);
        EXPECT_NEAR(last_record(run).energy_balance, 0, 1e-12);
      }
}

// The budget closes to round-off for all integrators that promise it, with
// springs whose stiffness depends on time, and dashpots; the energy of springs
// is part of the elastic energy. Also with moving supports.
TEST(ElasticSupports, BudgetCloses)
{
  for (const std::string &name :
       integrators_with([](const TimeIntegrator &integrator) {
         return integrator.closes_budget();
       }))
    for (const std::string k : {"3; 5; 7", "3; 5; 7 * (1.5 + sin(9 * t))"})
      for (const bool moves : {false, true})
        {
          const std::string motion =
            moves ?
              displacements("z-max: free; free; 0.1 * smooth_step(t, 0, 0.5)") :
              "";
          CompleteRun run(supported_box("1, 1, 1", "2, 2, 2", 100.) +
                          element_text(2) +
                          supports("z-min: " + k + ", z-max: 2; 2; 2",
                                   "x-max: 5",
                                   "y-min: 0.1; 0.2; 0.3 * t, z-max: 1; 1; 1") +
                          gravity("1; 2; -10 * cos(4 * t)") + motion +
                          time_integration(name, 1, 0.02));
          ASSERT_EQ(run.run(), "");
          const StepRecord &record = last_record(run);
          const double      energy =
            record.elastic_energy + record.dissipated_energy;
          EXPECT_GT(energy, 0.1);
          EXPECT_NEAR(record.energy_balance, 0, 1e-11 * energy) << name;
        }
}

// A block of 1 kg on springs with k(t) A = 2 / (2 - t^2) N/m: u = 2 - t^2
// solves u'' = - k u, starting at rest. The change of k adds the energy int k'
// u^2 / 2 dt = t^2 J. The acceleration is constant, so the trapezoidal rule is
// exact; the block itself yields by k L / E = 2e-7 of u.
TEST(ElasticSupports, StiffnessThatChanges)
{
  CompleteRun run(supported_box("1, 1, 1", "1, 1, 1", 1e7) +
                  supports("z-min: 1; 1; 2 / (2 - t^2)") +
                  initial_conditions("0; 0; 2", "0; 0; 0") +
                  time_integration("Newmark", 1, 0.05));
  ASSERT_EQ(run.run(), "");
  const StepRecord &record = last_record(run);
  EXPECT_NEAR(mean_displacement(run, 2), 1, 2e-7);
  EXPECT_NEAR(record.external_work, 1, 2e-7);
  EXPECT_NEAR(record.elastic_energy, 1, 4e-7);
  EXPECT_NEAR(record.kinetic_energy, 2, 4e-7);
}

// A stiffness that becomes negative ends the run, with place and time.
TEST(ElasticSupports, StiffnessThatBecomesNegative)
{
  CompleteRun       run(supported_box("1, 1, 1", "1, 1, 1", 10.) +
                  supports("z-min: 1; 1; if(t < 0.9, 1 - 2 * t, 1)") +
                  time_integration("implicit midpoint", 1, 0.1));
  const std::string message = run.run();
  EXPECT_NE(message.find("Supports/Elastic: found the value -"),
            std::string::npos)
    << message;
}

// Explicit and implicit steps converge to the same motion: differences decrease
// like dt^2, for corotational elasticity and large motion.
TEST(ElasticSupports, ExplicitAndImplicitSteps)
{
  double difference[2];
  for (const unsigned int i : {0, 1})
    {
      double u[2];
      for (const bool is_explicit : {false, true})
        {
          CompleteRun run(
            supported_box("1, 1, 1", "2, 1, 1", 100., "corotational") +
            element_text(Element::quadratic_with_bubbles()) +
            supports("x-min: 20; 30; 40", "", "x-min: 1; 1; 2") +
            gravity("0; 0; -3") +
            time_integration(is_explicit ? "central difference" :
                                           "implicit midpoint",
                             1,
                             i == 0 ? 0.004 : 0.002));
          ASSERT_EQ(run.run(), "");
          u[is_explicit] = mean_displacement(run, 2);
        }
      difference[i] = std::abs(u[1] - u[0]);
      EXPECT_GT(std::abs(u[0]), 0.1);
    }
  EXPECT_LT(difference[0], 1e-4);
  EXPECT_NEAR(difference[0] / difference[1], 4, 0.6);
}
