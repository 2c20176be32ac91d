// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// All integrators on bodies: orders in time, what they keep and what they lose,
// and budgets that close.

#include <corotet/time_integration/generalized_alpha.h>
#include <corotet/time_integration/time_integrators.h>

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

  double
  error_of(const State &state, const State &reference)
  {
    return largest_difference(state.u, reference.u);
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
  const std::string type   = GetParam();
  const double      end    = 1;
  const double      dt     = type == "backward Euler" ? 1. / 256 : 1. / 128;
  const State       finest = final_state(beam(type, dt / 16, end));
  const double error[]  = {error_of(final_state(beam(type, dt, end)), finest),
                           error_of(final_state(beam(type, dt / 2, end)),
                                   finest)};
  const double expected = type == "backward Euler" ? 1 : 2;
  const double p        = std::pow(2., -expected);
  const double p4       = std::pow(16., -expected);
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
// round-off with the implicit midpoint rule, and to the order of the method
// with others: of those that keep energy only this one has velocities of the
// support that fit its displacements.
TEST_P(Integrators, BudgetCloses)
{
  const std::string type = GetParam();
  // Two ranks sum as one does: one integrator is enough to see that.
  if (!on_one_rank() && type != "implicit midpoint")
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
  // Stable for the explicit method, too.
  const double dt   = type == "central difference" ? 2e-3 : 1e-2;
  const double left = balance(dt);
  report("energy balance, " + type, left);
  if (type == "implicit midpoint")
    EXPECT_LE(left, 1e-13);
  else
    {
      const double order = std::log2(left / balance(dt / 2));
      report("order of the energy balance, " + type, order);
      EXPECT_GE(order, type == "backward Euler" ? 0.9 : 1.8);
    }
}

INSTANTIATE_TEST_SUITE_P(Dynamic,
                         Integrators,
                         testing::Values("backward Euler",
                                         "BDF2",
                                         "implicit midpoint",
                                         "Newmark",
                                         "HHT-alpha",
                                         "generalized-alpha",
                                         "central difference"),
                         [](const auto &info) {
                           std::string name = info.param;
                           std::erase_if(name, [](const char c) {
                             return !std::isalnum(c);
                           });
                           return name;
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

class Conservation : public testing::TestWithParam<std::string>
{};

// 10,000 steps keep the energy of a linear body, and the work of what is not
// there is zero.
TEST_P(Conservation, LinearBody)
{
  if (!on_one_rank())
    GTEST_SKIP();
  CompleteRun run(free_bar(GetParam()));
  ASSERT_EQ(run.run({100, 0.}), "");
  double largest = 0, change = 0;
  for (const StepRecord &record : run.recorder().records)
    {
      largest = std::max(largest, record.elastic_energy);
      change  = std::max(change, std::abs(record.energy_balance));
    }
  EXPECT_EQ(run.recorder().summary.steps, 10000u);
  report("relative change of energy", change / largest);
  EXPECT_LE(change, 1e-10 * largest);
  EXPECT_EQ(run.recorder().records.back().external_work, 0.);
}

// The central difference method keeps the energy with staggered velocities.
INSTANTIATE_TEST_SUITE_P(
  Linear,
  Conservation,
  testing::Values("set Type = Newmark\n set Time step = 1e-2\n set End time = "
                  "100\n",
                  "set Type = implicit midpoint\n set Time step = 1e-2\n set "
                  "End time = 100\n",
                  "set Type = generalized-alpha\n set Time step = 1e-2\n set "
                  "End time = 100\n subsection generalized-alpha\n set "
                  "Spectral radius = 1\n end\n",
                  "set Type = central difference\n set Time step = 1e-3\n set "
                  "End time = 10\n"));
