// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Loads that begin to act in steps that waves cross several cells in. The
// accelerations at the start are those of the nodes that the loads act on: a
// displacement with these is far beyond what neighbours allow, and inverts
// cells.

#include <gtest/gtest.h>

#include "../all_laws.h"
#include "../integrators.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // Wilson's method, that of another test, makes too much of such loads by
  // itself: it extrapolates the acceleration to beyond the step.
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

// A pressure of a twentieth of Young's modulus on one side of a cube, whose
// waves need 0.027 s from side to side: it is compressed by some 5 % to and
// fro, never by 15, in as few iterations as other steps take. From the guess
// with the accelerations no step of Newmark's method converged, or to inverted
// cells.
TEST_P(SuddenLoads, CompressABlock)
{
  for (const std::string law : {"corotational", "neo-Hookean"})
    for (const double step : {0.02, 0.1})
      {
        // Later long steps of Newmark's method, which keeps waves that it does
        // not resolve, depend on round-off.
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

// A cube that is let go from a state whose waves cross several cells in a step.
// Its energy stays or is damped, but for some percent; from the guess with the
// accelerations Newmark's method made forty times as much of it.
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
