// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Bodies on springs at rest: statics, supports that are sufficient, stiff
// springs, modes.

#include <corotet/simulation/start_checks.h>
#include <corotet/solvers/preconditioners.h>
#include <corotet/time_integration/load_stepping.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../refusal.h"
#include "modal.h"
#include "supported_box.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Tensor;
using dealii::numbers::PI;

namespace
{
  // Springs with the same stiffness along all axes.
  std::string
  springs(const std::string &boundary, const double k)
  {
    return fmt::format("{0}: {1}; {1}; {1}", boundary, k);
  }
} // namespace

// A block of 2 kg on springs of 8 N/m^3 under its weight, 10 m/s^2, along x, y
// or z: the springs, on an area A of 1 m^2, yield by m g / (k A). Without
// lateral contraction only a weight along z stretches the block, by g z (H - z
// / 2) rho / E, which with E = 1e9 is 2e-8 of the displacement; across, shear
// is as small. Checked for all elements and both materials.
TEST(ElasticSupports, BlockSinks)
{
  for (const Element element :
       {Element(1), Element(2), Element(3), Element::quadratic_with_bubbles()})
    for (const std::string type : {"linear", "corotational"})
      {
        // A corotational body gets no moments, which would rotate it.
        const bool  is_linear = type == "linear";
        CompleteRun run(supported_box("1, 1, 2", "1, 2, 2", 1e9, type) +
                        element_text(element) + supports("z-min: 4; 5; 8") +
                        gravity(is_linear ? "0; 0; -10" : "0; 0; -0.1") +
                        statics());
        ASSERT_EQ(run.run(), "");
        const double expected = is_linear ? -2.5 : -0.025;
        EXPECT_NEAR(mean_displacement(run, 2), expected, 1e-7);
        const StepRecord &record = last_record(run);
        // The springs store half of the work of the weight.
        EXPECT_NEAR(record.elastic_energy, 4 * expected * expected, 1e-6);
        EXPECT_NEAR(record.energy_balance, 0, 1e-9 * record.elastic_energy);
        if (is_linear)
          {
            EXPECT_EQ(record.newton_iterations, 1u);
          }
      }
}

// Statics takes account of springs, and tells the motions that they leave free.
TEST(ElasticSupports, RigidMotions)
{
  const auto refusal_of = [](const std::string &text) {
    return refusal([&] {
      CompleteRun run(supported_box("1, 1, 1", "2, 2, 2", 1.) + text +
                      statics());
    });
  };
  const std::string begin =
    "Boundary conditions/Fixed: statics needs a body that cannot move without "
    "strain; found: the body can ";
  const std::string end =
    "; allowed: Fixed, Displacement and Supports such that nothing of this is "
    "left, or another Time integration/Type";
  const std::string nothing = "nothing was refused";
  EXPECT_EQ(refusal_of(supports("z-min: 1e-3; 1; 1e3")), nothing);
  EXPECT_EQ(refusal_of(supports("", "z-min: 1, x-min: 1, y-min: 1")), nothing);
  EXPECT_EQ(refusal_of(supports("", "z-min: 1")),
            begin +
              "move along x and y and rotate about the axis through (0.5, "
              "0.5, 0.5) along z" +
              end);
  EXPECT_EQ(refusal_of(supports("z-min: 0; 0; 1", "x-max: 2")),
            begin + "move along y" + end);
  // Springs where x > 1/2 only are sufficient, like those on the whole side.
  EXPECT_EQ(refusal_of(supports("z-min: 1; 1; if(x > 0.5, 1, 0)")), nothing);
  EXPECT_EQ(refusal_of(supports("", "z-min: 1") +
                       displacements("x-min: 0; 0; free")),
            nothing);
  // Dashpots do not prevent motions in statics.
  EXPECT_EQ(refusal_of(supports("", "", "z-min: 1; 1; 1")),
            begin + "move in any direction and rotate about any axis" + end);
}

// A support that is k times stiffer yields by 1/k of it: at the end of a bar
// pulled by 1 Pa, the difference to a fixed bar is exactly 1/k.
TEST(ElasticSupports, StiffSpringsFix)
{
  const std::string text = supported_box("2, 1, 1", "4, 2, 2", 1.) +
                           tractions("x-max: 1; 0; 0") + statics();
  for (const double k : {1e2, 1e4, 1e6})
    {
      CompleteRun run(text + supports(springs("x-min", k)));
      ASSERT_EQ(run.run(), "");
      // The fixed bar has no springs: the mean of x / E is 1 m.
      CompleteRun clamped(text + fixed("x-min"));
      ASSERT_EQ(clamped.run(), "");
      EXPECT_NEAR(mean_displacement(run, 0) - mean_displacement(clamped, 0),
                  1 / k,
                  1e-11);
    }
}

