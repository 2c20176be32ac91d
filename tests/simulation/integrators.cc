// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// All integrators of the list on bodies, and whether they are what they say of
// themselves: orders in time, what they keep and what they lose, budgets that
// close, runs that know nothing of earlier ones.

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
    return fmt::format(R"(
      subsection Mesh
        subsection box
          set Size  = 4, 1, 1
          set Cells = 4, 1, 1
        end
      end
      subsection Discretization
        set Degree = 1
        set Mass   = diagonal scaling
      end
      subsection Material
        set Rotation        = quadrature points
        set Young's modulus = 2e4
        set Density         = 1000
      end
      subsection Boundary conditions
        set Fixed = x-min
      end
      subsection Loads
        set Gravity = 0; 0; -2*sin(4*t)
      end
      subsection Initial conditions
        set Velocity = 0; 0; 0.6*x^2*(6-x)/6
      end
      subsection Newton
        set Residual tolerance  = 1e-12
        set Increment tolerance = 1e-12
      end
      subsection Linear solver
        set Type      = direct
        set Tolerance = 1e-10
      end
      subsection Time integration
        set Type      = {}
        set Time step = {}
        set End time  = {}
      end)",
                       type,
                       dt,
                       end);
  }

  State
  final_state(const std::string &text)
  {
    CompleteRun run(text);
    EXPECT_EQ(run.run(), "");
    return run.simulation.state();
  }

  // Of displacement or velocity, whichever is less accurate.
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

// Order in time of a body that turns far, by the difference from a run with a
// sixteenth of the step: for order q the differences of steps h and h / 2 have
// the ratio (1 - 16^-q) / (2^-q - 16^-q), known exactly.
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
  // The ratio of an exact order is that of the differences.
  const double order =
    expected + std::log2(error[0] / error[1]) - std::log2((1 - p4) / (p - p4));
  report("order, " + type, order);
  // The body has turned.
  EXPECT_GT(finest.u.linfty_norm(), 1.);
  EXPECT_NEAR(order, expected, 0.1);
}

// A body on which everything acts at once, linear elasticity: gravity, a
// support that moves, damping of both kinds, traction. The budget closes to
// round-off where the integrator says so (velocities of the support must fit
// its displacements), and to the order of the method with others.
TEST_P(Integrators, BudgetCloses)
{
  const std::string type       = GetParam();
  const auto        integrator = make_integrator(type);
  // Two ranks sum as one does: exact budgets are enough to see that.
  if (!on_one_rank() && !integrator->closes_budget())
    GTEST_SKIP();
  const auto balance = [&](const double dt) {
    CompleteRun run(fmt::format(R"(
      subsection Mesh
        subsection box
          set Size  = 3, 1, 1
          set Cells = 3, 1, 1
        end
      end
      subsection Material
        set Type            = linear
        set Young's modulus = 2e5
      end
      subsection Boundary conditions
        set Displacement = x-min: 0.02*sin(5*t); 0.01*t^2; free
        set Traction     = x-max: 0; 100*t; 50*sin(9*t)
      end
      subsection Loads
        set Gravity = 0; 1; -9.81
      end
      subsection Damping
        set Mass coefficient      = 0.5
        set Stiffness coefficient = 1e-3
      end
      subsection Newton
        set Residual tolerance  = 1e-13
        set Increment tolerance = 1e-13
      end
      subsection Linear solver
        set Tolerance = 1e-13
      end
      subsection Time integration
        set Type      = {}
        set Time step = {}
        set End time  = 1
      end)",
                                type,
                                dt));
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
  // Stable for explicit methods, too.
  const double dt   = integrator->stability() ? 2e-3 : 1e-2;
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
  free_bar(const std::string &integration)
  {
    return fmt::format(R"(
      subsection Mesh
        subsection box
          set Size  = 2, 1, 1
          set Cells = 2, 1, 1
        end
      end
      subsection Discretization
        set Degree = 1
      end
      subsection Material
        set Type            = linear
        set Young's modulus = 2e5
      end
      subsection Initial conditions
        set Displacement = 0.01*x^2; 0.02*y*z; 0.01*x*y
        set Velocity     = y; z; x^2/4
      end
      subsection Newton
        set Residual tolerance  = 1e-14
        set Increment tolerance = 1e-14
      end
      subsection Linear solver
        set Type      = jacobi
        set Tolerance = 1e-13
      end
      subsection Time integration
        {}
      end)",
                       integration);
  }
} // namespace

namespace
{
  // 10,000 steps of @p dt: the largest change of the energy, relative to the
  // elastic one. The work of what is not there is zero.
  double
  change_of_energy(const std::string &type,
                   const double       dt,
                   const std::string &further = "")
  {
    CompleteRun run(free_bar(
      fmt::format("set Type = {}\n set Time step = {}\n set End time = {}\n{}",
                  type,
                  dt,
                  1e4 * dt,
                  further)));
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

// A linear body keeps its energy over 10,000 steps of round-off.
TEST_P(Conservation, LinearBody)
{
  if (!on_one_rank())
    GTEST_SKIP();
  const double dt = make_integrator(GetParam())->stability() ? 1e-3 : 1e-2;
  EXPECT_LE(change_of_energy(GetParam(), dt), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(
  All,
  Conservation,
  testing::ValuesIn(integrators_with([](const TimeIntegrator &method) {
    return method.keeps_energy();
  })),
  [](const auto &info) { return letters_and_digits(info.param); });

// The same with a spectral radius of 1, of a method that dissipates by default.
TEST(GeneralizedAlphaConservation, LinearBody)
{
  if (!on_one_rank())
    GTEST_SKIP();
  EXPECT_LE(change_of_energy("generalized-alpha",
                             1e-2,
                             "subsection generalized-alpha\n set Spectral "
                             "radius = 1\n end\n"),
            1e-10);
}

class Reset : public testing::TestWithParam<std::string>
{};

// Two runs with the same parameters object, whose integrator and solvers so are
// the same: bodies with equally many nodes, but other shapes, the first one on
// all ranks and the second one on each by itself, starting after the end of the
// first. It must be that of an object that knows no earlier run, to the last
// bit.
TEST_P(Reset, RunsDoNotKnowEarlierOnes)
{
  const auto text = [&](const std::string &cells, const double start) {
    return fmt::format(R"(
      subsection Mesh
        subsection box
          set Size  = {0}
          set Cells = {0}
        end
      end
      subsection Discretization
        set Degree = 1
        set Mass   = diagonal scaling
      end
      subsection Material
        set Young's modulus = 1e7
      end
      subsection Loads
        set Gravity = 1; 0; -5 * t
      end
      subsection Boundary conditions
        set Fixed = z-min
      end
      subsection Linear solver
        set Type = direct
      end
      subsection Time integration
        set Type       = {1}
        set Start time = {2}
        set End time   = {3}
        set Time step  = 0.001
      end)",
                       cells,
                       GetParam(),
                       start,
                       start + 0.005);
  };
  // Of the nodes that this rank owns.
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
