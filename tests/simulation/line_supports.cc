// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Bodies that are held at lines and points, which selections name.

#include <corotet/discretization/rigid_motions.h>
#include <corotet/time_integration/load_stepping.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../serial_meshes.h"
#include "modal.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::numbers::PI;

namespace
{
  std::string
  names(const std::string &edges, const std::string &corners = "")
  {
    return section("Selections", {{"Edges", edges}, {"Corners", corners}});
  }

  SerialMesh
  with_names(const SerialMesh  &mesh,
             const std::string &edges,
             const std::string &corners = "")
  {
    SelectionParameters selections;
    selections.edges   = edges;
    selections.corners = corners;
    return with_selections(mesh, selections);
  }

  void
  solve_static(MovingBody &body)
  {
    LoadStepping load_stepping;
    load_stepping.step(body.system, {0., 1., 1.}, body.state);
  }

  // The first frequency with m and n half waves of a square plate by Mindlin's
  // theory (J. Appl. Mech. 18, 1951, 31-38), whose edges are held in their
  // planes only, with E = rho = a = 1 and the shear coefficient 5/6: w, and
  // rotations with the potential psi, move as sin(m pi x) sin(n pi y), so with
  // k^2 = (m^2 + n^2) pi^2
  //   (S k^2 - t w^2) (D k^2 + S - t^3 / 12 w^2) = S^2 k^2.
  double
  plate_frequency(const double       t,
                  const double       poissons_ratio,
                  const unsigned int m,
                  const unsigned int n)
  {
    const double k2 = (m * m + n * n) * PI * PI;
    const double S  = 5. / 6 * t / (2 * (1 + poissons_ratio));
    const double D  = t * t * t / 12 / (1 - poissons_ratio * poissons_ratio);
    const double inertia = t * t * t / 12;
    const double a = t * inertia, b = t * (D * k2 + S) + inertia * S * k2,
                 c = S * D * k2 * k2;
    return std::sqrt(2 * c / (b + std::sqrt(b * b - 4 * a * c))) / (2 * PI);
  }
} // namespace

// Three points hold a bar without constraining it, with 3 + 2 + 1 components:
// pulled at its ends it has the displacement x sigma / E, - y nu sigma / E, - z
// nu sigma / E up to round-off, as no support has a force.
TEST(LineSupports, ThreePoints)
{
  const double stress = 0.01, nu = 0.3;
  for (const unsigned int degree : {1u, 2u, 3u})
    {
      MovingBody body(
        with_names(box("2, 1, 1", "4, 2, 2"),
                   "",
                   "origin: sphere 0 0 0 0.1, far: sphere 2 0 0 0.1, side: "
                   "sphere 0 1 0 0.1"),
        element_text(degree) + material_type("linear") +
          material_text(1, nu, 1) + fixed("origin") +
          displacements("far: free; 0; 0, side: free; free; 0") +
          tractions(
            fmt::format("x-min: {}; 0; 0, x-max: {}; 0; 0", -stress, stress)) +
          statics() + newton_tolerances(1e-12) +
          section("Linear solver", {{"Tolerance", 1e-13}}));
      solve_static(body);
      const Vector exact = body.interpolate([&](const dealii::Point<3> &x) {
        return stress * dealii::Tensor<1, 3>({x[0], -nu * x[1], -nu * x[2]});
      });
      EXPECT_LT(largest_difference(body.state.u, exact), 1e-11 * stress);
    }
}

// Modes of a square plate, ten times as wide as thick, whose sides are held
// vertically at half their height only, so that they are free to rotate, and
// cannot move along themselves. Kirchhoff's theory gives 2, 5, 5 times pi^2 /
// a^2 sqrt(D / rho t) / (2 pi), which shear reduces by 3 and 8 % in Mindlin's
// theory. The exact solution of the solid (Srinivas, J. Sound Vib. 12, 1970,
// 187-199) has w = 0 on the whole sides and frequencies 0.2 % above Mindlin's;
// supports on lines are softer, and the cells stiffer. Then follows a mode in
// the plane, half a wave of shear, sqrt(G / rho) / (2 a), which the line does
// not affect.
TEST(LineSupports, PlateOnItsMidLines)
{
  const double   t = 0.1, nu = 0.3;
  const Analysis plate(
    box_body("1, 1, 0.1", "6, 6, 2", 3, nu, 4) +
    names("rim: plane 0 0 0.05 0 0 1") +
    displacements("rim: free; free; 0, x-min: free; 0; free, x-max: free; 0; "
                  "free, y-min: 0; free; free, y-max: 0; free; free"));
  const double expected[] = {plate_frequency(t, nu, 1, 1),
                             plate_frequency(t, nu, 1, 2),
                             plate_frequency(t, nu, 2, 1),
                             0.5 * std::sqrt(0.5 / (1 + nu))};
  for (unsigned int i = 0; i < 4; ++i)
    {
      const double error = plate.mode(i + 1).frequency / expected[i] - 1;
      report(fmt::format("frequency {} of a plate on its mid-lines: error",
                         i + 1),
             error);
      EXPECT_NEAR(error, 0, i < 3 ? 0.002 : 1e-5);
    }
}

// The deflection is the same on all ranks together as on each alone, with a
// line that crosses ranks: up to the tolerance of the solver.
TEST(LineSupports, RanksAgree)
{
  const std::string text =
    element_text(3) + material_type("linear") + material_text(1, 0.3, 1) +
    displacements("rim: free; free; 0, x-min & rim: 0; 0; free") +
    gravity("0; 0; -1e-4") + statics() +
    section("Linear solver", {{"Tolerance", 1e-12}});
  const auto deflection = [&](const MPI_Comm comm) {
    SerialMesh mesh;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      mesh =
        with_names(box("1, 1, 0.2", "3, 3, 2"), "rim: plane 0 0 0.1 0 0 1");
    MovingBody body(mesh, text, comm);
    solve_static(body);
    return std::pair(body.state.u.l2_norm(), body.state.u.linfty_norm());
  };
  const auto together = deflection(MPI_COMM_WORLD);
  const auto alone    = deflection(MPI_COMM_SELF);
  EXPECT_GT(alone.second, 1e-4);
  EXPECT_NEAR(together.first / alone.first, 1, 1e-9);
  EXPECT_NEAR(together.second / alone.second, 1, 1e-9);
}

// Motions that lines and points leave free are found as for sides.
TEST(LineSupports, RigidMotions)
{
  const auto found = [](const std::string &displacement) {
    const MovingBody body(with_names(box("1, 1, 1", "2, 2, 2"),
                                     "mid: plane 0 0 0.5 0 0 1 and x-min",
                                     "far: sphere 1 0 0 0.1"),
                          displacements(displacement));
    return RigidMotions(body.discretization, body.motion).description();
  };
  EXPECT_EQ(found("mid: 0; 0; 0"),
            "the body can rotate about the axis through (0, 0.5, 0.5) along y");
  EXPECT_EQ(found("far: 0; 0; 0"),
            "the body can rotate about any axis through (1, 0, 0)");
  EXPECT_EQ(found("mid: 0; 0; 0, far: free; free; 0"), "");
}
