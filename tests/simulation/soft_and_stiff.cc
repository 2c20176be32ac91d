// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Bodies with soft and stiff parts: round-off of the stiff ones, which may be
// larger than all forces on the soft ones, does not hide these.

#include <corotet/time_integration/load_stepping.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "complete_run.h"
#include "stable_step.h"
#include "two_cubes.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // A soft rod sticks out of a block of steel and bends down by a body force.
  // Positions of 10 m have a round-off of 1e-15 m. In the steel this makes a
  // stress of 2 mPa, and forces that are larger than the 3e-5 N that a very
  // soft and light rod has in all.
  std::string
  rod_on_a_block(const std::string &type,
                 const double       modulus = 3,
                 const double       density = 0.01,
                 const double       force   = 0.003)
  {
    return box_mesh("2, 0.1, 0.1", "20, 1, 1") +
           section("Selections",
                   {{"Regions",
                     "block: box -1 -1 -1 1 1 1, rod: box 1 -1 -1 3 1 1"}}) +
           element_text(2) + material_type(type) +
           section(
             "Material",
             {{"Young's modulus", fmt::format("block: 2e11, rod: {}", modulus)},
              {"Density", fmt::format("block: 7800, rod: {}", density)}}) +
           section("Loads",
                   {{"Body force",
                     fmt::format("0; 0; if(x > 1, {}, 0)", -force)}});
  }

  // The displacement at the end of the run, less a translation along x.
  Vector
  bent(const std::string &text, const double translation)
  {
    CompleteRun run(text);
    EXPECT_EQ(run.run(), "");
    Vector u = run.recorder().displacement;
    for (unsigned int i = 0; i < u.locally_owned_size(); i += 3)
      u.local_element(i) -= translation;
    return u;
  }
} // namespace

// The rod and the block fly 10 m at one velocity, which makes no difference:
// seen from the flying block the rod bends as on one at rest. A rod of 30 kPa
// bends by some 5 mm, the very soft one by 0.2 m. Newton's method is asked for
// 1e-9 of the displacement, or 1e-10 where there are ten long steps.
TEST(SoftAndStiff, RodOnAFlyingBlock)
{
  for (const std::string type : {"linear", "corotational"})
    for (const bool is_very_soft : {false, true})
      {
        const double time = is_very_soft ? 1 : 0.1;
        const auto   bend = [&](const double distance) {
          return bent((is_very_soft ? rod_on_a_block(type) :
                                        rod_on_a_block(type, 3e4, 1000, 300)) +
                        newton_tolerances(is_very_soft ? 1e-10 : 1e-9) +
                        initial_conditions(
                          "0; 0; 0", fmt::format("{}; 0; 0", distance / time)) +
                        time_integration("Newmark", time, 0.1 * time),
                      distance);
        };
        const Vector at_rest = bend(0);
        EXPECT_GT(at_rest.linfty_norm(), is_very_soft ? 0.1 : 1e-3);
        EXPECT_LE(largest_difference(bend(10), at_rest), 1e-8)
          << type << ' ' << is_very_soft;
      }
}

// The same is true in statics where the support of the block moves along x.
TEST(SoftAndStiff, RodOnAMovingSupport)
{
  for (const std::string type : {"linear", "corotational"})
    {
      const auto bend = [&](const double distance) {
        return bent(rod_on_a_block(type) + newton_tolerances(1e-10) +
                      displacements(fmt::format("x-min: {}; 0; 0", distance)) +
                      statics(1),
                    distance);
      };
      const Vector at_rest = bend(0);
      EXPECT_GT(at_rest.linfty_norm(), 0.1);
      EXPECT_LE(largest_difference(bend(10), at_rest), 1e-8) << type;
    }
}

