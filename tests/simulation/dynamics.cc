// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Dynamics compared with conservation laws and exact motions.

#include <corotet/simulation/energy_budget.h>
#include <corotet/time_integration/backward_euler.h>
#include <corotet/time_integration/generalized_alpha.h>
#include <corotet/time_integration/newmark.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  // Makes @p n steps of @p body from time 0 to @p end.
  StepRecord
  run(MovingBody     &body,
      TimeIntegrator &integrator,
      const double    end,
      unsigned int    n)
  {
    integrator.reset();
    body.system.prescribe(body.state, 0., 1.);
    body.system.solve_acceleration(body.state, 0.);
    EnergyBudget budget(body.system.equation(), body.state, 0.);
    StepRecord   record = budget.initial_record();
    for (unsigned int i = 0; i < n; ++i)
      {
        integrator.step(body.system,
                        {i * end / n, end / n, (i + 1.) / n},
                        body.state);
        budget.account(body.state, (i + 1) * end / n, end / n);
        budget.record(record, body.state, (i + 1) * end / n);
      }
    return record;
  }

  const std::string exact_solvers =
    newton_tolerances(1e-13) + linear_solver("jacobi", 1e-13);

  void
  vibrate(MovingBody &body)
  {
    body.state.v.copy_locally_owned_data_from(
      body.interpolate([](const Point<3> &x) {
        return Tensor<1, 3>({0., x[0] * x[0], 0.3 * x[0]});
      }));
  }
} // namespace

class DynamicsTest
  : public testing::TestWithParam<std::tuple<unsigned int, std::string>>
{};

// Patch test: the surface moves by the linear field G x (1 + t). Inertia is
// zero then, and the linear field solves the equations exactly: the nodes
// inside must follow, to round-off of the solvers, with linear and (G is
// symmetric: no rotation, constant strain) corotational elasticity.
TEST_P(DynamicsTest, PatchTest)
{
  const auto &[degree, mass] = GetParam();
  for (const std::string type : {"linear", "corotational"})
    {
      const std::string field =
        "0.1*x+0.02*y; 0.02*x-0.05*y+0.03*z; 0.03*y+0.07*z";
      MovingBody body(
        box("1, 1, 1", "2, 2, 2", 0.2),
        element_text(degree, mass) + exact_solvers + material_type(type) +
          displacements(on_all_sides("(0.1*x+0.02*y)*(1+t); "
                                     "(0.02*x-0.05*y+0.03*z)*(1+t); "
                                     "(0.03*y+0.07*z)*(1+t)")) +
          initial_conditions(field, field) +
          section("Time integration", {{"Time step", 0.1}}));
      GeneralizedAlpha integrator;
      run(body, integrator, 1., 10);
      double error = 0;
      for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
        {
          const auto         x = body.discretization.node_position(n);
          const Tensor<1, 3> exact(
            {2 * (0.1 * x[0] + 0.02 * x[1]),
             2 * (0.02 * x[0] - 0.05 * x[1] + 0.03 * x[2]),
             2 * (0.03 * x[1] + 0.07 * x[2])});
          for (unsigned int a = 0; a < 3; ++a)
            error = std::max(error,
                             std::abs(body.state.u.local_element(3 * n + a) -
                                      exact[a]));
        }
      error = dealii::Utilities::MPI::max(error, MPI_COMM_WORLD);
      report("error of the patch test, " + type, error);
      EXPECT_LE(error, 1e-12);
    }
}

// A free body under gravity falls by g t^2 / 2 and does not deform: both
// second-order integrators are exact for a constant acceleration.
TEST_P(DynamicsTest, FreeFall)
{
  const auto &[degree, mass] = GetParam();
  Newmark          newmark;
  GeneralizedAlpha generalized_alpha;
  for (TimeIntegrator *integrator :
       std::initializer_list<TimeIntegrator *>{&newmark, &generalized_alpha})
    {
      MovingBody       body(box("1, 1, 1", "2, 2, 2", 0.2),
                      element_text(degree, mass) + gravity("1; 0; -10"));
      const StepRecord record = run(body, *integrator, 2., 20);
      const Vector     exact  = body.interpolate(
        [](const Point<3> &) { return Tensor<1, 3>({2., 0., -20.}); });
      EXPECT_LE(largest_difference(body.state.u, exact), 1e-10);
      // The work of gravity equals the kinetic energy; the momentum is m g t.
      EXPECT_NEAR(record.kinetic_energy, 1000 * 0.5 * 4 * 101, 1e-4);
      EXPECT_NEAR(record.energy_balance, 0, 1e-10 * record.kinetic_energy);
      EXPECT_NEAR(record.momentum[2], -1000 * 20, 1e-6);
    }
}

// The trapezoidal rule keeps the energy of linear elasticity, here of a clamped
// body in free vibration, over 1,000 steps.
TEST_P(DynamicsTest, TrapezoidalRuleKeepsEnergy)
{
  if (!on_one_rank())
    GTEST_SKIP();
  const auto &[degree, mass] = GetParam();
  MovingBody body(box("2, 1, 1", "2, 1, 1", 0.),
                  element_text(degree, mass) + exact_solvers +
                    material_type("linear") + fixed("x-min"));
  vibrate(body);
  Newmark          newmark;
  const StepRecord record = run(body, newmark, 10., 1000);
  const double     total  = record.kinetic_energy + record.elastic_energy;
  EXPECT_GT(record.elastic_energy, 0.01 * total);
  report("relative change of energy", record.energy_balance / total);
  EXPECT_LE(std::abs(record.energy_balance), 1e-10 * total);
  EXPECT_EQ(record.external_work, 0.);
}

