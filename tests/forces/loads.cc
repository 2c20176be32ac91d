// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// External forces: resultants and moments that are known exactly.

#include <corotet/operators/surface.h>

#include <gtest/gtest.h>

#include "../body.h"
#include "../refusal.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  Tensor<1, 3>
  resultant(const Vector &f)
  {
    Tensor<1, 3> sum;
    for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
      sum[i % 3] += f.local_element(i);
    return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }

  // A box of 1 x 2 x 1 with a name for two of its sides.
  SerialMesh
  body_with_sides()
  {
    SerialMesh mesh = box("1, 2, 1", "2, 3, 2", 0.2);
    for (const std::string name : {"x-max", "y-max"})
      mesh.boundaries.sets["sides"].push_back(mesh.boundaries.ids(name).at(0));
    return mesh;
  }

  // The external force on that box, of 3 kg/m^3, at time t.
  struct Loaded : public MovingBody
  {
    Loaded(const Element element, const std::string &text)
      : MovingBody(body_with_sides(),
                   element_text(element) +
                     section("Material", {{"Density", 3}}) + text)
    {}

    const Vector &
    force(const double t)
    {
      return system.equation().evaluate(state, t, 1.).external;
    }
  };

  void
  expect_near(const Tensor<1, 3> &found,
              const Tensor<1, 3> &expected,
              const double        tolerance)
  {
    EXPECT_LE((found - expected).norm(), tolerance)
      << found << " against " << expected;
  }
} // namespace

class LoadsTest : public testing::TestWithParam<Element>
{};

// The mass is 6 kg. An expression may depend on time, space, both or none: four
// ways through the code, all with the same resultant.
TEST_P(LoadsTest, GravityAndBodyForce)
{
  for (const std::string acceleration :
       {"0; 0; -10", "0; 0; -5*t", "0; 0; -20*x", "0; 0; -10*t*x"})
    {
      Loaded body(GetParam(), gravity(acceleration));
      expect_near(resultant(body.force(2.)),
                  Tensor<1, 3>({0., 0., -60.}),
                  1e-12 * 60);
    }
  for (const std::string force :
       {"4; 0; 0", "2*t; 0; 0", "4*y; 0; 0", "2*t*y; 0; 0"})
    {
      Loaded body(GetParam(), section("Loads", {{"Body force", force}}));
      expect_near(resultant(body.force(2.)), Tensor<1, 3>({8., 0., 0.}), 1e-12);
    }
}

// The area of x-max is 2, and the load rule is exact for a linear traction.
TEST_P(LoadsTest, Traction)
{
  Loaded body(GetParam(), tractions("x-max: 1; t; 6*y*z"));
  expect_near(resultant(body.force(3.)), Tensor<1, 3>({2., 6., 6.}), 1e-12);
}

// The whole force is spread evenly, so it acts at the centre of the surface; a
// name for two sides spreads it over both, in proportion to their areas of 2
// and 1.
TEST_P(LoadsTest, SurfaceForces)
{
  for (const auto &[name, middle] :
       {std::pair("x-max", Point<3>(1, 1, 0.5)),
        std::pair("sides", Point<3>(2.5 / 3, 4. / 3, 0.5))})
    {
      Loaded        body(GetParam(),
                  section("Loads",
                                 {{"Surface forces",
                                   std::string(name) + ": 1; 2*t; -3"}}));
      const Vector &f = body.force(2.);
      expect_near(resultant(f), Tensor<1, 3>({1., 4., -3.}), 1e-13);
      Tensor<1, 3> moment;
      for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
        moment += cross_product_3d(body.discretization.node_position(n),
                                   Tensor<1, 3>({f.local_element(3 * n),
                                                 f.local_element(3 * n + 1),
                                                 f.local_element(3 * n + 2)}));
      expect_near(dealii::Utilities::MPI::sum(moment, MPI_COMM_WORLD),
                  cross_product_3d(middle, Tensor<1, 3>({1., 4., -3.})),
                  1e-13);
    }
}

