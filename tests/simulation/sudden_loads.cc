// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Loads that begin suddenly, in steps in which waves cross several cells.
// Accelerations at the start are those of the loaded nodes only: a guess with
// them moves these nodes far beyond their neighbours, and inverts cells.

#include <gtest/gtest.h>

#include "../all_laws.h"
#include "../integrators.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // The methods to test. Wilson's method, which another test adds,
  // overestimates such loads itself: it extrapolates the acceleration beyond
  // the step.
  std::vector<std::string>
  methods_for_sudden_loads()
  {
    std::vector<std::string> names = integrators_with(is_implicit_dynamic);
    std::erase(names, "Wilson theta");
    return names;
  }
} // namespace

class SuddenLoads : public testing::TestWithParam<std::string>
{};

INSTANTIATE_TEST_SUITE_P(Integrators,
                         SuddenLoads,
                         testing::ValuesIn(methods_for_sudden_loads()),
                         [](const auto &info) {
                           return letters_and_digits(info.param);
                         });

// A pressure of a twentieth of Young's modulus on one side of a cube, which
// waves cross in 0.027 s: the cube is compressed by some 5 % back and forth,
// never by 15 %, in as few iterations as in other steps. From a guess with the
// accelerations no step of Newmark's method converged, or only to inverted
// cells.
TEST_P(SuddenLoads, CompressABlock)
{
  for (const std::string law : {"corotational", "neo-Hookean"})
    for (const double step : {0.02, 0.1})
      {
        // Later long steps of Newmark's method, which does not damp waves that
        // it cannot resolve, depend on round-off.
        const unsigned int n_steps = step < 0.05 ? 5 : 1;
        CompleteRun run(box_mesh("1, 1, 1", "4, 4, 4") + element_text(2) +
                        material_text(1e6, 0.3, 1000) + material_type(law) +
                        fixed("x-min") + pressures("x-max: 5e4") +
                        time_integration(GetParam(), n_steps * step, step));
        ASSERT_EQ(run.run(), "") << law << step;
        EXPECT_EQ(run.recorder().steps.size(), n_steps);
        EXPECT_LE(run.recorder().steps.front().newton_iterations, 6u);
        for (const StepRecord &record : run.recorder().steps)
          {
            EXPECT_LE(record.newton_iterations, 6u) << law << step;
            EXPECT_GT(record.min_det_F, 0.7) << law << step;
          }
        EXPECT_GT(run.recorder().steps.front().max_displacement, 0.02);
        EXPECT_LT(run.recorder().steps.back().max_displacement, 0.15);
      }
}

// A cube is released from a state whose waves cross several cells in a step.
// Its energy stays constant or decreases, up to some percent; from a guess with
// the accelerations Newmark's method multiplied it by forty.
TEST_P(SuddenLoads, LetGoFromWaves)
{
  for (const std::string law : {"corotational", "neo-Hookean"})
    {
      CompleteRun run(
        box_mesh("1, 1, 1", "4, 4, 4") + element_text(2) +
        material_text(1e6, 0.3, 1000) + material_type(law) + fixed("x-min") +
        initial_conditions("0.02 * sin(6 * x) * cos(5 * y); "
                           "0.02 * x * sin(7 * z); 0.02 * x * cos(6 * y)",
                           "0; 0; 0") +
        time_integration(GetParam(), 0.25, 0.05));
      ASSERT_EQ(run.run(), "") << law;
      const double initial = run.recorder().records.front().elastic_energy;
      EXPECT_EQ(run.recorder().steps.size(), 5u);
      for (const StepRecord &record : run.recorder().steps)
        {
          EXPECT_LE(record.newton_iterations, 6u) << law;
          EXPECT_EQ(record.parts, 1u) << law;
          EXPECT_LE(record.energy_balance, 0.05 * initial) << law;
        }
    }
}
