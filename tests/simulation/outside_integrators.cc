// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Integrators that are not part of the library, added as a program that uses it
// would: an implicit one with a parameter and an explicit one. As long as they
// are in the list, all tests that loop over it test them, too: orders, budgets,
// moving supports, free fall.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../integrators.h"
#include "../refusal.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // The Wilson theta method (Wilson, Farhoomand, Bathe, Nonlinear dynamic
  // analysis of complex structures, 1973): the acceleration is linear from t to
  // t + theta dt, where the equation of motion holds. Second order;
  // unconditionally stable for theta >= 1.37 on linear problems.
  class WilsonTheta : public TimeIntegrator
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override
    {
      prm.add_parameter("Theta",
                        theta,
                        "theta [-].",
                        dealii::Patterns::Double(1.37, 10));
    }

    void
    reset() override
    {
      far.clear();
    }

    StageReport
    step(SecondOrderSystem &system, const TimeStep &step, State &state) override
    {
      const double dt = step.dt, h = theta * dt;
      // The guess: the acceleration does not change.
      far.u = state.u;
      far.u.add(h, state.v, 0.5 * h * h, state.a);
      far.v = state.v;
      far.v.add(h, state.a);
      far.a = state.a;
      system.prescribe(far, step.time + h, 1.);
      const StageReport report = system.solve_stage(
        far, {step.time + h, 3 / h, 6 / (h * h), 1., &state, 0.5 * h * h});

      // The acceleration at the end of the step; displacement and velocity
      // follow by integration from the start.
      far.a.sadd(1 / theta, 1 - 1 / theta, state.a);
      state.u.add(dt, state.v, dt * dt / 3, state.a);
      state.u.add(dt * dt / 6, far.a);
      state.v.add(0.5 * dt, state.a, 0.5 * dt, far.a);
      state.a = far.a;
      system.prescribe(state, step.end, 1.);
      return report;
    }

    unsigned int
    order() const override
    {
      return 2;
    }

    double theta = 1.4;

  private:
    State far;
  };

  // Symplectic Euler: v_1 = v_0 + dt a_0, u_1 = u_0 + dt v_1. Its displacements
  // are those of the central difference method that starts with v_0 half a step
  // early.
  class SymplecticEuler : public TimeIntegrator
  {
  public:
    StageReport
    step(SecondOrderSystem &system, const TimeStep &step, State &state) override
    {
      state.v.add(step.dt, state.a);
      state.u.add(step.dt, state.v);
      system.prescribe(state, step.end, 1.);
      return system.solve_acceleration(state, step.end);
    }

    unsigned int
    order() const override
    {
      return 1;
    }

    bool
    is_explicit() const override
    {
      return true;
    }

    bool
    balances_at_end() const override
    {
      return true;
    }

    const StabilityControl *
    stability() const override
    {
      return &control;
    }

    // The step where (omega dt)^2 + 2 alpha_K omega^2 dt = 4.
    double
    stable_step(const double omega, const double alpha_K) const override
    {
      const double c = alpha_K * omega;
      return 4 / (omega * (std::hypot(c, 2.) + c));
    }

  private:
    StabilityControl control;
  };

  const AddedCandidate<TimeIntegrator>
    wilson_theta(candidate<TimeIntegrator, WilsonTheta>("Wilson theta"));
  const AddedCandidate<TimeIntegrator> symplectic_euler(
    candidate<TimeIntegrator, SymplecticEuler>("symplectic Euler"));

  // A clamped linear bar, at rest, that is pulled along its axis from time 0 on
  // by a traction of 100 sin(pi t).
  std::string
  pulled_bar(const std::string &type,
             const double       time_step,
             const Entries      more = {})
  {
    return box_mesh("2, 1, 1", "2, 1, 1") +
           element_text(1, "diagonal scaling") + material_type("linear") +
           material_text(2e5) + fixed("x-min") +
           tractions("x-max: 100*sin(pi*t); 0; 0") +
           linear_solver("direct", 1e-12) + newton_tolerances(1e-12) +
           time_integration(type, 1, time_step, more);
  }

  Vector
  pulled(const std::string &type,
         const double       time_step,
         const Entries      more = {})
  {
    CompleteRun run(pulled_bar(type, time_step, more));
    EXPECT_EQ(run.run(), "");
    EXPECT_GT(run.recorder().records.back().external_work, 0.);
    return run.simulation.state().u;
  }
} // namespace

