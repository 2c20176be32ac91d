// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The words for rigid motions that supports leave free, in cases that are easy
// to see. Statics refuses them; a singular matrix that occurs nevertheless is
// factorised only once.

#include <corotet/base/mpi.h>
#include <corotet/discretization/rigid_motions.h>
#include <corotet/mesh/msh_file.h>
#include <corotet/solvers/linear_solver_errors.h>

#include <gtest/gtest.h>

#include "../refusal.h"
#include "../temporary_folder.h"
#include "complete_run.h"
#include "two_cubes.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  const std::string anything =
    "move in any direction and rotate about any axis";

  std::string
  conditions(const std::string &held, const std::string &displacement = "")
  {
    return fixed(held) + displacements(displacement);
  }

  std::string
  motions(const SerialMesh &mesh, const std::string &text)
  {
    const MovingBody body(mesh, text);
    return RigidMotions(body.discretization, body.motion).description();
  }
} // namespace

TEST(Supports, OneBody)
{
  for (const unsigned int degree : {1, 2})
    {
      const auto found = [&](const std::string &fixed,
                             const std::string &displacement = "") {
        return motions(box("1, 2, 3", "2, 2, 2"),
                       conditions(fixed, displacement) + element_text(degree));
      };
      EXPECT_EQ(found(""), "the body can " + anything);
      EXPECT_EQ(found("x-min & z-min"),
                "the body can rotate about the axis through (0, 1, 0) along y");
      EXPECT_EQ(found("x-min & y-min & z-min"),
                "the body can rotate about any axis through (0, 0, 0)");
      EXPECT_EQ(found("", "x-min: 0; free; free"),
                "the body can move along y and z and rotate about the axis "
                "through (0.5, 1, 1.5) along x");
      EXPECT_EQ(found("", "z-min: free; free; 0, x-max: 0; free; free"),
                "the body can move along y");
      // The line is held in all directions but its own.
      EXPECT_EQ(found("", "x-min & z-min: 0; free; 0"),
                "the body can move along y and rotate about the axis through "
                "(0, 1, 0) along y");
      EXPECT_EQ(found("x-min & z-min", "x-max & y-max & z-max: free; free; 0"),
                "");
      EXPECT_EQ(found("x-min"), "");
    }
}

// Cubes that hang together at an edge or a vertex are not one piece: each part
// has to converge in terms of its own forces.
TEST(Supports, PartsOnAHinge)
{
  const TemporaryFolder folder;
  const std::string     file = folder / "cubes.msh";
  const std::string     cubes =
    section("Mesh", {{"Type", "file"}, section("file", {{"File", file}})});
  for (const double z : {0., 1.})
    {
      on_root(MPI_COMM_WORLD, [&] {
        write_msh_file(file, two_cubes(dealii::Tensor<1, 3>({1., 1., z})));
      });
      CompleteRun dynamic(cubes);
      EXPECT_FALSE(dynamic.simulation.body().is_one_piece);
      CompleteRun in_statics(cubes + fixed("x-min, second x-max") + statics());
      EXPECT_FALSE(in_statics.simulation.body().is_one_piece);
    }
  CompleteRun one(box_mesh("1, 1, 1", "1, 1, 1"));
  EXPECT_TRUE(one.simulation.body().is_one_piece);
}

// Bodies with a common edge or vertex count as one.
TEST(Supports, UnconnectedParts)
{
  const auto found = [](const dealii::Tensor<1, 3> &shift) {
    const MovingBody body(two_cubes(shift), "");
    return unconnected_parts(body.discretization,
                             ConnectedParts(body.discretization));
  };
  EXPECT_EQ(
    found(dealii::Tensor<1, 3>({3., 0., 0.})),
    "there are 2 bodies without a common node, and each moves on its own: "
    "the part at (0.5, 0.5, 0.5) of region 'body' and the part at (3.5, "
    "0.5, 0.5) of region 'second'");
  for (const double z : {0., 1.})
    EXPECT_EQ(found(dealii::Tensor<1, 3>({1., 1., z})), "");
}

