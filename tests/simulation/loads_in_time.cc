// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Loads and supports that follow tables move a body as the same functions do
// that are given as formulas.

#include <corotet/simulation/simulation.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../body.h"
#include "../temporary_folder.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // What a run ends with.
  class End : public Observer
  {
  public:
    void
    start(const Snapshot &) override
    {}

    void
    step(const Snapshot &state) override
    {
      record       = state.record;
      displacement = state.displacement;
      velocity     = state.velocity;
    }

    void
    finish(const RunSummary &) override
    {}

    StepRecord record;
    Vector     displacement;
    Vector     velocity;
  };

  End
  run(const std::string &folder, const std::string &settings)
  {
    Parameters parameters(R"(
      subsection Mesh
        subsection box
          set Size  = 1, 0.2, 0.2
          set Cells = 4, 1, 1
        end
      end
      subsection Time integration
        set End time  = 0.2
        set Time step = 0.005
      end
      subsection Newton
        set Residual tolerance  = 1e-11
        set Increment tolerance = 1e-11
      end
      subsection Linear solver
        set Type      = direct
        set Tolerance = 1e-12
      end)" + settings);
    Log        log(MPI_COMM_WORLD, true);
    Simulation simulation(parameters, folder, MPI_COMM_WORLD, log);

    std::vector<std::unique_ptr<Observer>> observers;
    observers.push_back(std::make_unique<End>());
    simulation.run(observers);
    return static_cast<End &>(*observers.front());
  }
} // namespace

// A beam shaken at its foot by 0.2 (t + 0.5)^2: a cubic table reproduces this
// monotone quadratic up to round-off of 1e-17, so accelerations, which are
// taken by differences of step h = 5e-4, up to e = 64 / 12 * 1e-17 / h^2 =
// 2e-10. That makes at most e t of velocity and e t^2 / 2 of displacement until
// t = 0.2, and e m of the reaction, with the body's 40 kg.
TEST(LoadsInTime, MovingSupportByTableOrFormula)
{
  const TemporaryFolder folder;
  std::string           rows = "t, u\n";
  for (const double t : {-0.05, -0.01, 0.01, 0.04, 0.05, 0.1, 0.12, 0.18, 0.25})
    rows += fmt::format("{}, {}\n", t, (t + 0.5) * (t + 0.5));
  folder.write("foot.csv", rows);

  const std::string initial = R"(
    subsection Initial conditions
      set Displacement = 0; 0.05; 0
      set Velocity     = 0; 0.2; 0
    end
    subsection Boundary conditions
      set Displacement = x-min: 0; 0.2 * )";
  const End         by_table =
    run(folder / "",
        "\nsubsection Tables\n set Cubic = foot: foot.csv\nend" + initial +
          "foot(t); 0\nend\n");
  const End    by_formula = run("", initial + "(t + 0.5)^2; 0\nend\n");
  const double error      = 2e-10;
  // Far from rigid motion: the tip lags behind.
  const double rigid_energy = 0.5 * 40 * 0.28 * 0.28;
  report("kinetic energy over that of rigid motion",
         by_formula.record.kinetic_energy / rigid_energy);
  EXPECT_LT(by_formula.record.kinetic_energy, 0.9 * rigid_energy);
  report("difference of displacements",
         largest_difference(by_table.displacement, by_formula.displacement));
  EXPECT_LE(largest_difference(by_table.displacement, by_formula.displacement),
            error * 0.02);
  EXPECT_LE(largest_difference(by_table.velocity, by_formula.velocity),
            error * 0.2);
  EXPECT_NEAR(by_table.record.reaction[1],
              by_formula.record.reaction[1],
              error * 40);
}

// A load by straight lines between rows is a triangle: values agree to
// round-off, the runs to the tolerance of Newton's method.
TEST(LoadsInTime, LoadsByTableOrFormula)
{
  const TemporaryFolder folder;
  folder.write("hit.csv", "0 0\n0.05 1\n0.1 0\n");
  for (const std::string load :
       {"Boundary conditions\n set Fixed = x-min\n set Traction = x-max: 0; 0; "
        "500 * ",
        "Boundary conditions\n set Fixed = x-min\nend\nsubsection Loads\n set "
        "Body force = 0; 0; x * 1000 * ",
        "Boundary conditions\n set Fixed = x-min\nend\nsubsection Loads\n set "
        "Gravity = 0; 0; 10 * ",
        "Boundary conditions\n set Fixed = x-min\nend\nsubsection Loads\n set "
        "Point forces = 1 0.2 0.2: 0; 0; 20 * "})
    {
      const End by_table = run(
        folder / "",
        "\nsubsection Tables\n set Linear = hit: hit.csv\nend\nsubsection " +
          load + "hit(t)\nend\n");
      const End by_formula =
        run("", "\nsubsection " + load + "triangle(t, 0, 0.1)\nend\n");
      EXPECT_GT(by_formula.record.max_displacement, 1e-4);
      EXPECT_LE(largest_difference(by_table.displacement,
                                   by_formula.displacement),
                1e-9 * by_formula.record.max_displacement)
        << load;
    }
}