// The added integrators follow those of the library in the list, so its tests
// use them, too.
TEST(OutsideIntegrators, AreInTheList)
{
  const auto all = time_integrators();
  ASSERT_GE(all.size(), 3u);
  EXPECT_EQ(all[all.size() - 2].name, "Wilson theta");
  EXPECT_EQ(all[all.size() - 1].name, "symplectic Euler");
  EXPECT_NE(all[0].name, "Wilson theta");
}

// An added integrator works from the parameter file to the last step: selected
// by name, with its own parameter, of second order for all theta.
TEST(OutsideIntegrators, ImplicitWithAParameter)
{
  const auto run = [](const double theta, const unsigned int n) {
    return pulled("Wilson theta",
                  1. / n,
                  {section("Wilson theta", {{"Theta", theta}})});
  };
  // The reference is of second order, too, with steps 16 times shorter than the
  // shorter ones below: its error is half a percent of theirs, and 0.01 in the
  // order.
  const Vector reference = run(1.4, 32768);
  double       errors[2];
  for (const double theta : {1.4, 2.})
    {
      for (const unsigned int i : {0, 1})
        errors[i] = largest_difference(run(theta, 1024 << i), reference);
      const double order = std::log2(errors[0] / errors[1]);
      report(fmt::format("order, theta = {}", theta), order);
      EXPECT_NEAR(order, 2, 0.1);
    }
  EXPECT_GT(largest_difference(run(1.4, 1024), run(2., 1024)), 0.1 * errors[0]);
  EXPECT_THROW(run(1.2, 1), std::exception) << "1.37 is the least";
}

// The integrator is explicit by its functions, not by its name: the program can
// choose its step, and larger steps than the stable one are refused.
// Displacements are those of the central difference method with an initial
// velocity that is half a step of acceleration ahead; from rest without forces
// there is no difference, so they agree to round-off.
TEST(OutsideIntegrators, Explicit)
{
  CompleteRun by_itself(pulled_bar("symplectic Euler", 0));
  ASSERT_EQ(by_itself.run(), "");
  EXPECT_GT(by_itself.recorder().summary.steps, 10u);

  const Vector u = pulled("symplectic Euler", 2e-3);
  const Vector v = pulled("central difference", 2e-3);
  EXPECT_GT(u.linfty_norm(), 1e-5);
  EXPECT_LE(largest_difference(u, v), 1e-10 * u.linfty_norm());

  const std::string text =
    refusal([] { CompleteRun(pulled_bar("symplectic Euler", 1)); });
  EXPECT_NE(text.find("which is unstable"), std::string::npos) << text;
  // Messages name all methods that allow it, added ones included.
  EXPECT_EQ(refusal([] { CompleteRun(pulled_bar("Wilson theta", 0)); }),
            "Time integration/Time step: found 0; allowed: a positive number "
            "(0, the program's choice, with Type = central difference, "
            "symplectic Euler)");
}

// An added integrator is in the list as long as its AddedCandidate lives.
TEST(OutsideIntegrators, LeaveTheList)
{
  const auto names = [] {
    return integrators_with([](const TimeIntegrator &) { return true; });
  };
  const auto        before = names();
  const std::string text   = section("Time integration", {{"Type", "third"}});
  {
    const AddedCandidate<TimeIntegrator> third(
      candidate<TimeIntegrator, SymplecticEuler>("third"));
    EXPECT_EQ(names().size(), before.size() + 1);
    EXPECT_EQ(Parameters(text).time_integrator.name(), "third");
  }
  EXPECT_EQ(names(), before);
  EXPECT_THROW(Parameters parameters(text), std::exception);
}