// All of a point force acts at the nearest node, on one rank only.
TEST_P(LoadsTest, PointForce)
{
  Loaded body(
    GetParam(),
    section("Loads", {{"Point forces", "1.1 2 1: 1; 2; 3*t, 0 0 0: 5; 0; 0"}}));
  const Vector &f = body.force(2.);
  expect_near(resultant(f), Tensor<1, 3>({6., 2., 6.}), 1e-14);
  unsigned int n_loaded = 0;
  for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
    if (f.local_element(3 * n) != 0)
      {
        ++n_loaded;
        const auto x = body.discretization.node_position(n);
        EXPECT_TRUE(x.norm() < 1e-14 || x.distance(Point<3>(1, 2, 1)) < 1e-14);
      }
  EXPECT_EQ(dealii::Utilities::MPI::sum(n_loaded, MPI_COMM_WORLD), 2u);
}

// Several nodes may be nearest, like those around the middle of a body: then
// the force acts at the one with the lowest coordinates, on any number of
// ranks. In a box of one cuboid these nodes are the corners, with elements of
// higher degree nodes inside.
TEST_P(LoadsTest, PointForceBetweenNodes)
{
  MovingBody body(
    box("1, 2, 1", "2, 3, 2"),
    element_text(GetParam()) +
      section("Loads", {{"Point forces", "0.25 0.3333333333 0.25: 1; 2; 3"}}));
  const Vector &f =
    body.system.equation().evaluate(body.state, 0., 1.).external;
  const Point<3> target(0.25, 0.3333333333, 0.25);
  const auto     position = [&](const unsigned int n) {
    return body.discretization.node_position(n);
  };
  double                distance = std::numeric_limits<double>::infinity();
  std::array<double, 3> loaded{{-1, -1, -1}};
  for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
    {
      distance = std::min(distance, position(n).distance(target));
      if (f.local_element(3 * n) != 0)
        for (unsigned int a = 0; a < 3; ++a)
          loaded[a] = position(n)[a];
    }
  distance = dealii::Utilities::MPI::min(distance, MPI_COMM_WORLD);
  for (double &x : loaded)
    x = dealii::Utilities::MPI::max(x, MPI_COMM_WORLD);
  const Point<3> found(loaded[0], loaded[1], loaded[2]);
  EXPECT_NEAR(found.distance(target), distance, 1e-9);
  // No node that is as near has lower coordinates; the first that differs
  // counts.
  constexpr double round_off = 1e-9;
  for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
    if (position(n).distance(target) < (1 + round_off) * distance)
      {
        unsigned int a = 0;
        while (a < 2 && std::abs(position(n)[a] - found[a]) < round_off)
          ++a;
        EXPECT_GE(position(n)[a], found[a] - round_off);
      }
}

// A pressure on the whole surface exerts no net force and no net torque,
// however the body is deformed; the rule is exact for it.
TEST_P(LoadsTest, PressureOnClosedSurface)
{
  Loaded body(GetParam(), pressures(on_all_sides("7")));
  body.state.u.copy_locally_owned_data_from(
    body.interpolate([](const Point<3> &x) {
      return Tensor<1, 3>(
        {std::sin(3 * x[1]), 0.3 * x[0] * x[2], std::cos(2 * x[0]) * x[1]});
    }));
  const Vector &f     = body.force(0.);
  double        scale = 0;
  Tensor<1, 3>  torque;
  for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
    {
      Tensor<1, 3> x = body.discretization.node_position(n), force;
      for (unsigned int a = 0; a < 3; ++a)
        {
          x[a] += body.state.u.local_element(3 * n + a);
          force[a] = f.local_element(3 * n + a);
        }
      scale += force.norm();
      torque += cross_product_3d(x, force);
    }
  scale = dealii::Utilities::MPI::sum(scale, MPI_COMM_WORLD);
  expect_near(resultant(f), Tensor<1, 3>(), 1e-12 * scale);
  expect_near(dealii::Utilities::MPI::sum(torque, MPI_COMM_WORLD),
              Tensor<1, 3>(),
              1e-12 * scale);
}

