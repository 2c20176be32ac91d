// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Runs at the limits of the arithmetic: stiff bodies that move far, thin ones,
// loads that vanish, time steps that differ in their last digit.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../integrators.h"
#include "../oscillator.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  constexpr double g = -9.81;

  const std::string steel =
    box_mesh("1, 0.2, 0.2", "3, 1, 1") + material_text(2.1e11, 0.3, 7850);

  const std::vector<std::string> laws{
    "set Type = linear",
    "set Rotation = cell centre",
    "set Rotation = quadrature points",
    "set Rotation = cell centre, variational"};

  // The largest distance of a node's displacement from (0, 0, @p z).
  double
  distance_from(const Vector &u, const double z)
  {
    double largest = 0;
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      largest =
        std::max(largest, std::abs(u.local_element(i) - (i % 3 == 2 ? z : 0)));
    return dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
  }

  unsigned int
  most_iterations(const std::vector<StepRecord> &steps,
                  const std::size_t              first,
                  const std::size_t              end)
  {
    unsigned int most = 0;
    for (std::size_t k = first; k < end; ++k)
      most = std::max(most, steps[k].newton_iterations);
    return most;
  }

  // The position of a point mass that falls from rest in @p n steps of the
  // integrator; checks that it is near the exact one: the error constants of
  // the integrators in use are 1 and 1.5.
  double
  fallen(TimeIntegrator &integrator, const unsigned int n, const double dt)
  {
    Oscillator mass;
    mass.k      = 0;
    mass.weight = mass.m * g;
    State state = initial_state(mass, 0., 0.);
    for (unsigned int i = 0; i < n; ++i)
      integrator.step(mass, {i * dt, dt, (i + 1.) / n}, state);
    const double z = state.u.local_element(0);
    EXPECT_NEAR(z / (0.5 * g * n * dt * n * dt),
                1,
                2 / std::pow(n, integrator.order()));
    return z;
  }
} // namespace

class FreeFall
  : public testing::TestWithParam<std::tuple<unsigned int, std::string>>
{};

// A steel block falls for five seconds, 120 m: then round-off of positions is a
// strain of 1e-13 in its cells of 0.2 m, so a stress of 0.03 Pa, while gravity
// causes 8 kPa. The displacement must be that of a point mass to 1e-9, and each
// step takes one iteration at most, as the rest is round-off.
TEST_P(FreeFall, OfSteel)
{
  const auto [degree, law] = GetParam();
  constexpr unsigned int n = 250;
  constexpr double       T = 5;
  for (const std::string &name : integrators_with(is_implicit_dynamic))
    {
      CompleteRun fall(
        steel + element_text(degree) + section("Material", {law}) +
        gravity(fmt::format("0; 0; {}", g)) + time_integration(name, T, T / n));
      ASSERT_EQ(fall.run(), "") << name;
      const auto &steps = fall.recorder().steps;
      ASSERT_EQ(steps.size(), n);
      const double z = fallen(*make_integrator(name), n, T / n);
      EXPECT_LE(distance_from(fall.recorder().displacement, z),
                1e-9 * std::abs(z))
        << name;
      EXPECT_LE(most_iterations(steps, 0, n), 1u) << name;
      for (const StepRecord &step : steps)
        ASSERT_EQ(step.parts, 1u) << name;
    }
}

// The same with explicit steps of 1e-5 s, starting 100 m further down: they are
// exact for a constant acceleration.
TEST_P(FreeFall, OfSteelExplicitly)
{
  const auto [degree, law] = GetParam();
  constexpr double z = -100, v = -44, T = 2e-3;
  CompleteRun      fall(
    steel + element_text(degree, "diagonal scaling") +
    section("Material", {law}) +
    initial_conditions(fmt::format("0; 0; {}", z), fmt::format("0; 0; {}", v)) +
    gravity(fmt::format("0; 0; {}", g)) +
    time_integration("central difference", T, 0));
  ASSERT_EQ(fall.run(), "");
  EXPECT_LE(distance_from(fall.recorder().displacement,
                          z + v * T + 0.5 * g * T * T),
            1e-9 * std::abs(z));
}

