// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Checks for all registered integrators, on bodies, that their stated
// properties hold: order in time, conserved and lost energy, budgets that
// close, independence of earlier runs.

#include "../integrators.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  // A corotational beam that is clamped at one end, starts in a smooth motion
  // that fits the support and bends through large rotations.
  std::string
  beam(const std::string &type, const double dt, const double end)
  {
    return box_mesh("4, 1, 1", "4, 1, 1") +
           element_text(1, "diagonal scaling") +
           rotation_at("quadrature points") + material_text(2e4) +
           fixed("x-min") + gravity("0; 0; -2*sin(4*t)") +
           initial_conditions("0; 0; 0", "0; 0; 0.6*x^2*(6-x)/6") +
           newton_tolerances(1e-12) + linear_solver("direct", 1e-10) +
           time_integration(type, end, dt);
  }

  State
  final_state(const std::string &text)
  {
    CompleteRun run(text);
    EXPECT_EQ(run.run(), "");
    return run.simulation.state();
  }

  // The error of displacement or velocity, whichever is larger.
  double
  error_of(const State &state, const State &reference)
  {
    return std::max(largest_difference(state.u, reference.u) /
                      reference.u.linfty_norm(),
                    largest_difference(state.v, reference.v) /
                      reference.v.linfty_norm());
  }
} // namespace

class Integrators : public testing::TestWithParam<std::string>
{};

// The order in time for a body that rotates far, from the difference to a run
// with a sixteenth of the step: for order q the differences of steps h and h /
// 2 have the exact ratio (1 - 16^-q) / (2^-q - 16^-q).
TEST_P(Integrators, OrderOnCorotationalBody)
{
  if (!on_one_rank())
    GTEST_SKIP();
  const std::string type     = GetParam();
  const double      expected = make_integrator(type)->order();
  const double      end      = 1;
  const double      dt       = expected == 1 ? 1. / 256 : 1. / 128;
  const State       finest   = final_state(beam(type, dt / 16, end));
  const double error[] = {error_of(final_state(beam(type, dt, end)), finest),
                          error_of(final_state(beam(type, dt / 2, end)),
                                   finest)};
  const double p       = std::pow(2., -expected);
  const double p4      = std::pow(16., -expected);
  // If the order is exact, the ratio of errors is that of the formula.
  const double order =
    expected + std::log2(error[0] / error[1]) - std::log2((1 - p4) / (p - p4));
  report("order, " + type, order);
  // The body must have rotated.
  EXPECT_GT(finest.u.linfty_norm(), 1.);
  EXPECT_NEAR(order, expected, 0.1);
}

// A body of linear elasticity with everything at once: gravity, a moving
// support, both kinds of damping, traction. The budget closes to round-off if
// the integrator says so (velocities of the support must fit its
// displacements), and with others to the order of the method.
TEST_P(Integrators, BudgetCloses)
{
  const std::string type       = GetParam();
  const auto        integrator = make_integrator(type);
  // On two ranks only sums differ, which exact budgets suffice to check.
  if (!on_one_rank() && !integrator->closes_budget())
    GTEST_SKIP();
  const auto balance = [&](const double dt) {
    CompleteRun run(
      box_mesh("3, 1, 1", "3, 1, 1") + material_type("linear") +
      material_text(2e5) +
      displacements("x-min: 0.02*sin(5*t); 0.01*t^2; free") +
      tractions("x-max: 0; 100*t; 50*sin(9*t)") + gravity("0; 1; -9.81") +
      section("Damping",
              {{"Mass coefficient", 0.5}, {"Stiffness coefficient", 1e-3}}) +
      newton_tolerances(1e-13) +
      section("Linear solver", {{"Tolerance", 1e-13}}) +
      time_integration(type, 1, dt));
    EXPECT_EQ(run.run(), "");
    double largest = 0, left = 0;
    for (const StepRecord &record : run.recorder().records)
      {
        largest = std::max({largest,
                            record.kinetic_energy,
                            record.elastic_energy,
                            record.dissipated_energy,
                            std::abs(record.external_work)});
        left    = std::max(left, std::abs(record.energy_balance));
      }
    EXPECT_GT(run.recorder().records.back().dissipated_energy, 0.01 * largest);
    EXPECT_GT(run.recorder().records.back().elastic_energy, 0.);
    return left / largest;
  };
  // The step is stable for explicit methods, too.
  const double dt   = integrator->stability() != nullptr ? 2e-3 : 1e-2;
  const double left = balance(dt);
  report("energy balance, " + type, left);
  if (integrator->closes_budget())
    EXPECT_LE(left, 1e-13);
  else
    {
      const double order = std::log2(left / balance(dt / 2));
      report("order of the energy balance, " + type, order);
      EXPECT_GE(order, 0.9 * integrator->order());
    }
}

