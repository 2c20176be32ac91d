// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Supports that move: their reactions compared with Newton's second law, and
// with those of a run that lasts longer.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../integrators.h"
#include "../temporary_folder.h"
#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // Ends a run after some steps.
  class Stop : public Observer
  {
  public:
    explicit Stop(const unsigned int n_steps)
      : n_steps(n_steps)
    {}

    void
    start(const Snapshot &) override
    {}

    void
    step(const Snapshot &state) override
    {
      if (state.record.step == n_steps)
        throw ComputationError("enough");
    }

    void
    finish(const RunSummary &) override
    {}

  private:
    unsigned int n_steps;
  };

  // The first records of a run.
  std::vector<StepRecord>
  records(const std::string &text, const unsigned int n_steps)
  {
    CompleteRun run(text);
    run.observers.push_back(std::make_unique<Stop>(n_steps));
    run.run();
    EXPECT_GE(run.recorder().records.size(), n_steps + 1);
    return run.recorder().records;
  }

  std::string
  bar(const std::string &displacement, const unsigned int n_cells = 2)
  {
    return box_mesh("2, 1, 1", fmt::format("{}, 1, 1", n_cells)) +
           element_text(1, "diagonal scaling") + material_text(10, 0.3, 3) +
           displacements(displacement) + linear_solver("automatic", 1e-12);
  }

  // A bar all of whose nodes are on sides that move by u.
  std::string
  carried_bar(const std::string &u)
  {
    return bar(fmt::format("x-min: {0}; 0; 0, x-max: {0}; 0; 0", u), 1);
  }
} // namespace

// A body whose nodes are all prescribed has the reaction m a, m = 6 kg, at each
// time, for any duration of the run and any method that balances forces at the
// end of a step: a is the exact second derivative, up to round-off.
TEST(MovingSupports, ReactionIsMassTimesAcceleration)
{
  const TemporaryFolder folder;
  // At rows where values turn the slope is zero: in between, the cubic is 3 s^2
  // - 2 s^3. Kinks are at times of steps up to round-off.
  const std::string file =
    folder.write("table.csv", "-1 0\n0 0\n0.5 1\n1 0\n2 0\n");
  const std::string tables =
    section("Tables",
            {{"Cubic", "smooth: " + file}, {"Linear", "kinked: " + file}});
  const auto cubic = [](const double t) {
    const double s = t < 0.5 ? 2 * t : 2 * (1 - t);
    return t > 1 - 1e-12 ? 0. : 4 * (6 - 12 * s);
  };
  const std::vector<std::pair<std::string, std::function<double(const double)>>>
    motions = {{"0.1*sin(40*t)",
                [](const double t) { return -160 * std::sin(40 * t); }},
               {"(1 + t)*exp(-t)*t^2",
                [](const double t) {
                  return std::exp(-t) * (2 + 2 * t - 5 * t * t + t * t * t);
                }},
               {"smooth(t)", cubic},
               {"kinked(t)", [](const double) { return 0.; }},
               {"triangle(t, 0, 1) + ramp(t, 0.25, 0.5)",
                [](const double) { return 0.; }},
               {"abs(t - 0.5)*sin(4*t)", [](const double t) {
                  const double a =
                    8 * std::cos(4 * t) - 16 * (t - 0.5) * std::sin(4 * t);
                  return t < 0.5 - 1e-12 ? -a : a;
                }}};
  for (const std::string &type :
       integrators_with([](const TimeIntegrator &integrator) {
         return integrator.balances_at_end();
       }))
    for (const double end : {1.5, 15000.})
      for (const auto &[u, acceleration] : motions)
        for (const StepRecord &record :
             records(tables + carried_bar(u) +
                       time_integration(type, end, 0.0625),
                     20))
          EXPECT_NEAR(record.reaction[0], 6 * acceleration(record.time), 1e-10)
            << u << " at " << record.time << ", " << type;
}

// The same steps of a longer run have the same history, to the last bit: the
// times of both are exact in binary.
TEST(MovingSupports, DurationDoesNotMatter)
{
  for (const std::string &type : integrators_with(is_dynamic))
    for (const std::string u : {"1e-2*sin(300*t)",
                                "1e-2*abs(sin(20*t))*ramp(t, 0, 0.0625)",
                                "1e-3*asin(sin(32*pi*t))"})
      {
        const auto first = [&](const double end) {
          return records(bar("x-min: " + u + "; 0; 0") +
                           time_integration(type, end, 0.015625),
                         8);
        };
        const auto a = first(0.125), b = first(16), c = first(8192);
        for (unsigned int i = 0; i <= 8; ++i)
          for (const auto &other : {b, c})
            {
              EXPECT_EQ(a[i].time, other[i].time);
              EXPECT_EQ(a[i].reaction, other[i].reaction)
                << type << ", " << u << ", step " << i;
              EXPECT_EQ(a[i].kinetic_energy, other[i].kinetic_energy);
              EXPECT_EQ(a[i].elastic_energy, other[i].elastic_energy);
              EXPECT_EQ(a[i].external_work, other[i].external_work);
              EXPECT_EQ(a[i].momentum, other[i].momentum);
            }
      }
}