INSTANTIATE_TEST_SUITE_P(All,
                         FreeFall,
                         testing::Combine(testing::Values(1u, 2u, 3u),
                                          testing::ValuesIn(laws)),
                         [](const auto &info) {
                           std::string name =
                             fmt::format("P{}_{}",
                                         std::get<0>(info.param),
                                         std::get<1>(info.param).substr(4));
                           std::erase_if(name, [](const char c) {
                             return !std::isalnum(c) && c != '_';
                           });
                           return name;
                         });

class StiffBody : public testing::TestWithParam<std::string>
{};

// A support that moves by 10 m in a second carries a steel block, which its
// inertia bends by far less than a millimetre.
TEST_P(StiffBody, IsCarriedFar)
{
  CompleteRun ride(
    steel + section("Material", {GetParam()}) +
    displacements("x-min: 0; 0; 10 * smooth_step(t, 0, 1)") +
    section("Time integration", {{"End time", 1.2}, {"Time step", 0.01}}));
  ASSERT_EQ(ride.run(), "");
  const auto &steps = ride.recorder().steps;
  EXPECT_LE(distance_from(ride.recorder().displacement, 10), 1e-4);
  EXPECT_LE(most_iterations(steps, 0, steps.size()), 4u);
  for (const StepRecord &step : steps)
    ASSERT_EQ(step.parts, 1u);
}

INSTANTIATE_TEST_SUITE_P(Laws,
                         StiffBody,
                         testing::ValuesIn(laws),
                         [](const auto &info) {
                           return fmt::format("Law{}", info.index);
                         });

class LinearStatics : public testing::TestWithParam<std::string>
{};

namespace
{
  CompleteRun
  linear_statics(const std::string &solver, const std::string &more)
  {
    return CompleteRun(
      box_mesh("1, 0.125, 0.125", "6, 1, 1") + material_type("linear") +
      material_text(1e7) + statics(4) +
      section("Time integration",
              {section("static", {{"Proportional loading", false}})}) +
      linear_solver(solver) + more);
  }

  // The linear solver's tolerance, times the amplification of residuals in a
  // slender body.
  constexpr double slender = 1e3 * 1e-8;
} // namespace

// The beam is loaded and unloaded: in the last step no force is left.
TEST_P(LinearStatics, Unloads)
{
  CompleteRun beam =
    linear_statics(GetParam(),
                   fixed("x-min") + tractions("x-max: 0; 0; 200 * "
                                              "triangle(t, 0, 1)"));
  ASSERT_EQ(beam.run(), "");
  const auto &steps = beam.recorder().steps;
  ASSERT_EQ(steps.size(), 4u);
  // Beam theory gives F L^3 / (3 E I) = 5.12 mm, to which six quadratic cells
  // are close.
  EXPECT_NEAR(steps[1].max_displacement, 5.12e-3, 0.05 * 5.12e-3);
  EXPECT_NEAR(steps[0].max_displacement,
              0.5 * steps[1].max_displacement,
              slender * steps[1].max_displacement);
  EXPECT_LE(steps[3].max_displacement, slender * steps[1].max_displacement);
  for (const StepRecord &step : steps)
    EXPECT_EQ(step.newton_iterations, 1u);
}

// A body that is carried by its support has no forces at all.
TEST_P(LinearStatics, IsCarriedBySupport)
{
  CompleteRun beam =
    linear_statics(GetParam(),
                   displacements("x-min: 0; 0; 0.1 * triangle(t, 0, 1)"));
  ASSERT_EQ(beam.run(), "");
  const auto &steps = beam.recorder().steps;
  ASSERT_EQ(steps.size(), 4u);
  // Forces of cells that are crushed at the support do not count for the
  // tolerance: solves go on until only their round-off is left.
  constexpr double exact = 1e-6 * slender;
  EXPECT_NEAR(steps[1].max_displacement, 0.1, exact * 0.1);
  EXPECT_LE(distance_from(beam.recorder().displacement, 0), exact * 0.1);
  for (const StepRecord &step : steps)
    {
      // A factorisation may be as accurate as two iterative solves.
      EXPECT_GE(step.newton_iterations, 1u);
      EXPECT_LE(step.newton_iterations, 3u);
    }
}

