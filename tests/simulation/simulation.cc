// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Whole runs: equal results on any number of ranks, and failures that are
// reported.

#include <corotet/simulation/modal_analysis.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../refusal.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  const std::string swinging_beam =
    box_mesh("1, 0.2, 0.2", "5, 1, 1") + fixed("x-min") +
    pressures("z-max: 2000*t") + gravity("0; 0; -9.81") +
    section("Damping", {{"Stiffness coefficient", 1e-4}}) +
    section("Time integration", {{"End time", 0.2}, {"Time step", 0.01}}) +
    newton_tolerances(1e-10) + section("Linear solver", {{"Tolerance", 1e-11}});

  void
  expect_close(const double a, const double b, const double scale)
  {
    EXPECT_NEAR(a, b, 1e-8 * scale);
  }
} // namespace

// Parameters are values: two runs made from the same object, one within the
// other, have the same results to the last bit as a single run, with the same
// work; so have modes computed after that. BDF2 keeps vectors of earlier steps,
// the exact tangent a preconditioner.
TEST(Simulation, ParametersMakeAnyNumberOfRuns)
{
  const std::string text =
    swinging_beam + section("Time integration", {{"Type", "BDF2"}});
  CompleteRun alone(text);
  alone.run();

  const Parameters parameters(text);
  Log              log(MPI_COMM_WORLD, true);
  const auto       recorder = [] {
    std::vector<std::unique_ptr<Observer>> observers;
    observers.push_back(std::make_unique<Recorder>());
    return observers;
  };
  const auto outer_observers = recorder();
  const auto inner_observers = recorder();
  Simulation outer(parameters, "", MPI_COMM_WORLD, log);
  outer.start(outer_observers);
  outer.step();
  outer.step();
  {
    Simulation inner(parameters, "", MPI_COMM_WORLD, log);
    inner.run(inner_observers);
  }
  while (!outer.is_done())
    outer.step();
  outer.finish();

  const auto &expected = alone.recorder();
  ASSERT_EQ(expected.records.size(), 21u);
  for (const auto *observers : {&outer_observers, &inner_observers})
    {
      const auto &found = static_cast<const Recorder &>(*observers->front());
      ASSERT_EQ(found.records.size(), expected.records.size());
      for (std::size_t i = 0; i < expected.records.size(); ++i)
        {
          const StepRecord &a = found.records[i], &b = expected.records[i];
          EXPECT_EQ(a.elastic_energy, b.elastic_energy);
          EXPECT_EQ(a.kinetic_energy, b.kinetic_energy);
          EXPECT_EQ(a.linear_iterations, b.linear_iterations);
        }
      EXPECT_EQ(largest_difference(found.displacement, expected.displacement),
                0);
      EXPECT_EQ(found.summary.preconditioner_builds,
                expected.summary.preconditioner_builds);
    }
  EXPECT_GT(expected.summary.preconditioner_builds, 0u);

  std::vector<double> frequencies;
  for (unsigned int round = 0; round < 2; ++round)
    {
      ModalAnalysis analysis(parameters, "", MPI_COMM_WORLD, log);
      analysis.compute();
      frequencies.push_back(analysis.modes().front().frequency);
    }
  EXPECT_EQ(frequencies[0], frequencies[1]);
  EXPECT_GT(frequencies[0], 0);
}

