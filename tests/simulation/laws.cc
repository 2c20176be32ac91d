// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Every registered law in whole problems: orders of convergence to exact
// solutions, iterations of the preconditioner, and failures where a law has no
// stress.

#include <corotet/laws/neo_hookean.h>
#include <corotet/operators/error_norms.h>
#include <corotet/time_integration/load_stepping.h>

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
  // A displacement that rotates by up to 50 degrees, with strains of up to 20
  // percent. Two sides are prescribed, the others have tractions.
  const std::string exact_displacement =
    "0.2*sin(2*x+y)*y - 0.4*y; 0.6*x*x + 0.1*cos(3*y)*x + 0.5*x; "
    "0.15*sin(2*z)*(1+x) - 0.2*x*y";

  std::string
  exact_problem(const unsigned int degree, const NamedLaw &law)
  {
    return element_text(degree) + law.text + material_text(10) +
           section("Exact solution",
                   {{"Displacement", exact_displacement},
                    {"Displacement boundary", "x-min, y-max"}}) +
           statics() + newton_tolerances(1e-11);
  }

  FieldNorms
  errors(const unsigned int degree, const NamedLaw &law, const unsigned int n)
  {
    MovingBody body(box("0.5, 0.5, 0.5", fmt::format("{0}, {0}, {0}", n), 0.1),
                    exact_problem(degree, law));
    LoadStepping load_stepping;
    load_stepping.proportional = false;
    load_stepping.step(body.system, {0., 1., 1.}, body.state);
    Vector u;
    body.discretization.initialize_vector(u);
    u.copy_locally_owned_data_from(body.state.u);
    u.update_ghost_values();
    const ExactSolution &exact = *body.problem.solution();
    return error_norms(body.discretization,
                       body.materials,
                       u,
                       [&](const Point<3> &x) {
                         return PointDisplacement{exact.displacement(x, 1.),
                                                  exact.gradient(x, 1.)};
                       })
      .error;
  }

  class LawsInProblems
    : public testing::TestWithParam<std::tuple<unsigned int, unsigned int>>
  {};

  // A cube of neo-Hookean material between two plates, one of which moves.
  std::string
  squeezed(const std::string &displacement,
           const std::string &integration,
           const std::string &mass = "consistent")
  {
    return box_mesh("1, 1, 1", "2, 2, 2") + element_text(2, mass) +
           material_type("neo-Hookean") + material_text(1e6) + fixed("x-min") +
           displacements("x-max: " + displacement + "; 0; 0") + integration;
  }

  // Checks that quadratic elements give a quadratic displacement exactly.
  void
  expect_exact(const SerialMesh &mesh, const std::string &prescribed)
  {
    MovingBody body(
      mesh,
      element_text(2) + material_type("linear") + material_text(10) +
        section("Exact solution",
                {{"Displacement", "0.1*x*y; 0.2*x*x - y*z; 0.3*z*z + x"},
                 {"Displacement boundary", prescribed}}) +
        statics() + newton_tolerances(1e-11));
    LoadStepping load_stepping;
    load_stepping.proportional = false;
    load_stepping.step(body.system, {0., 1., 1.}, body.state);
    const ExactSolution &exact = *body.problem.solution();
    for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
      {
        const Tensor<1, 3> u =
          exact.displacement(body.discretization.node_position(n), 1.);
        for (unsigned int a = 0; a < 3; ++a)
          // The error that the tolerance of the linear solver leaves.
          EXPECT_NEAR(body.state.u.local_element(3 * n + a), u[a], 1e-8)
            << prescribed;
      }
  }
} // namespace

// Tractions of exact solutions also act on sides without names.
TEST(ExactSolutions, TractionsOnSidesWithoutNames)
{
  SerialMesh mesh = box("0.5, 0.5, 0.5", "2, 2, 2", 0.1);
  std::erase_if(mesh.faces, [&](const SerialMesh::Face &face) {
    const auto &name = mesh.boundaries.names.at(face.boundary);
    return name != "x-min" && name != "y-max";
  });
  expect_exact(mesh, "x-min");
}