// A part that is attached at an edge or a vertex can only rotate about it; a
// further support prevents that. Other parts are named by their position.
TEST(Supports, SeveralParts)
{
  const auto found = [](const dealii::Tensor<1, 3> &shift,
                        const std::string          &fixed,
                        const std::string          &displacement = "") {
    return motions(two_cubes(shift), conditions(fixed, displacement));
  };
  const dealii::Tensor<1, 3> apart({3., 0., 0.}), edge({1., 1., 0.}),
    vertex({1., 1., 1.});
  EXPECT_EQ(found(apart, "x-min"),
            "the part at (3.5, 0.5, 0.5) of region 'second' can " + anything);
  EXPECT_EQ(found(apart, ""),
            "the part at (0.5, 0.5, 0.5) of region 'body' can " + anything +
              "; the part at (3.5, 0.5, 0.5) of region 'second' can " +
              anything);
  EXPECT_EQ(found(apart, "x-min, second x-min"), "");
  EXPECT_EQ(found(edge, "x-min"),
            "the part at (1.5, 1.5, 0.5) of region 'second' can rotate about "
            "the axis through (1, 1, 0.5) along z");
  EXPECT_EQ(found(edge, "x-min", "second x-max: free; 0; free"), "");
  EXPECT_EQ(found(vertex, "x-min"),
            "the part at (1.5, 1.5, 1.5) of region 'second' can rotate about "
            "any axis through (1, 1, 1)");
  EXPECT_EQ(found(vertex,
                  "x-min",
                  "second x-max & second y-min & second z-max: 0; 0; 0"),
            "the part at (1.5, 1.5, 1.5) of region 'second' can rotate about "
            "the axis through (1.5, 1, 1.5) along (0.7071, 0, 0.7071)");
}

// Descriptions for a body of radius 2: a screw with a translation of 1 m per
// radian, which moves points at that radius by 2 m; and directions that are not
// along axes.
TEST(Supports, Words)
{
  const dealii::Point<3> centre(1, 0, 0);
  EXPECT_EQ(describe({{{0., 0., 0.5, 0., 0., 1.}}}, centre, 2.),
            "rotate about the axis through (1, 0, 0) along z while it moves "
            "along it by 1 m per radian");
  EXPECT_EQ(describe({{{1., 1., 0., 0., 0., 0.}}}, centre, 2.),
            "move along (0.7071, 0.7071, 0)");
  // A rotation about the line x = 3, y = 0.
  EXPECT_EQ(describe({{{0., -1., 0., 0., 0., 1.}}}, centre, 2.),
            "rotate about the axis through (3, 0, 0) along z");
}

// Statics needs supports also where the loads are balanced. In dynamics a body
// may be free.
TEST(Supports, AreNeededInStatics)
{
  const auto refused = [](const std::string &type) {
    return refusal([&] {
      CompleteRun run(fixed("x-min & z-min") + pressures("x-min: 1, x-max: 1") +
                      section("Time integration", {{"Type", type}}));
    });
  };
  EXPECT_EQ(refused("static"),
            "Boundary conditions/Fixed: statics needs a body that cannot move "
            "without strain; found: the body can rotate about the axis through "
            "(0, 0.05, 0) along y; allowed: Fixed and Displacement such that "
            "nothing of this is left, or another Time integration/Type");
  EXPECT_EQ(refused("Newmark"), "nothing was refused");
}

namespace
{
  // Why the first load step of a cube fails, with an error of this type.
  template <typename Error>
  std::string
  error_of_first_step(const std::string &text)
  {
    MovingBody body(box("1, 1, 1", "2, 2, 2"),
                    text + tractions("x-max: 1; 0; 0") + statics());
    TimeLoop   stepper(body.parameters, body.system, body.log);
    StepRecord record = stepper.start({});
    try
      {
        stepper.next(record);
      }
    catch (const Error &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

// Shorter load steps would have the same matrix, so it is factorised only once.
TEST(Supports, SingularMatrixEndsStatics)
{
  for (const std::string law : {"linear", "corotational"})
    EXPECT_EQ(error_of_first_step<SingularMatrixError>(material_type(law)),
              "the stiffness matrix is singular: the body or a part of it can "
              "move without resistance, because not enough is prescribed")
      << law;
}

// Nor do shorter load steps help a solver that needs more iterations than are
// allowed.
TEST(Supports, SolverThatStopsEndsStatics)
{
  for (const std::string law : {"linear", "corotational"})
    {
      const std::string message = error_of_first_step<LinearSolverError>(
        material_type(law) + fixed("x-min") +
        section("Linear solver",
                {{"Type", "jacobi"}, {"Maximum iterations", 2}}));
      EXPECT_EQ(message.find("the linear solver stopped after 2 iterations"),
                0u)
        << law << ": " << message;
      EXPECT_EQ(message.find("halved"), std::string::npos) << message;
    }
}