// Each rank alone and all ranks together give the same history to 1e-8, as the
// solvers' tolerances (1e-11, 1e-10) allow.
TEST(Simulation, SameOnAnyNumberOfRanks)
{
  for (const unsigned int degree : {1, 2, 3})
    {
      const std::string text = swinging_beam + element_text(degree);
      CompleteRun alone(text, MPI_COMM_SELF), together(text, MPI_COMM_WORLD);
      alone.simulation.run(alone.observers);
      together.simulation.run(together.observers);
      const auto &a = alone.recorder().records;
      const auto &b = together.recorder().records;
      ASSERT_EQ(a.size(), 21u);
      ASSERT_EQ(b.size(), 21u);
      const double energy = a.back().external_work;
      for (unsigned int i = 0; i < a.size(); ++i)
        {
          expect_close(a[i].kinetic_energy, b[i].kinetic_energy, energy);
          expect_close(a[i].elastic_energy, b[i].elastic_energy, energy);
          expect_close(a[i].external_work, b[i].external_work, energy);
          expect_close(a[i].dissipated_energy, b[i].dissipated_energy, energy);
          expect_close(a[i].energy_balance, b[i].energy_balance, energy);
          expect_close(a[i].max_displacement,
                       b[i].max_displacement,
                       a.back().max_displacement);
          expect_close(a[i].min_det_F, b[i].min_det_F, 1);
          expect_close(a[i].volume, b[i].volume, 0.04);
          expect_close((a[i].momentum - b[i].momentum).norm(),
                       0,
                       a.back().momentum.norm());
          expect_close((a[i].angular_momentum - b[i].angular_momentum).norm(),
                       0,
                       a.back().angular_momentum.norm());
          expect_close((a[i].reaction - b[i].reaction).norm(),
                       0,
                       a.back().reaction.norm());
          EXPECT_EQ(a[i].inverted_cells, b[i].inverted_cells);
        }
      EXPECT_GT(a.back().dissipated_energy, 0.);
      EXPECT_TRUE(together.recorder().last);
      EXPECT_EQ(dealii::Utilities::MPI::sum(together.recorder().cells,
                                            MPI_COMM_WORLD),
                25u);
      EXPECT_EQ(together.recorder().summary.status, "done");
      EXPECT_EQ(together.recorder().summary.cells, 25u);
      EXPECT_EQ(together.recorder().summary.steps, 20u);
      EXPECT_NEAR(together.recorder().summary.mesh_volume, 0.04, 1e-15);
      EXPECT_NEAR(together.recorder().summary.total_mass, 40, 1e-12);
    }
}

// A failure keeps the computed results, tells the observers, and is thrown on.
TEST(Simulation, FailureIsTold)
{
  CompleteRun run(swinging_beam +
                    tractions(
                      "x-max: 0; 0; if(t > 0.051 && t < 0.1, 1/(t-t), 0)"),
                  MPI_COMM_WORLD);
  try
    {
      run.simulation.run(run.observers);
      FAIL() << "nothing was thrown";
    }
  catch (const ComputationError &error)
    {
      EXPECT_EQ(std::string(error.what())
                  .find("step 6 (t = 0.05125): the forces are not finite "
                        "where Newton's method starts: Boundary "
                        "conditions/Traction: the expression"),
                0u)
        << error.what();
      EXPECT_NE(
        std::string(error.what()).find("; the step has been halved 8 times"),
        std::string::npos)
        << error.what();
    }
  // There are five whole steps and a part of the sixth, as large as possible:
  // its forces are evaluated at 5/9 of its length (spectral radius 0.8).
  EXPECT_EQ(run.recorder().summary.status, "failed");
  EXPECT_EQ(run.recorder().summary.steps, 6u);
  ASSERT_EQ(run.recorder().records.size(), 7u);
  EXPECT_NEAR(run.recorder().records.back().time, 0.05125, 1e-14);
  EXPECT_TRUE(run.recorder().last);
}

// A failure before the first step leaves no results, but a summary.
TEST(Simulation, FailureAtTheStartIsTold)
{
  // The body is crushed to a plane, where this law has no stress.
  CompleteRun run(swinging_beam + material_type("neo-Hookean") +
                    initial_conditions("-x; 0; 0", "0; 0; 0"),
                  MPI_COMM_WORLD);
  try
    {
      run.simulation.run(run.observers);
      FAIL() << "nothing was thrown";
    }
  catch (const ComputationError &error)
    {
      EXPECT_EQ(std::string(error.what())
                  .find("step 1 (t = 0): the forces at the start are not "
                        "finite"),
                0u)
        << error.what();
    }
  EXPECT_EQ(run.recorder().summary.status, "failed");
  EXPECT_EQ(run.recorder().records.size(), 0u);
}

// Formulas are evaluated at the start and end of a run before anything is
// computed.
TEST(Simulation, FormulasThatAreNotFiniteAreRefused)
{
  for (const auto &[formula, time] :
       {std::pair("1/t", "0"), std::pair("1/(t-0.2)", "0.2")})
    EXPECT_EQ(refusal([&] {
                CompleteRun(swinging_beam +
                              gravity(fmt::format("0; 0; {}", formula)),
                            MPI_COMM_WORLD)
                  .run();
              })
                .find(fmt::format("Loads/Gravity: the expression \"{}\" is not "
                                  "finite: found infinity at (",
                                  formula)),
              0u)
      << time;
}

TEST(Simulation, EndTimeMustBeAfterStart)
{
  EXPECT_EQ(refusal([] {
              CompleteRun(section("Time integration", {{"Start time", 2}}),
                          MPI_COMM_WORLD);
            }),
            "Time integration/End time: found 1; allowed: a time after the "
            "start time 2");
}