// With springs from soft to very stiff, 1e9 E / L, p-multigrid takes about as
// many iterations as for the fixed body, for any element, and each solve is
// that of a linear problem. So do the other preconditioners.
TEST(ElasticSupports, StiffSpringsDoNotStall)
{
  struct Case
  {
    Element     element;
    std::string type          = "p-multigrid";
    std::string operator_type = "matrix-free";
  };
  for (const Case &c : {Case{1},
                        Case{2},
                        Case{3},
                        Case{Element::quadratic_with_bubbles()},
                        Case{2, "amg"},
                        Case{2, "direct", "assembled"}})
    {
      // Builds without Epetra have no amg.
      bool is_there = c.type != "amg";
      for (const Candidate<Preconditioner> &candidate : preconditioners())
        is_there = is_there || candidate.name == c.type;
      if (!is_there)
        continue;
      const std::string text =
        supported_box("4, 1, 1", "8, 2, 2", 1e6) + linear_solver(c.type, 1e-8) +
        section("Linear solver", {{"Operator", c.operator_type}}) +
        section("Newton", {{"Residual tolerance", 1e-8}}) +
        element_text(c.element) + tractions("x-max: 1e3; 200; 100") + statics();
      CompleteRun clamped(text + fixed("x-min"));
      ASSERT_EQ(clamped.run(), "");
      const unsigned int n    = last_record(clamped).linear_iterations;
      unsigned int       most = 0;
      for (const double k : {1e2, 1e5, 1e8, 1e11, 1e14})
        {
          CompleteRun run(text + supports(springs("x-min", k)));
          ASSERT_EQ(run.run(), "");
          EXPECT_EQ(last_record(run).newton_iterations, 1u);
          most = std::max(most, last_record(run).linear_iterations);
        }
      report(fmt::format("{} nodes, {}: iterations when fixed",
                         c.element.n_nodes(),
                         c.type),
             n);
      report("  with springs, at most", most);
      EXPECT_LE(most, n + n / 2 + 4);
    }
}

// The same is true where springs are not along the axes: they are normal to
// three sides of a rotated block, and leave the sides free along them.
TEST(ElasticSupports, StiffNormalSpringsDoNotStall)
{
  for (const unsigned int degree : {1, 2, 3})
    for (const double k : {1., 1e3, 1e6, 1e9, 3e9})
      {
        SerialMesh mesh = box("1, 1, 1", "4, 4, 4", 0.1);
        const auto R    = rotation_about(Tensor<1, 3>({1, 2, 3}), 0.7);
        for (auto &x : mesh.vertices)
          x = dealii::Point<3>(R * x);
        MovingBody body(
          mesh,
          element_text(degree) + material_type("linear") + material_text(1) +
            supports("", fmt::format("x-min: {0}, y-min: {0}, z-min: {0}", k)) +
            tractions("x-max: 1; 2; -1"));
        LoadStepping      integrator;
        const StageReport stage =
          integrator.step(body.system, {0., 1., 1.}, body.state);
        EXPECT_EQ(stage.newton_iterations, 1u);
        EXPECT_LE(stage.linear_iterations, 18u);
        report(fmt::format("degree {}, k = {:g}: iterations", degree, k),
               stage.linear_iterations);
      }
}

// A factorisation may need more room for pivots than MUMPS expects.
TEST(ElasticSupports, FactorsWithVeryStiffSprings)
{
  SerialMesh mesh = box("1, 1, 1", "3, 3, 3", 0.1);
  const auto R    = rotation_about(Tensor<1, 3>({1, 2, 3}), 0.7);
  for (auto &x : mesh.vertices)
    x = dealii::Point<3>(R * x);
  MovingBody        body(mesh,
                  element_text(2) + material_type("linear") + material_text(1) +
                    supports("", "x-min: 1e12, y-min: 1e12, z-min: 1e12") +
                    tractions("x-max: 1; 2; -1") +
                    section("Linear solver", {{"Type", "direct"}}));
  LoadStepping      integrator;
  const StageReport stage =
    integrator.step(body.system, {0., 1., 1.}, body.state);
  EXPECT_EQ(stage.newton_iterations, 1u);
  EXPECT_LE(stage.linear_iterations, 3u);
}

