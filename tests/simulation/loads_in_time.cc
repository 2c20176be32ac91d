// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Loads and supports given by tables move a body in the same way as the same
// functions given by formulas.

#include <corotet/simulation/simulation.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../body.h"
#include "../temporary_folder.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // Keeps the final state of a run.
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
    Parameters parameters(
      box_mesh("1, 0.2, 0.2", "4, 1, 1") +
      section("Time integration", {{"End time", 0.2}, {"Time step", 0.005}}) +
      newton_tolerances(1e-11) + linear_solver("direct", 1e-12) + settings);
    Log        log(MPI_COMM_WORLD, true);
    Simulation simulation(parameters, folder, MPI_COMM_WORLD, log);

    std::vector<std::unique_ptr<Observer>> observers;
    observers.push_back(std::make_unique<End>());
    simulation.run(observers);
    return static_cast<End &>(*observers.front());
  }
} // namespace

// A beam whose foot is moved by 0.2 (t + 0.5)^2: a cubic table reproduces this
// monotone quadratic up to a round-off of 1e-17, so accelerations, computed
// from differences of step h = 5e-4, up to e = 64 / 12 * 1e-17 / h^2 = 2e-10.
// Until t = 0.2 that causes errors of at most e t in velocity and e t^2 / 2 in
// displacement, and e m in the reaction, with the body's 40 kg.
TEST(LoadsInTime, MovingSupportByTableOrFormula)
{
  const TemporaryFolder folder;
  std::string           rows = "t, u\n";
  for (const double t : {-0.05, -0.01, 0.01, 0.04, 0.05, 0.1, 0.12, 0.18, 0.25})
    rows += fmt::format("{}, {}\n", t, (t + 0.5) * (t + 0.5));
  folder.write("foot.csv", rows);

  const auto carried = [](const std::string &u) {
    return initial_conditions("0; 0.05; 0", "0; 0.2; 0") +
           displacements("x-min: 0; 0.2 * " + u + "; 0");
  };
  const End by_table =
    run(folder / "",
        section("Tables", {{"Cubic", "foot: foot.csv"}}) + carried("foot(t)"));
  const End    by_formula = run("", carried("(t + 0.5)^2"));
  const double error      = 2e-10;
  // The motion is far from rigid: the tip lags behind.
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

// A load with straight lines between rows is a triangle function: values agree
// to round-off, the runs to the tolerance of Newton's method.
TEST(LoadsInTime, LoadsByTableOrFormula)
{
  const TemporaryFolder folder;
  folder.write("hit.csv", "0 0\n0.05 1\n0.1 0\n");
  struct Load
  {
    std::string section, entry, value;
  };
  for (const Load &load :
       {Load{"Boundary conditions", "Traction", "x-max: 0; 0; 500 * "},
        Load{"Loads", "Body force", "0; 0; x * 1000 * "},
        Load{"Loads", "Gravity", "0; 0; 10 * "},
        Load{"Loads", "Surface forces", "x-max: 0; 0; 20 * "},
        Load{"Loads", "Point forces", "1 0.2 0.2: 0; 0; 20 * "}})
    {
      const auto loaded = [&](const std::string &function) {
        return fixed("x-min") +
               section(load.section, {{load.entry, load.value + function}});
      };
      const End by_table =
        run(folder / "",
            section("Tables", {{"Linear", "hit: hit.csv"}}) + loaded("hit(t)"));
      const End by_formula = run("", loaded("triangle(t, 0, 0.1)"));
      EXPECT_GT(by_formula.record.max_displacement, 1e-4);
      EXPECT_LE(largest_difference(by_table.displacement,
                                   by_formula.displacement),
                1e-9 * by_formula.record.max_displacement)
        << load.entry;
    }
}

// Gravity of 1 m/s^2 from 0.1 to 0.3 s gives a free body 0.2 m/s: the step that
// ends at 0.1 s uses it, and the one that ends at 0.3 s does not, whatever the
// round-off in times of steps that start and end time cause.
TEST(LoadsInTime, JumpsAreMetAtAnyEndTime)
{
  const std::string body = box_mesh("1, 0.5, 0.5", "1, 1, 1") +
                           section("Discretization", {{"Degree", 1}});
  for (const std::string type : {"Newmark", "BDF2", "backward Euler"})
    for (const auto &[start, end] : {std::pair(0., 0.6),
                                     std::pair(0., 0.7),
                                     std::pair(0., 0.9),
                                     std::pair(0., 1.),
                                     std::pair(0.7, 1.4),
                                     std::pair(-0.4, 0.3)})
      for (const std::string pulse : {"pulse(t, {0}, {1})",
                                      "if(t >= {0} && t < {1}, 1, 0)",
                                      "ramp(t, {0}, {0}) - ramp(t, {1}, {1})"})
        {
          const std::string load =
            fmt::format(fmt::runtime(pulse),
                        fmt::format("{:.2g}", start + 0.1),
                        fmt::format("{:.2g}", start + 0.3));
          Parameters parameters(body + gravity(load + "; 0; 0") +
                                section("Time integration",
                                        {{"Type", type},
                                         {"Start time", start},
                                         {"End time", end},
                                         {"Time step", 0.01}}));
          Log        log(MPI_COMM_WORLD, true);
          Simulation simulation(parameters, "", MPI_COMM_WORLD, log);
          std::vector<std::unique_ptr<Observer>> observers;
          observers.push_back(std::make_unique<End>());
          simulation.run(observers);
          const double mass = simulation.body().mass.total();
          const auto  &record =
            static_cast<const End &>(*observers.front()).record;
          // The error is what Newton's tolerance of 1e-10 leaves in each of
          // twenty steps, and round-off.
          EXPECT_NEAR(record.momentum[0] / mass, 0.2, 1e-10)
            << type << ' ' << start << ' ' << end << ' ' << load;
        }
}