// Two cubes that have no node in common, one 1e15 times as stiff as the other
// and loaded as strongly, in one system: the soft one deforms as beside a cube
// that is as soft. Newton's method and linear solvers end when residuals are
// small beside all forces, those of the stiff cube; then the soft one is asked
// for its own.
TEST(SoftAndStiff, SeparateCubes)
{
  struct Case
  {
    std::string type, solver;
    double      load;
  };
  for (const Case &c : {Case{"linear", "jacobi", 0.05},
                        Case{"linear", "p-multigrid", 0.05},
                        Case{"neo-Hookean", "direct", 0.2},
                        Case{"Saint Venant-Kirchhoff", "p-multigrid", 0.2}})
    {
      const auto stretch = [&](const double stiff) {
        MovingBody body(
          two_cubes(dealii::Tensor<1, 3>({3., 0., 0.})),
          element_text(2) + material_type(c.type) +
            section("Material",
                    {{"Young's modulus",
                      fmt::format("body: {}, second: 1", stiff)}}) +
            fixed("x-min, second x-min") +
            tractions(fmt::format("x-max: 0; {}; 0, second x-max: {}; 0; {}",
                                  0.1 * stiff,
                                  c.load,
                                  0.3 * c.load)) +
            linear_solver(c.solver));
        LoadStepping integrator;
        integrator.step(body.system, {0., 1., 1.}, body.state);
        Vector u(body.state.u);
        for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
          if (body.discretization.node_position(n)[0] < 2)
            for (unsigned int a = 0; a < 3; ++a)
              u.local_element(3 * n + a) = 0;
        return u;
      };
      const Vector as_soft = stretch(1.);
      EXPECT_GT(as_soft.linfty_norm(), 0.04);
      EXPECT_LE(largest_difference(stretch(1e15), as_soft), 1e-5)
        << c.type << ", " << c.solver;
    }
}

// A plate, half of it 1e6 times as stiff as the other one: the stiff half
// turns as a whole about the soft one. Round-off in the rows of an assembled
// matrix is a moment on the stiff half, of some tenths of that of the load;
// iterations take it away.
TEST(SoftAndStiff, AssembledMatrixOfAPlate)
{
  const auto sink = [](const std::string &matrix) {
    CompleteRun run(
      box_mesh("10, 10, 0.1", "4, 4, 1") +
      section("Selections",
              {{"Regions", "soft: box -1 -1 -1 5 11 1, stiff: not soft"}}) +
      element_text(3) + material_type("linear") +
      section("Material", {{"Young's modulus", "soft: 1e6, stiff: 1e12"}}) +
      fixed("x-min") + gravity("0.1; 0.2; -0.3") +
      section("Linear solver", {{"Type", "direct"}, {"Operator", matrix}}) +
      statics(1));
    EXPECT_EQ(run.run(), "");
    return run.recorder().displacement;
  };
  const Vector u = sink("matrix-free");
  EXPECT_LE(largest_difference(sink("assembled"), u), 1e-5 * u.linfty_norm());
}

// A light end of a heavy body, whose mass is 1e-7 of the other end's, has the
// fastest modes: as sqrt(E / rho), to the estimates' tolerance, as the heavy
// part holds it as a wall does. With E / rho 1.1 times that of the other end
// its modes are next to those of this end.
TEST(SoftAndStiff, StableStepOfLightParts)
{
  const auto step_of_light_end = [](const double ratio) {
    return stable_step(
      box_mesh("7, 1, 1", "14, 2, 2") + element_text(1, "diagonal scaling") +
      section("Selections",
              {{"Regions",
                "heavy: box -1 -1 -1 1 9 9, light: box 6 -1 -1 8 9 9, "
                "middle: box 1 -1 -1 6 9 9"}}) +
      material_type("linear") +
      section("Material",
              {{"Young's modulus",
                fmt::format("heavy: 3e6, middle: 1e6, light: {}",
                            3e6 * 1e-7 * ratio)},
               {"Density", "heavy: 1000, middle: 1000, light: 1e-4"}}));
  };
  EXPECT_NEAR(step_of_light_end(1.1) * std::sqrt(1.1) /
                (step_of_light_end(10) * std::sqrt(10.)),
              1,
              1e-3);
}