// A bar with nearly no mass creeps under a sudden load: with damping by
// stiffness alpha and nu = 0, u = u_s (1 - exp(-t / alpha)). The density is so
// low that the acceleration at the start lasts for 1e-10 of a step; a method
// that derived a displacement from it would be wrong by many orders of
// magnitude. The velocity jumps within the first step, and methods that mix its
// values at start and end get half to twice the right value; this error decays
// as the creep does, and leaves an error of first order.
TEST_P(Integrators, LoadAtOnceOnDampedBar)
{
  const std::string type = GetParam();
  if (!on_one_rank() || make_integrator(type)->is_explicit())
    GTEST_SKIP();
  constexpr double E = 1e6, traction = 1e3, alpha = 1, volume = 2;
  // The ratio of the strain and its exact value in each step.
  const auto strains = [&](const unsigned int n) {
    CompleteRun run(box_mesh("2, 1, 1", "2, 1, 1") + material_type("linear") +
                    material_text(E, 0, 1e-6) + fixed("x-min") +
                    tractions(fmt::format("x-max: {}; 0; 0", traction)) +
                    section("Damping", {{"Stiffness coefficient", alpha}}) +
                    newton_tolerances(1e-12) + linear_solver("direct", 1e-12) +
                    time_integration(type, alpha, alpha / n));
    EXPECT_EQ(run.run(), "");
    std::vector<double> ratios;
    for (const StepRecord &record : run.recorder().steps)
      ratios.push_back(std::sqrt(2 * record.elastic_energy / (E * volume)) /
                       (traction / E * (1 - std::exp(-record.time / alpha))));
    return ratios;
  };
  const std::vector<double> coarse = strains(20), fine = strains(40);
  for (const double ratio : coarse)
    {
      EXPECT_GE(ratio, 0.4);
      EXPECT_LE(ratio, 2);
    }
  const double error = std::abs(coarse.back() - 1);
  const double order = std::log2(error / std::abs(fine.back() - 1));
  report("ratio of the first strain, " + type, coarse.front());
  report("error of the last strain, " + type, error);
  report("order of the last strain, " + type, order);
  EXPECT_LE(error, 0.05);
  EXPECT_GE(order, 0.9);
}

INSTANTIATE_TEST_SUITE_P(Dynamic,
                         Integrators,
                         testing::ValuesIn(integrators_with(is_dynamic)),
                         [](const auto &info) {
                           return letters_and_digits(info.param);
                         });

namespace
{
  // A free linear bar that vibrates, without supports or loads.
  std::string
  free_bar()
  {
    return box_mesh("2, 1, 1", "2, 1, 1") + element_text(1) +
           material_type("linear") + material_text(2e5) +
           initial_conditions("0.01*x^2; 0.02*y*z; 0.01*x*y", "y; z; x^2/4") +
           newton_tolerances(1e-14) + linear_solver("jacobi", 1e-13);
  }
} // namespace