// Springs normal to the side of a round disc let it rotate about its axis, but
// for the corners of its side, of which there are 128. A log with all warnings
// says so, not if the springs resist in all directions, nor if the disc is
// square.
TEST(ElasticSupports, NormalSpringsOnARoundDisc)
{
  const auto warns = [](const bool is_round, const std::string &springs) {
    SerialMesh mesh = box("2, 2, 0.2", "32, 32, 1");
    for (auto &x : mesh.vertices)
      {
        const double a = x[0] - 1, b = x[1] - 1;
        if (is_round)
          {
            x[0] = a * std::sqrt(1 - b * b / 2);
            x[1] = b * std::sqrt(1 - a * a / 2);
          }
      }
    MovingBody body(mesh,
                    element_text(1) + springs +
                      displacements("z-min: free; free; 0"));
    const auto all = body.system.equation().terms.springs(body.reference, 1.);
    const std::string before = body.log.counts();
    warn_of_weak_springs(body, all->springs(), body.log);
    return body.log.counts() != before;
  };
  const std::string sides = "x-min: 1, x-max: 1, y-min: 1, y-max: 1";
  const std::string in_all_directions =
    "x-min: 1; 1; 1, x-max: 1; 1; 1, y-min: 1; 1; 1, y-max: 1; 1; 1";
  EXPECT_TRUE(warns(true, supports("", sides)));
  EXPECT_FALSE(warns(false, supports("", sides)));
  EXPECT_FALSE(warns(true, supports(in_all_directions, "")));
}

// Modes of a bar along z with springs at its lower end satisfy omega tan(omega
// L / c) = k c / E; transverse waves do the same with the shear modulus E / 2
// (nu = 0), except for the rocking of a square bar, which stiff lateral springs
// prevent: those are other modes. Eight cubic elements give the lowest mode to
// 1e-9. For k L / E << 1 its frequency is that of a rigid block, sqrt(k / (rho
// L)), times 1 - k L / (6 E) to first order.
TEST(ElasticSupports, BarOnASpring)
{
  for (const double k : {1e-4, 1., 30.})
    {
      double lower = 0, upper = PI / 2;
      for (unsigned int i = 0; i < 100; ++i)
        {
          const double middle = 0.5 * (lower + upper);
          (middle * std::tan(middle) < k ? lower : upper) = middle;
        }
      Analysis    body(box_body("0.2, 0.2, 1", "1, 1, 8", 3, 0., 6) +
                    supports(fmt::format("z-min: {0}; {0}; {1}", 1e6, k)));
      const Mode *found = nullptr;
      for (unsigned int i = 6; i > 0; --i)
        if (body.mode(i).effective_mass[2] > 0.5 * 0.04)
          found = &body.mode(i);
      ASSERT_NE(found, nullptr);
      EXPECT_NEAR(found->angular_frequency / lower, 1, 1e-7);
      // Residuals are at the tolerance or at round-off, which stays far below
      // its bound: for a shift far above omega^2 they are what solves leave,
      // times the ratio of the two.
      for (unsigned int i = 1; i <= 6; ++i)
        EXPECT_LE(body.mode(i).residual,
                  std::max(1e-8, 0.1 * body.mode(i).round_off))
          << k << ' ' << i;
      if (k < 1e-3)
        {
          EXPECT_NEAR(found->angular_frequency / std::sqrt(k),
                      1 - k / 6,
                      k * k);
        }
    }
}

// A free block on springs has no rigid body modes: the lowest three modes are
// its translations, with sqrt(k_sum / m) for equal springs on all sides.
TEST(ElasticSupports, BlockOnSoftSprings)
{
  const double k = 1e-5;
  Analysis     body(box_body("1, 1, 1", "2, 2, 2", 2, 0.3, 7) +
                supports(springs("x-min", k) + ", " + springs("x-max", k)));
  // The block itself yields by some k L / E of the displacement.
  for (unsigned int i = 1; i <= 3; ++i)
    EXPECT_NEAR(body.mode(i).angular_frequency / std::sqrt(2 * k), 1, 2 * k);
  for (unsigned int i = 4; i <= 6; ++i)
    EXPECT_GT(body.mode(i).angular_frequency, std::sqrt(k));
  EXPECT_GT(body.mode(7).angular_frequency, 1);
}

// The springs of a free block are a million times stiffer than the block along
// one axis, and soft along another one. The free motion has frequency zero, up
// to round-off relative to the soft springs, not to the stiff ones.
TEST(ElasticSupports, StiffGuideOfAFreeBlock)
{
  for (const unsigned int degree : {1, 2})
    {
      const Analysis body(box_body("1, 1.1, 0.9", "2, 2, 2", degree, 0., 4) +
                          supports("z-min: 0; 0; 1e6, x-max: 1e-2; 0; 0"));
      for (unsigned int i = 1; i <= 4; ++i)
        EXPECT_LE(body.mode(i).residual, 1e-8) << degree << ' ' << i;
      // Nothing holds the block along y.
      EXPECT_LE(body.mode(1).angular_frequency,
                1e-6 * body.mode(2).angular_frequency);
    }
}
