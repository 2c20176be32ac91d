// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Static linear elasticity compared with exact solutions: orders of convergence
// and reactions.

#include <corotet/simulation/energy_budget.h>
#include <corotet/time_integration/load_stepping.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/numerics/vector_tools.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../body.h"
#include "../wave.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  void
  solve_static(MovingBody &body, const double load_factor = 1)
  {
    LoadStepping load_stepping;
    load_stepping.step(body.system,
                       {load_factor - 1, 1., load_factor},
                       body.state);
  }

  struct Errors
  {
    double L2, H1;
  };

  // Errors on the unit cube with n^3 cuboids: displacement on three sides,
  // traction on the others.
  Errors
  wave_errors(const unsigned int degree, const unsigned int n)
  {
    const Wave wave;
    MovingBody body(box("1, 1, 1", fmt::format("{0}, {0}, {0}", n), 0.1),
                    wave.parameters(degree));
    solve_static(body);

    Vector u =
      body.interpolate([](const Point<3> &) { return Tensor<1, 3>(); });
    u.copy_locally_owned_data_from(body.state.u);
    u.update_ghost_values();
    const dealii::QWitherdenVincentSimplex<3> rule(degree + 2 > 5 ? 5 :
                                                                    degree + 2);
    const auto error = [&](const dealii::VectorTools::NormType norm) {
      dealii::Vector<float> by_cell(body.mesh.triangulation().n_active_cells());
      dealii::VectorTools::integrate_difference(
        body.discretization.mapping(),
        body.discretization.dof_handler(),
        u,
        wave,
        by_cell,
        rule,
        norm);
      return dealii::VectorTools::compute_global_error(
        body.mesh.triangulation(), by_cell, norm);
    };
    return {error(dealii::VectorTools::L2_norm),
            error(dealii::VectorTools::H1_seminorm)};
  }
} // namespace

// In theory the order is p + 1 in L2 and p in H1; measured between the two
// finest meshes that keep the test fast.
TEST(Statics, OrdersOfConvergence)
{
  for (unsigned int degree = 1; degree <= 3; ++degree)
    {
      const unsigned int n      = degree == 1 ? 8 : 4;
      const Errors       first  = wave_errors(degree, n);
      const Errors       second = wave_errors(degree, 2 * n);
      const double       L2     = std::log2(first.L2 / second.L2);
      const double       H1     = std::log2(first.H1 / second.H1);
      report(fmt::format("degree {}, order in L2", degree), L2);
      report(fmt::format("degree {}, order in H1", degree), H1);
      EXPECT_GE(L2, degree + 0.9) << degree;
      EXPECT_GE(H1, degree - 0.05) << degree;
    }
}

// In statics the supports carry the loads. A point force, and a traction with
// the same resultant (area 1), have the same reaction.
TEST(Statics, Reactions)
{
  for (const std::string &load :
       {section("Loads", {{"Point forces", "2 0.5 0.5: 1; 2; -3"}}),
        tractions("x-max: 1; 2; -3")})
    for (const std::string type : {"linear", "corotational"})
      {
        MovingBody body(box("2, 1, 1", "4, 2, 2", 0.1),
                        fixed("x-min") + material_type(type) +
                          material_text(200) +
                          section("Newton", {{"Residual tolerance", 1e-12}}) +
                          linear_solver("direct", 1e-12) + load);
        body.system.equation().evaluate(body.state, 0., 0.);
        EnergyBudget budget(body.system.equation(), body.state, 0.);
        solve_static(body);
        StepRecord record;
        budget.account(body.state, 1., 1.);
        budget.record(record, body.state, 1.);
        // Equilibrium holds to Newton's tolerance.
        EXPECT_LE((record.reaction + Tensor<1, 3>({1., 2., -3.})).norm(), 1e-10)
          << record.reaction;
        // By Clapeyron's theorem half the work of the final load is stored: the
        // mean force of a proportional step is half of the final one. This is
        // exact for linear elasticity.
        if (type == "linear")
          {
            EXPECT_NEAR(record.energy_balance,
                        0,
                        1e-10 * record.elastic_energy);
          }
        EXPECT_GT(record.elastic_energy, 0.);
      }
}