// A pressure follows the body: on x-max, of area 2, which is rotated by a right
// angle about z, the force -p A e_x becomes -p A e_y. With linear elasticity it
// keeps its direction.
TEST_P(LoadsTest, PressureFollows)
{
  for (const std::string type : {"corotational", "linear"})
    {
      Loaded body(GetParam(), material_type(type) + pressures("x-max: 3"));
      const Tensor<2, 3> R =
        rotation_about(Tensor<1, 3>({0., 0., 1.}), dealii::numbers::PI / 2);
      body.state.u.copy_locally_owned_data_from(body.interpolate(
        [&](const Point<3> &x) { return R * x - Tensor<1, 3>(x); }));
      expect_near(resultant(body.force(0.)),
                  type == "linear" ? Tensor<1, 3>({-6., 0., 0.}) :
                                     Tensor<1, 3>({0., -6., 0.}),
                  1e-13 * 6);
    }
}

// The volume of a stretched and sheared box is 2 det F, for any affine F.
TEST_P(LoadsTest, DisplacedVolume)
{
  Loaded       body(GetParam(), "");
  Tensor<2, 3> F(dealii::unit_symmetric_tensor<3>());
  F[0][1]        = 0.7;
  F[2][0]        = -0.3;
  F[1][1]        = 1.5;
  const Vector u = body.interpolate(
    [&](const Point<3> &x) { return F * x - Tensor<1, 3>(x); });
  EXPECT_NEAR(displaced_volume(body.discretization, body.reference, u),
              2 * determinant(F),
              1e-12);
}

TEST(Loads, Refusals)
{
  EXPECT_EQ(refusal([] {
              Loaded(1, section("Loads", {{"Point forces", "1 2: 0;0;1"}}));
            }),
            "Loads/Point forces: found '1 2: 0;0;1'; allowed: 'x y z: fx; fy; "
            "fz'");
  EXPECT_EQ(refusal([] {
              Loaded(1, section("Loads", {{"Point forces", "1 2 16: 0;0;1"}}));
            }),
            "Loads/Point forces: the point (1, 2, 16) lies outside the body: "
            "found a distance of 15 m to the nearest node, (1, 2, 1); allowed "
            "are points of the body");
  const auto refused = [](const std::string &forces) {
    return refusal(
      [&] { Loaded(1, section("Loads", {{"Surface forces", forces}})); });
  };
  EXPECT_EQ(refused("x-max: x; 0; 1"),
            "Loads/Surface forces: found 'x; 0; 1' for 'x-max'; allowed: "
            "expressions in t, as it is the force on all of it");
  EXPECT_NE(refused("x-max: 0; 0; 1, x-max: 1; 0; 0").find("'x-max'"),
            std::string::npos);
  EXPECT_NE(refused("x-max: 1").find("Loads/Surface forces"),
            std::string::npos);
  EXPECT_NE(refused("top: 0; 0; 1").find("'top'"), std::string::npos);
}

// Points are refused as outside, in all directions, if they are farther from
// the body than a fifth of the height of any cell.
TEST(Loads, PointsOutside)
{
  for (unsigned int i = 0; i < 27; ++i)
    {
      const int to[] = {int(i % 3) - 1, int(i / 3 % 3) - 1, int(i / 9) - 1};
      const Point<3>    x(0.5 * (1 + to[0]) + 0.3 * to[0],
                       1 + to[1] + 0.6 * to[1],
                       0.5 * (1 + to[2]) + 0.3 * to[2]);
      const std::string entry =
        fmt::format("{} {} {}: 0;0;1", x[0], x[1], x[2]);
      const std::string said = refusal(
        [&] { Loaded(1, section("Loads", {{"Point forces", entry}})); });
      EXPECT_EQ(said.find("lies outside the body") != std::string::npos,
                i != 13)
        << entry << ' ' << said;
    }
}

INSTANTIATE_TEST_SUITE_P(Elements,
                         LoadsTest,
                         testing::Values(Element(1),
                                         Element(2),
                                         Element(3),
                                         Element::quadratic_with_bubbles()));