INSTANTIATE_TEST_SUITE_P(Solvers,
                         LinearStatics,
                         testing::Values("p-multigrid", "direct", "jacobi"),
                         [](const auto &info) {
                           std::string name = info.param;
                           std::erase(name, '-');
                           return name;
                         });

// A plate that is released in long steps: at the first guess the accelerations
// of the fastest waves cause forces that are 1e8 times those of the solution.
// The tolerance must not be relative to these.
TEST(RoundOff, ForcesOfAGuessDoNotCount)
{
  for (const std::string solver : {"automatic", "direct"})
    {
      CompleteRun plate(
        box_mesh("1, 0.02, 0.3", "10, 1, 3") +
        section("Discretization", {{"Degree", 3}}) +
        material_text(2e11, 0.3, 7800) + material_type("linear") +
        fixed("x-min") + initial_conditions("0; 0.01 * x^2; 0", "0; 0; 0") +
        time_integration("Newmark", 0.02, 0.01) + linear_solver(solver));
      ASSERT_EQ(plate.run(), "");
      const StepRecord &last   = plate.recorder().steps.back();
      const double      energy = last.kinetic_energy + last.elastic_energy;
      // This method keeps the energy up to the solver's tolerance.
      EXPECT_LE(std::abs(last.energy_balance), 1e-8 * energy) << solver;
    }
}

// Springs vanish at the end of the run, so nothing resists the weight: a
// residual must not be accepted as the round-off of ever larger displacements.
TEST(RoundOff, NothingResists)
{
  CompleteRun body(box_mesh("1, 1, 1", "3, 3, 3") + fixed("") +
                   gravity("0; 0; -9.81") +
                   supports("z-min: 1e6*(1-t); 1e6*(1-t); 1e6*(1-t)") +
                   statics(2, 1) + linear_solver("direct"));
  EXPECT_NE(body.run(), "");
}

namespace
{
  struct ForcelessCase
  {
    std::string  name;
    std::string  text;
    unsigned int n_steps;
    /// The largest number of iterations of a step [-]: more than one is only
    /// needed to follow a support or a load.
    unsigned int n_iterations;
  };

  const std::string block = box_mesh("1, 0.2, 0.2", "5, 1, 1");

  const std::string turned = "x*(cos(t)-1)-y*sin(t); x*sin(t)+y*(cos(t)-1); 0";

  const std::vector<ForcelessCase> forceless_cases{
    {"SupportTurnsInTwoLoadSteps",
     block + displacements("x-min: " + turned) + statics(2) +
       section("Time integration",
               {section("static", {{"Proportional loading", false}})}),
     2,
     10},
    {"LoadGoesToZeroAndStays",
     block + material_type("neo-Hookean") + fixed("x-min") +
       tractions("x-max: 0; 0; 100 * max(0, 0.5 - t)") + statics(8) +
       section("Time integration",
               {section("static", {{"Proportional loading", false}})}),
     8,
     10},
    {"DriftsFreely",
     block + initial_conditions("0; 0; 0", "1; 2; 3") +
       time_integration("BDF2", 1, 0.05),
     20,
     1},
    {"CarriedBySupport",
     block + initial_conditions("0; 0; 0", "1; 2; 3") +
       displacements("x-min: t; 2*t; 3*t") +
       time_integration("generalized-alpha", 1, 0.05),
     20,
     1},
    {"CarriedBySupportLinearly",
     block + material_type("linear") +
       initial_conditions("0; 0; 0", "1; 2; 3") +
       displacements("x-min: t; 2*t; 3*t") +
       time_integration("generalized-alpha", 1, 0.05),
     20,
     1},
    {"TurnedAtRest",
     block +
       initial_conditions("x*(cos(1)-1)-y*sin(1); "
                          "x*sin(1)+y*(cos(1)-1); 0",
                          "0; 0; 0") +
       time_integration("generalized-alpha", 1, 0.05),
     20,
     1},
    {"FoilFalls",
     box_mesh("1, 0.2, 0.0001", "5, 1, 1") + material_text(2.1e11, 0.3, 7850) +
       gravity("0; 0; -9.81") + time_integration("generalized-alpha", 6, 0.05),
     120,
     1}};
} // namespace