// A stretch in one step: nu = 0, so sigma = E eps, the supports pull with E eps
// A, and the volume grows by the stretch.
TEST(Statics, PrescribedStretch)
{
  MovingBody body(box("2, 1, 1", "4, 2, 2", 0.1),
                  material_text(1000, 0) +
                    displacements("x-min: 0; 0; 0, x-max: 0.2; free; free"));
  body.system.equation().evaluate(body.state, 0., 0.);
  EnergyBudget budget(body.system.equation(), body.state, 0.);
  solve_static(body);
  StepRecord record;
  budget.account(body.state, 1., 1.);
  budget.record(record, body.state, 1.);
  EXPECT_NEAR(record.elastic_energy, 0.5 * 1000 * 0.1 * 0.1 * 2, 1e-7);
  EXPECT_NEAR(record.external_work, record.elastic_energy, 1e-7);
  EXPECT_NEAR(record.volume, 2.2, 1e-7);
  EXPECT_NEAR(record.max_displacement, 0.2, 1e-9);
  EXPECT_NEAR(record.min_det_F, 1.1, 1e-7);
  EXPECT_LE(record.reaction.norm(), 1e-6);
}

// A step whose record is taken back leaves the forces of supports of the one
// before.
TEST(Statics, ForcesOfSupportsAreTakenBack)
{
  MovingBody body(box("2, 1, 1", "4, 2, 2", 0.1),
                  fixed("x-min") + tractions("x-max: 1; 2; -3"));
  body.system.equation().evaluate(body.state, 0., 0.);
  EnergyBudget budget(body.system.equation(), body.state, 0.);
  StepRecord   record;
  const auto   recorded_forces = [&](const double time) {
    solve_static(body, time);
    budget.add_work(body.state, time, 1.);
    budget.record(record, body.state, time);
    return budget.support_forces();
  };
  const auto first = recorded_forces(1.);
  budget.end_step(body.state);
  const auto second = recorded_forces(2.);
  budget.take_back();
  ASSERT_EQ(budget.support_forces().size(), first.size());
  double largest = 0;
  for (std::size_t k = 0; k < first.size(); ++k)
    {
      EXPECT_EQ(budget.support_forces()[k].force, first[k].force);
      largest = std::max(largest, std::abs(second[k].force - first[k].force));
    }
  EXPECT_GT(dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD), 0.01);
}

// A guess of the first state is not a state of the body: a linear body stores
// the work of the load, to round-off, as without a guess.
TEST(Statics, AGuessDoesNoWork)
{
  for (const unsigned int n : {1u, 3u})
    {
      const std::string text = box_mesh("1, 1, 1", "2, 2, 2") +
                               material_text(1e3) + material_type("linear") +
                               fixed("x-min") + tractions("x-max: 100; 20; 0") +
                               statics(n);
      CompleteRun without(text);
      ASSERT_EQ(without.run(), "");
      CompleteRun with(text + section("Initial conditions",
                                      {{"Displacement", "0.05*x; 0; -0.1*x"}}));
      ASSERT_EQ(with.run(), "");
      const StepRecord &a = without.recorder().steps.back(),
                       &b = with.recorder().steps.back();
      EXPECT_NEAR(b.external_work, a.external_work, 1e-7 * a.external_work);
      EXPECT_NEAR(b.energy_balance, 0, 1e-7 * a.external_work);
      // The record of the guess itself contains no work either, so its balance
      // is its elastic energy.
      const StepRecord &first = with.recorder().records.front();
      EXPECT_GT(first.elastic_energy, 0.1);
      EXPECT_EQ(first.energy_balance, first.elastic_energy);
    }
}

// Forces that depend on the displacement do no work at the guess either:
// springs whose stiffness changes, and a pressure that acts from the start.
TEST(Statics, ForcesAtAGuessDoNoWork)
{
  const std::string body = box_mesh("1, 1, 1", "2, 2, 2") + material_text(1e3) +
                           fixed("x-min") + tractions("x-max: 100; 20; 0") +
                           statics(3),
                    guess = initial_conditions("0.05*x; 0; -0.1*x", "0; 0; 0");
  const auto runs_agree   = [&](const std::string &text, const bool is_linear) {
    CompleteRun without(text), with(text + guess);
    ASSERT_EQ(without.run(), "");
    ASSERT_EQ(with.run(), "");
    const StepRecord &a = without.recorder().steps.back(),
                     &b = with.recorder().steps.back();
    EXPECT_NEAR(b.external_work, a.external_work, 1e-7 * a.external_work);
    // Linear bodies store the work of forces, to the solver's tolerance.
    if (is_linear)
      {
        EXPECT_NEAR(b.energy_balance, 0, 1e-7 * a.external_work);
      }
  };
  runs_agree(body + material_type("linear") +
               supports("x-max: 1e3*(1 + t); 1e3; 1e3"),
             true);
  runs_agree(body + material_type("neo-Hookean") + pressures("y-max: 30") +
               section("Time integration",
                       {section("static", {{"Proportional loading", false}})}),
             false);
}