INSTANTIATE_TEST_SUITE_P(DegreesAndMasses,
                         DynamicsTest,
                         testing::Combine(testing::Values(1u, 2u, 3u),
                                          testing::Values("consistent",
                                                          "diagonal scaling")));
INSTANTIATE_TEST_SUITE_P(Bubbles,
                         DynamicsTest,
                         testing::Values(std::make_tuple(2u,
                                                         "nodal quadrature")));

namespace
{
  // The order of a corotational beam's tip motion, from runs with n, 2n and 4n
  // steps.
  double
  beam_order(TimeIntegrator &integrator, const unsigned int n)
  {
    double tip[3];
    for (const unsigned int i : {0, 1, 2})
      {
        MovingBody body(box("2, 1, 1", "2, 1, 1", 0.),
                        element_text(1, "consistent") + exact_solvers +
                          material_text(2e4) + fixed("x-min"));
        vibrate(body);
        run(body, integrator, 0.4, n << i);
        tip[i] = 0;
        for (unsigned int k = 0; k < body.state.u.locally_owned_size(); ++k)
          tip[i] += (1 + k % 3) * body.state.u.local_element(k);
        tip[i] = dealii::Utilities::MPI::sum(tip[i], MPI_COMM_WORLD);
      }
    const double order = std::log2((tip[0] - tip[1]) / (tip[1] - tip[2]));
    report("order in time", order);
    return order;
  }
} // namespace

TEST(Dynamics, TemporalOrders)
{
  if (!on_one_rank())
    GTEST_SKIP();
  BackwardEuler    backward_euler;
  Newmark          newmark;
  GeneralizedAlpha generalized_alpha;
  EXPECT_NEAR(beam_order(backward_euler, 400), 1, 0.1);
  EXPECT_NEAR(beam_order(newmark, 100), 2, 0.1);
  EXPECT_NEAR(beam_order(generalized_alpha, 100), 2, 0.1);
}

// Moving supports cause the correct inertia forces: all supports accelerate by
// the same law, d = t^3 / 6 along x, and a stiff body follows rigidly. The
// force of the supports is m t and their work the kinetic energy m (t^2/2)^2 /
// 2.
TEST(Dynamics, MovingSupports)
{
  for (const std::string mass : {"consistent", "diagonal scaling"})
    {
      MovingBody body(box("1, 1, 1", "2, 2, 2"),
                      element_text(2, mass) + material_text(1e9) +
                        displacements(
                          "x-min: t^3/6; 0; 0, x-max: t^3/6; 0; 0") +
                        section("Time integration", {{"Time step", 0.01}}));
      // This integrator damps the body's own vibrations, whose periods are
      // below the step.
      GeneralizedAlpha integrator;
      integrator.spectral_radius = 0;
      const StepRecord record    = run(body, integrator, 1., 100);
      // Errors of second order, dt^2 = 1e-4 times a factor of O(1), in the
      // motion inside and in the work; the deformation of the body is some
      // 1e-6.
      EXPECT_NEAR(record.reaction[0], 1000, 1e-4 * 1000);
      EXPECT_NEAR(record.external_work, 125, 2e-4 * 125);
      EXPECT_NEAR(record.kinetic_energy, 125, 2e-4 * 125);
    }
}

// With both coefficients of damping the budget accounts for the lost energy.
TEST(Dynamics, RayleighDamping)
{
  MovingBody body(box("2, 1, 1", "2, 1, 1", 0.),
                  element_text(2, "consistent") + exact_solvers +
                    material_type("linear") + fixed("x-min") +
                    section("Damping",
                            {{"Mass coefficient", 0.5},
                             {"Stiffness coefficient", 1e-3}}));
  vibrate(body);
  Newmark          newmark;
  const StepRecord record = run(body, newmark, 1., 100);
  const double     total  = record.kinetic_energy + record.elastic_energy;
  EXPECT_GT(record.dissipated_energy, 0.1 * total);
  EXPECT_LE(std::abs(record.energy_balance), 1e-10 * total);
}

// Mass-proportional damping of a free body: v = v_0 exp(-alpha_M t).
TEST(Dynamics, MassDampingOfRigidMotion)
{
  if (!on_one_rank())
    GTEST_SKIP();
  MovingBody body(box("1, 1, 1", "1, 1, 1", 0.),
                  section("Damping", {{"Mass coefficient", 2}}) +
                    initial_conditions("0; 0; 0", "3; 0; 0"));
  Newmark    newmark;
  run(body, newmark, 1., 1000);
  for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
    // The relative error of second order is (2 dt)^2 / 12.
    EXPECT_NEAR(body.state.v.local_element(3 * n), 3 * std::exp(-2.), 1e-6);
}

// Steel under a load that starts gently: in the first step its forces are below
// the round-off of stresses. Newton's method must not insist on a residual that
// no displacement can have. The motion is that of linear elasticity
// (displacements of 1e-9), up to the round-off of strains, 1e-15 relative to
// some 1e-9.
TEST(Dynamics, GentleStartOfStiffBody)
{
  double tip[2];
  for (const unsigned int i : {0, 1})
    {
      MovingBody body(box("2, 1, 1", "2, 1, 1"),
                      element_text(2, "consistent") +
                        material_type(i == 0 ? "linear" : "corotational") +
                        material_text(2e11, 0.3, 7850) + fixed("x-min") +
                        tractions("x-max: 0; 0; 1e3*sin(10*t)^2"));
      Newmark    newmark;
      run(body, newmark, 0.1, 100);
      tip[i] = body.state.u.linfty_norm();
    }
  EXPECT_GT(tip[0], 1e-10);
  EXPECT_NEAR(tip[1], tip[0], 1e-5 * tip[0]);
}