class Forceless : public testing::TestWithParam<ForcelessCase>
{};

// Bodies whose forces are round-off, or below it, must reach the end, in the
// given steps and with few iterations.
TEST_P(Forceless, ReachesTheEnd)
{
  CompleteRun run(GetParam().text);
  ASSERT_EQ(run.run(), "");
  const auto &steps = run.recorder().steps;
  ASSERT_EQ(steps.size(), GetParam().n_steps);
  EXPECT_LE(most_iterations(steps, 0, steps.size()), GetParam().n_iterations);
  for (const StepRecord &step : steps)
    EXPECT_EQ(step.parts, 1u);
}

INSTANTIATE_TEST_SUITE_P(Cases,
                         Forceless,
                         testing::ValuesIn(forceless_cases),
                         [](const auto &info) { return info.param.name; });

// A beam with a thickness of 1 / 3,750 of its length: its residual cannot fall
// below some 1e-7 of the forces, for any solver.
TEST(RoundOff, ThinBeam)
{
  CompleteRun beam = linear_statics("direct",
                                    box_mesh("3.75, 0.001, 0.001", "60, 1, 1") +
                                      material_text(1e7, 0) + fixed("x-min") +
                                      tractions("x-max: 0; 0; 1e-4"));
  ASSERT_EQ(beam.run(), "");
  const auto &steps = beam.recorder().steps;
  // The deflection is F L^3 / (3 E I), with F = 1e-4 h^2 and I = h^4 / 12. It
  // is cubic, and each quadratic cell approximates it in a sixtieth of the
  // length.
  const double deflection = 4 * 1e-4 * std::pow(3.75, 3) / (1e7 * 1e-6);
  EXPECT_NEAR(steps[0].max_displacement, deflection, 1e-2 * deflection);
  for (const StepRecord &step : steps)
    EXPECT_LE(step.newton_iterations, 2u);
}

// Steps of 0.007 s differ in their last digit; the preconditioner must be kept.
// (A half step, or another one, makes a new one.)
TEST(RoundOff, PreconditionerStays)
{
  for (const std::string &integrator : integrators_with(is_implicit_dynamic))
    {
      CompleteRun run(material_type("linear") + fixed("x-min") +
                      tractions("x-max: 0; 0; 1") +
                      time_integration(integrator, 0.7, 0.007));
      ASSERT_EQ(run.run(), "");
      EXPECT_EQ(run.recorder().steps.size(), 100u);
      // Multistep methods begin with steps of another method.
      EXPECT_EQ(run.recorder().summary.preconditioner_builds,
                1 + make_integrator(integrator)->n_earlier_steps())
        << integrator;
    }
}

// A bar that rotates by a radian takes somewhat more iterations with each step,
// but never half as many again: when the extra iterations have cost as much as
// a new preconditioner, one is made.
TEST(RoundOff, PreconditionerOfATurningBodyIsRenewed)
{
  CompleteRun run(box_mesh("2, 0.1, 0.1", "20, 1, 1") + material_text(1e6, 0) +
                  initial_conditions("0; 0; 0", "-3*y; 3*x; 0") +
                  time_integration("Newmark", 0.4, 0.004));
  ASSERT_EQ(run.run(), "");
  const auto &steps = run.recorder().steps;
  EXPECT_GE(run.recorder().summary.preconditioner_builds, 3u);
  EXPECT_LT(run.recorder().summary.preconditioner_builds, steps.size() / 4);
}