// The boundary with the given name is prescribed, even if the name is the
// number of another boundary.
TEST(ExactSolutions, NumbersAsNames)
{
  SerialMesh mesh = box("0.5, 0.5, 0.5", "2, 2, 2", 0.1);
  for (auto &[id, name] : mesh.boundaries.names)
    name = std::to_string((id + 1) % 6);
  for (const std::string prescribed : {"0", "2", "3, 1", "all"})
    expect_exact(mesh, prescribed);
}

// One rotation per cell leaves out O(h) times the strain; for its orders see
// large_rotations.cc.
TEST_P(LawsInProblems, OrdersOfConvergence)
{
  const auto &[degree, number] = GetParam();
  const NamedLaw &law          = all_laws()[number];
  if (law.law->has_cell_rotation())
    GTEST_SKIP() << "orders of one rotation per cell are in LargeRotations";
  const unsigned int n      = degree == 1 ? 8 : 4;
  const FieldNorms   coarse = errors(degree, law, n),
                   fine     = errors(degree, law, 2 * n);
  const double L2           = std::log2(coarse.L2 / fine.L2),
               H1           = std::log2(coarse.H1 / fine.H1);
  report(fmt::format("L2 order, P{}, {}", degree, law.name), L2);
  report(fmt::format("H1 order, P{}, {}", degree, law.name), H1);
  EXPECT_NEAR(L2, degree + 1, 0.25);
  EXPECT_NEAR(H1, degree, 0.2);
}

INSTANTIATE_TEST_SUITE_P(
  All,
  LawsInProblems,
  testing::Combine(testing::Values(1u, 2u, 3u),
                   testing::Range<unsigned int>(0, all_laws().size())));

// The preconditioner uses linear elasticity rotated with the cells, for any
// law: with strains of some tens of percent it takes a few times as many
// iterations.
TEST(Laws, Preconditioner)
{
  double of_linear = 0;
  for (const NamedLaw &law : all_laws())
    {
      // Laws with one rotation per cell have another solution here;
      // large_rotations.cc checks them.
      if (law.law->has_cell_rotation())
        continue;
      MovingBody   body(box("0.5, 0.5, 0.5", "4, 4, 4", 0.1),
                      exact_problem(3, law));
      LoadStepping load_stepping;
      load_stepping.proportional = false;
      const StageReport solved =
        load_stepping.step(body.system, {0., 1., 1.}, body.state);
      const double iterations =
        double(solved.linear_iterations) / solved.newton_iterations;
      report("p-multigrid iterations per Newton iteration, " + law.name,
             iterations);
      EXPECT_LE(solved.newton_iterations, 8u);
      if (law.law->is_linear())
        of_linear = iterations;
      EXPECT_LE(iterations, 4 * of_linear);
    }
}

// A plate moves so far in one step that the first guess has inverted cells: the
// step is made in parts, and the body ends in the same state as with small
// steps.
TEST(NeoHookean, FailingStepIsHalved)
{
  CompleteRun one(squeezed("3", statics(1)));
  CompleteRun many(squeezed("3", statics(8)));
  EXPECT_EQ(one.run(), "");
  EXPECT_EQ(many.run(), "");
  const StepRecord &far  = one.recorder().steps.back(),
                   &slow = many.recorder().steps.back();
  EXPECT_GT(far.parts, 1u);
  EXPECT_EQ(slow.parts, 1u);
  // The tolerance follows from that of Newton's method, 1e-8.
  EXPECT_NEAR(far.elastic_energy,
              slow.elastic_energy,
              1e-7 * slow.elastic_energy);
  EXPECT_GT(far.min_det_F, 0.);
}

// A body pressed flat, for which the law has no stress, fails with the reason.
TEST(NeoHookean, FlatBodyFails)
{
  CompleteRun       static_run(squeezed("-1", statics(1, 0)));
  const std::string flat = static_run.run();
  EXPECT_NE(flat.find("cells are flat or inside out"), std::string::npos)
    << flat;
  EXPECT_NE(flat.find("smallest det F"), std::string::npos) << flat;

  CompleteRun explicit_run(
    squeezed("-0.98*t/0.1",
             time_integration("central difference", 0.1, 0),
             "nodal quadrature"));
  const std::string crushed = explicit_run.run();
  EXPECT_NE(crushed.find("cells are flat or inside out"), std::string::npos)
    << crushed;
}
