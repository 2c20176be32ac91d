// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A free body that spins and vibrates: laws with an energy conserve energy and
// momenta, while one rotation per cell does not.

#include <corotet/simulation/energy_budget.h>
#include <corotet/time_integration/generalized_alpha.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../all_laws.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  // The largest changes from the start to any step: of the momenta, relative to
  // the momenta at the start, and of the energy, relative to the elastic energy
  // at the start.
  struct Drift
  {
    double momentum = 0, angular_momentum = 0, energy = 0;
  };

  // Simulates a bar of 2 x 1 x 1 that is stretched, bent and rotates by some 2
  // radians.
  Drift
  fly(const unsigned int degree,
      const NamedLaw    &law,
      const unsigned int n_steps)
  {
    MovingBody body(box("2, 1, 1", "2, 1, 1"),
                    element_text(degree) + law.text + material_text(2e4) +
                      section("Newton", {{"Tangent", "consistent"}}) +
                      newton_tolerances(1e-13) +
                      linear_solver("direct", 1e-10));
    const auto deformation = [](const Point<3> &x) {
      return Tensor<1, 3>(
        {0.1 * (x[0] - 1), 0.05 * x[1] * x[2], 0.1 * x[0] * x[0]});
    };
    body.state.u.copy_locally_owned_data_from(body.interpolate(deformation));
    body.state.v.copy_locally_owned_data_from(
      body.interpolate([&](const Point<3> &x) {
        return Tensor<1, 3>({1., 2., 3.}) +
               cross_product_3d(Tensor<1, 3>({0.5, 1.5, 1.}),
                                Tensor<1, 3>(x) + deformation(x));
      }));
    GeneralizedAlpha integrator;
    integrator.spectral_radius = 1;
    const double end           = 1;
    body.system.solve_acceleration(body.state, 0.);
    EnergyBudget     budget(body.system.equation(), body.state, 0.);
    const StepRecord start  = budget.initial_record();
    StepRecord       record = start;
    Drift            drift;
    for (unsigned int i = 0; i < n_steps; ++i)
      {
        integrator.step(body.system,
                        {i * end / n_steps, end / n_steps, (i + 1.) / n_steps},
                        body.state);
        budget.account(body.state, (i + 1) * end / n_steps, end / n_steps);
        budget.record(record, body.state, (i + 1) * end / n_steps);
        drift.momentum = std::max(drift.momentum,
                                  (record.momentum - start.momentum).norm() /
                                    start.momentum.norm());
        drift.angular_momentum =
          std::max(drift.angular_momentum,
                   (record.angular_momentum - start.angular_momentum).norm() /
                     start.angular_momentum.norm());
        drift.energy =
          std::max(drift.energy,
                   std::abs(record.energy_balance) / start.elastic_energy);
      }
    return drift;
  }
} // namespace

class FreeMotion : public testing::TestWithParam<unsigned int>
{};

// With the spectral radius 1 this is the midpoint rule. It conserves both
// momenta if forces have no resultant and no moment, to the tolerance of the
// solvers, and the energy to its order.
TEST_P(FreeMotion, Conservation)
{
  if (!on_one_rank())
    GTEST_SKIP();
  const unsigned int degree    = GetParam();
  double             conserved = 0;
  NamedLaw           cell_centre;
  for (const NamedLaw &law : nonlinear_laws())
    {
      if (!law.law->has_energy(2))
        {
          cell_centre = law;
          continue;
        }
      // The faster a law stiffens, the shorter must steps be to show the order.
      const unsigned int n = law.name.starts_with("corotational") ? 100 : 800;
      const Drift        coarse = fly(degree, law, n / 2);
      const Drift        fine   = fly(degree, law, n);
      const std::string  what   = fmt::format(", P{}, {}", degree, law.name);
      report("drift of momentum" + what, fine.momentum);
      report("drift of angular momentum" + what, fine.angular_momentum);
      report("error of energy" + what, fine.energy);
      report("order of energy" + what, std::log2(coarse.energy / fine.energy));
      EXPECT_LE(fine.momentum, 1e-12);
      EXPECT_LE(coarse.angular_momentum, 1e-10);
      EXPECT_LE(fine.angular_momentum, 1e-10);
      EXPECT_NEAR(std::log2(coarse.energy / fine.energy), 2, 0.2);
      EXPECT_LE(fine.energy, 0.02);
      conserved = std::max(conserved, fine.angular_momentum);
    }
  const Drift by_cell = fly(degree, cell_centre, 100);
  report(fmt::format("drift of momentum, P{}, cell centre", degree),
         by_cell.momentum);
  report(fmt::format("drift of angular momentum, P{}, cell centre", degree),
         by_cell.angular_momentum);
  EXPECT_LE(by_cell.momentum, 1e-12);
  EXPECT_GE(by_cell.angular_momentum, 100 * conserved);
  EXPECT_GE(by_cell.angular_momentum, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Degrees, FreeMotion, testing::Values(2u, 3u));