namespace
{
  // The largest change of energy in 10,000 steps of @p dt, relative to the
  // elastic energy. Also checks that the external work is zero, as there are no
  // loads.
  double
  change_of_energy(const std::string &type,
                   const double       dt,
                   const Entries      further = {})
  {
    CompleteRun run(free_bar() + time_integration(type, 1e4 * dt, dt, further));
    EXPECT_EQ(run.run({100, 0.}), "");
    double largest = 0, change = 0;
    for (const StepRecord &record : run.recorder().records)
      {
        largest = std::max(largest, record.elastic_energy);
        change  = std::max(change, std::abs(record.energy_balance));
      }
    EXPECT_EQ(run.recorder().summary.steps, 10000u);
    EXPECT_EQ(run.recorder().records.back().external_work, 0.);
    report("relative change of energy, " + type, change / largest);
    return change / largest;
  }
} // namespace

class Conservation : public testing::TestWithParam<std::string>
{};

// A linear body keeps its energy over 10,000 steps, to their round-off.
TEST_P(Conservation, LinearBody)
{
  if (!on_one_rank())
    GTEST_SKIP();
  const double dt =
    make_integrator(GetParam())->stability() != nullptr ? 1e-3 : 1e-2;
  EXPECT_LE(change_of_energy(GetParam(), dt), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(
  All,
  Conservation,
  testing::ValuesIn(integrators_with([](const TimeIntegrator &method) {
    return method.keeps_energy();
  })),
  [](const auto &info) { return letters_and_digits(info.param); });

// The same holds with a spectral radius of 1, for a method that dissipates by
// default.
TEST(GeneralizedAlphaConservation, LinearBody)
{
  if (!on_one_rank())
    GTEST_SKIP();
  EXPECT_LE(change_of_energy("generalized-alpha",
                             1e-2,
                             {section("generalized-alpha",
                                      {{"Spectral radius", 1}})}),
            1e-10);
}

class Reset : public testing::TestWithParam<std::string>
{};

// Two runs use the same parameters object, so the same integrator and solvers:
// their bodies have equally many nodes, but other shapes; the first run is on
// all ranks, the second one on each rank alone, starting after the end time of
// the first. The second run must equal one with a new object, to the last bit.
TEST_P(Reset, RunsDoNotKnowEarlierOnes)
{
  const auto text = [&](const std::string &cells, const double start) {
    return box_mesh(cells, cells) + element_text(1, "diagonal scaling") +
           material_text(1e7) + gravity("1; 0; -5 * t") + fixed("z-min") +
           linear_solver("direct") +
           time_integration(GetParam(),
                            start + 0.005,
                            0.001,
                            {{"Start time", start}});
  };
  // The displacement of the nodes that this rank owns, at the end of a run.
  const auto final_displacement = [](Parameters    &parameters,
                                     const MPI_Comm comm) {
    Log        log(comm, true);
    Simulation simulation(parameters, "", comm, log);
    simulation.run({});
    const Vector &u = simulation.state().u;
    return std::vector<double>(u.begin(), u.begin() + u.locally_owned_size());
  };
  const std::string         second = text("1, 2, 6", 3.);
  Parameters                used(text("6, 2, 1", 0.)), fresh(second);
  const std::vector<double> first = final_displacement(used, MPI_COMM_WORLD);
  used.prm.parse_input_from_string(second);
  const std::vector<double> found = final_displacement(used, MPI_COMM_SELF);
  EXPECT_EQ(found.size(),
            dealii::Utilities::MPI::sum(first.size(), MPI_COMM_WORLD));
  EXPECT_NE(found, std::vector<double>(found.size()));
  EXPECT_EQ(found, final_displacement(fresh, MPI_COMM_SELF));
}

INSTANTIATE_TEST_SUITE_P(All,
                         Reset,
                         testing::ValuesIn(integrators_with(
                           [](const TimeIntegrator &) { return true; })),
                         [](const auto &info) {
                           return letters_and_digits(info.param);
                         });