// A support vibrates at 20 kHz, in a short and in a long run. With a given
// step, times differ by round-off, which changes phases by 1e-15 and reactions,
// sums of larger forces, by less than 1e-11. Stable steps are shortened to end
// with the run, by less than one part in the number of steps, some ten
// thousand.
TEST(MovingSupports, VibrationIsTheSameInALongRun)
{
  const auto first = [](const double step, const double end) {
    return records(
      box_mesh("0.1, 0.01, 0.01", "10, 1, 1") +
        element_text(1, "diagonal scaling") + material_text(7e10, 0.3, 2700) +
        displacements("x-min: 1e-5 * sin(2 * pi * 20000 * t); 0; 0") +
        time_integration("central difference", end, step),
      10);
  };
  const auto compare =
    [](const auto &a, const auto &b, const double tolerance) {
      for (unsigned int i = 1; i <= 10; ++i)
        EXPECT_NEAR(a[i].reaction[0],
                    b[i].reaction[0],
                    tolerance * std::abs(a[i].reaction[0]))
          << i;
    };
  compare(first(2e-7, 1e-4), first(2e-7, 10), 1e-11);
  compare(first(0, 1e-2), first(0, 10), 1e-3);
}

// Statics needs no velocity of supports: that of sqrt(t - 1) at the start is
// infinite.
TEST(MovingSupports, StaticsNeedsNoVelocity)
{
  CompleteRun run(
    bar("x-min: 0; 0; 0, x-max: 0.1*sqrt(t - 1); 0; 0") +
    section("Time integration",
            {{"Type", "static"},
             {"Start time", 1},
             {"End time", 2},
             section("static", {{"Proportional loading", false}})}));
  EXPECT_EQ(run.run(), "");
  EXPECT_EQ(run.recorder().records.back().max_displacement, 0.1);
}

// In one load step a support moves by the length of the beam, by many times
// that, or by less than a cell: the beam hangs from it as from a fixed one,
// after about as many iterations. (If the support alone moved first, it would
// crush the cells at it, and leave them in another equilibrium.)
TEST(MovingSupports, CarryABendingBeamInOneLoadStep)
{
  const auto hang = [](const std::string &rotation, const double way) {
    CompleteRun run(
      box_mesh("1, 0.2, 0.2", "5, 1, 1") + material_text(1e6) +
      rotation_at(rotation) +
      displacements(fmt::format("x-min: {}; 0; {}", way, 0.5 * way)) +
      gravity("0; 0; -10") + statics());
    EXPECT_EQ(run.run(), "");
    Vector       u = run.recorder().displacement;
    const double ways[3]{way, 0, 0.5 * way};
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      u.local_element(i) -= ways[i % 3];
    return std::make_pair(u, run.recorder().steps.at(0));
  };
  for (const std::string rotation : {"cell centre", "quadrature points"})
    {
      const auto [u, at_rest] = hang(rotation, 0);
      EXPECT_GT(at_rest.max_displacement, 0.3);
      for (const double way : {0.1, 1., 1e4})
        {
          auto [v, moved] = hang(rotation, way);
          v -= u;
          // Newton's method ends with an error of 1e-8 of the displacement.
          EXPECT_LE(v.linfty_norm(), 1e-8 * (1 + way)) << rotation << way;
          EXPECT_LE(moved.newton_iterations, at_rest.newton_iterations + 1)
            << rotation << way;
        }
    }
}

// At a kink the velocity of a support jumps, and its kinetic energy, too,
// without external work: this must not be taken for an instability.
TEST(MovingSupports, KinksAreNotInstability)
{
  CompleteRun waiting(bar("x-min: 5*ramp(t, 0.1, 1.1); 0; 0") +
                      time_integration("central difference", 0.3, 0.002));
  EXPECT_EQ(waiting.run(), "");
  CompleteRun carried(carried_bar("100*ramp(t, 0.1, 1.1)") +
                      time_integration("Newmark", 0.3, 0.01));
  EXPECT_EQ(carried.run(), "");
  // The kinetic energy of 6 kg at 100 m/s.
  EXPECT_NEAR(carried.recorder().records.back().kinetic_energy, 3e4, 1e-6);
}
