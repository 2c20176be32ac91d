// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Contact with rigid obstacles: gaps, forces, energies and derivatives, for
// each element and shape.

#include <corotet/base/exceptions.h>
#include <corotet/forces/obstacle.h>
#include <corotet/operators/surface_matrix.h>

#include <gtest/gtest.h>

#include "../body.h"
#include "../refusal.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  std::string
  contact(const std::string &obstacles,
          const std::string &friction  = "",
          const std::string &motions   = "",
          const std::string &stiffness = "")
  {
    return section("Contact",
                   {{"Obstacles", obstacles},
                    {"Friction", friction},
                    {"Motions", motions},
                    {"Stiffness", stiffness},
                    {"Slip velocity", 0.1}});
  }

  // A block of 2 m x 1 m x 1 m, of distorted cells.
  struct TouchingBlock : public MovingBody
  {
    TouchingBlock(const Element element, const std::string &text)
      : MovingBody(box("2, 1, 1", "3, 2, 2", 0.1), element_text(element) + text)
    {}
  };

  Vector
  moved_by(const MovingBody &body, const Tensor<1, 3> &u)
  {
    return body.interpolate([&](const Point<3> &) { return u; });
  }

  // A motion that is not a polynomial of the elements, about 0.1 m.
  Vector
  waves(const MovingBody &body, const double phase)
  {
    return body.interpolate([&](const Point<3> &x) {
      return Tensor<1, 3>({0.1 * std::sin(3 * x[0] + x[1] + phase),
                           0.1 * std::cos(2 * x[1] - x[2] + phase),
                           0.1 * std::sin(x[0] * x[1] + 2 * x[2] + phase)});
    });
  }

  Vector
  sum(const Vector &u, const double factor, const Vector &w)
  {
    Vector result(u);
    result.zero_out_ghost_values();
    result.add(factor, w);
    result.update_ghost_values();
    return result;
  }

  // The sum that a member of ForceTerms computes as a resistance, as a force.
  template <typename Sum>
  Vector
  force_of(const MovingBody &body, const Motion &motion, const Sum &sum)
  {
    Vector f;
    body.discretization.initialize_vector(f);
    (body.system.equation().terms.*sum)(f, motion);
    f *= -1;
    return f;
  }

  // Of the obstacles that do not move.
  Vector
  pressure(const MovingBody &body, const Motion &motion)
  {
    return force_of(body, motion, &ForceTerms::elastic_force);
  }

  Vector
  friction(const MovingBody &body, const Motion &motion)
  {
    return force_of(body, motion, &ForceTerms::damping_force);
  }

  // (S w) with S = - (c_u df/du + c_v df/dv).
  Vector
  product(const MovingBody &body,
          const Motion     &motion,
          const double      c_u,
          const double      c_v,
          const Vector     &w)
  {
    SurfaceMatrix matrix(body.discretization, body.reference);
    body.system.equation().terms.surface_matrix(matrix, motion, c_u, c_v);
    SurfaceOperator<double> S(body.discretization);
    S.set(matrix);
    Vector f;
    body.discretization.initialize_vector(f);
    S.add(f, w);
    return f;
  }

  // Minus the derivative of the pressure along w, by central differences.
  Vector
  minus_derivative_of_pressure(const MovingBody &body,
                               const Vector     &u,
                               const Vector     &w)
  {
    constexpr double h    = 1e-6;
    const Vector     more = sum(u, h, w), less = sum(u, -h, w);
    Vector           difference = pressure(body, {0., more, more});
    difference -= pressure(body, {0., less, less});
    difference *= -0.5 / h;
    return difference;
  }

  // Planes and curved surfaces that the block is partly inside of when it has
  // moved by waves().
  const std::string flat_obstacles =
    "p: plane 0 0 0 0.1 0.2 1, b: box 1 1 0 5 5 5";
  const std::string curved_obstacles =
    "s: sphere 1 0 -1 1.1, h: not sphere 1 0.5 0.5 1.1, "
    "c: cylinder 0.5 -0.4 0.5 1.5 -0.4 0.5 0.5";
} // namespace

// The distances of points inside and outside of shapes, and their normals.
TEST(Obstacles, Gaps)
{
  struct Example
  {
    std::string  shape;
    Point<3>     x;
    double       distance;
    Tensor<1, 3> normal;
  };
  const Tensor<1, 3>         up({0, 0, 1}), aside({1, 0, 0});
  const std::vector<Example> examples{
    {"plane 0 0 1 0 0 2", {5, 6, 3}, 2, up},
    {"plane 0 0 1 0 0 2", {5, 6, 0.5}, -0.5, up},
    {"not plane 0 0 1 0 0 2", {5, 6, 0.5}, 0.5, -up},
    {"box 1 2 3 0 0 0", {0.5, 1, 2.75}, -0.25, up},
    {"box 0 0 0 1 2 3", {1.5, 1, 1}, 0.5, aside},
    {"not box 0 0 0 1 2 3", {1.5, 1, 1}, -0.5, -aside},
    {"sphere 1 1 1 2", {1, 1, 4}, 1, up},
    {"sphere 1 1 1 2", {2, 1, 1}, -1, aside},
    {"not sphere 1 1 1 2", {4, 1, 1}, -1, -aside},
    {"cylinder 0 0 0 0 0 4 1", {0.75, 0, 2}, -0.25, aside},
    {"cylinder 0 0 0 0 0 4 1", {0.5, 0, 3.75}, -0.25, up},
    {"cylinder 0 0 0 0 0 4 1", {0, 0, -3}, 3, -up}};
  for (const Example &example : examples)
    {
      const Obstacle      obstacle("name", example.shape, "entry");
      const Obstacle::Gap gap = obstacle.gap(example.x);
      EXPECT_NEAR(gap.distance, example.distance, 1e-15) << example.shape;
      EXPECT_NEAR((gap.normal - example.normal).norm(), 0, 1e-15)
        << example.shape;
    }
}

class ContactTest : public testing::TestWithParam<Element>
{};

INSTANTIATE_TEST_SUITE_P(Elements,
                         ContactTest,
                         testing::Values(Element(1),
                                         Element(2),
                                         Element(3),
                                         Element::quadratic_with_bubbles()));

// A block stands 0.05 m inside of a plane: the pressure is 0.05 k on the 2 m^2
// of its lower side, and on the parts of the other sides that are inside, which
// add to it. Away from the plane there is none.
TEST_P(ContactTest, ForceOfAPlane)
{
  TouchingBlock body(
    GetParam(), contact("floor: plane 0 0 0.05 0 0 1", "", "", "floor: 1e5"));
  const auto  &terms  = body.system.equation().terms;
  const Vector u      = moved_by(body, Tensor<1, 3>({0.3, 0, 0}));
  const Motion motion = {0., u, u};
  const auto   forces = terms.contact_forces(motion);
  ASSERT_EQ(terms.obstacles(), std::vector<std::string>{"floor"});
  EXPECT_GT(forces[0].second[2], 1e5 * 0.05 * 2 * (1 - 1e-12));
  EXPECT_NEAR(forces[0].second[0], 0, 1e-9);
  EXPECT_EQ(terms.contact_energy(motion), terms.energy(motion));
  const Vector away = moved_by(body, Tensor<1, 3>({0.3, 0, 0.051}));
  EXPECT_EQ(terms.contact_forces({0., away, away})[0].second.norm(), 0);
  EXPECT_EQ(terms.energy({0., away, away}), 0);
}

// Sides of the block that are named alone touch: on z-min the depth is 0.05 m,
// and the force is exact.
TEST_P(ContactTest, NamedBoundaries)
{
  TouchingBlock body(
    GetParam(),
    contact("floor: plane 0 0 0.05 0 0 1", "", "", "floor: 1e5") +
      section("Contact", {{"Boundaries", "z-min, z-max"}}));
  const Vector u      = moved_by(body, Tensor<1, 3>({0.3, 0, 0}));
  const auto  &terms  = body.system.equation().terms;
  const auto   forces = terms.contact_forces({0., u, u});
  EXPECT_NEAR(forces[0].second[2], 1e5 * 0.05 * 2, 1e-12 * 1e4);
  EXPECT_NEAR(terms.contact_energy({0., u, u}),
              0.5 * 1e5 * 0.05 * 0.05 * 2,
              1e-12 * 250);
}

// The pressure is minus the derivative of the energy. The error of central
// differences is of the size of the step squared, and of round-off over the
// step.
TEST_P(ContactTest, PressureHasTheEnergy)
{
  for (const std::string &obstacles : {flat_obstacles, curved_obstacles})
    {
      TouchingBlock body(GetParam(), contact(obstacles));
      const auto   &terms = body.system.equation().terms;
      const Vector  u = waves(body, 0), w = waves(body, 1);
      const double  h    = 1e-5;
      const Vector  more = sum(u, h, w), less = sum(u, -h, w);
      const double  difference =
        (terms.energy({0., more, more}) - terms.energy({0., less, less})) /
        (2 * h);
      const Vector f = pressure(body, {0., u, u});
      EXPECT_GT(std::abs(difference), 1);
      EXPECT_NEAR(f * w / difference, -1, 1e-7) << obstacles;
    }
}

// The matrix is minus the derivative of the pressure where surfaces are flat.
// On curved ones it leaves out what is smaller by the depth over the radius.
// Each rank has the rows of its own nodes.
TEST_P(ContactTest, MatrixIsTheDerivative)
{
  for (const bool is_flat : {true, false})
    {
      TouchingBlock body(GetParam(),
                         contact(is_flat ? flat_obstacles : curved_obstacles));
      const Vector  u = waves(body, 0), w = waves(body, 1);
      const double  h    = 1e-6;
      const Vector  more = sum(u, h, w), less = sum(u, -h, w);
      Vector        difference = pressure(body, {0., more, more});
      difference -= pressure(body, {0., less, less});
      difference *= -0.5 / h;
      const Vector f    = product(body, {0., u, u}, 1, 0, w);
      const double size = difference.linfty_norm();
      EXPECT_GT(size, 1);
      EXPECT_LT(largest_difference(f, difference),
                (is_flat ? 1e-6 : 0.3) * size);
    }
}

// The same without names on the surface, of which ranks must find the faces of
// ghost cells by themselves.
TEST(ContactWithoutNames, MatrixIsTheDerivative)
{
  SerialMesh mesh = box("2, 1, 1", "3, 2, 2", 0.1);
  mesh.faces.clear();
  mesh.boundaries = {};
  MovingBody   body(mesh, element_text(2) + contact(flat_obstacles));
  const Vector u = waves(body, 0), w = waves(body, 1);
  const Vector difference = minus_derivative_of_pressure(body, u, w);
  EXPECT_LT(largest_difference(product(body, {0., u, u}, 1, 0, w), difference),
            1e-6 * difference.linfty_norm());
}

// The derivatives of friction by the velocity, and by the displacement where
// surfaces are flat: that of the pressure.
TEST_P(ContactTest, DerivativesOfFriction)
{
  TouchingBlock body(GetParam(), contact(flat_obstacles, "p: 0.3, b: 0.5"));
  auto         &terms = body.system.equation().terms;
  const Vector  u = waves(body, 0), v = waves(body, 2), w = waves(body, 1);
  const double  h = 1e-6;

  const Vector faster = sum(v, h, w), slower = sum(v, -h, w);
  Vector       difference = friction(body, {0., u, faster});
  difference -= friction(body, {0., u, slower});
  difference *= -0.5 / h;
  // All of the derivative, but that by the displacement: the difference of two
  // linearizations.
  const auto derivative = [&](const double factor) {
    Vector f = product(body, {0., u, v}, 0, factor, w);
    terms.linearize({0., u, v}, Tangent::consistent);
    terms.subtract_linearized(f, w, 1., factor, Tangent::consistent);
    return f;
  };
  Vector f = derivative(1);
  f -= derivative(0);
  EXPECT_GT(difference.linfty_norm(), 1);
  EXPECT_LT(largest_difference(f, difference), 1e-6 * difference.linfty_norm());

  const Vector more = sum(u, h, w), less = sum(u, -h, w);
  difference = friction(body, {0., more, v});
  difference -= friction(body, {0., less, v});
  difference *= -0.5 / h;
  f = derivative(0);
  EXPECT_GT(difference.linfty_norm(), 1);
  EXPECT_LT(largest_difference(f, difference), 1e-6 * difference.linfty_norm());
  EXPECT_FALSE(terms.is_symmetric(Tangent::consistent));
  EXPECT_TRUE(terms.is_symmetric(Tangent::frozen_rotation));
}

// A block slides on a plane: the friction is mu times the pressure, less by the
// slip velocity, and against the velocity relative to the plane, which moves at
// 2 m/s along y.
TEST_P(ContactTest, FrictionOfAMovingPlane)
{
  TouchingBlock body(GetParam(),
                     contact("floor: plane 0 0 0 0 0 1",
                             "floor: 0.25",
                             "floor: 0; 2 * t; 0.01"));
  const auto   &terms = body.system.equation().terms;
  const Vector  u     = moved_by(body, Tensor<1, 3>({0, 0, 0}));
  const Vector  v     = moved_by(body, Tensor<1, 3>({3, -2, 7}));
  Vector        f;
  body.discretization.initialize_vector(f);
  terms.friction_force(f, {1., u, v});
  Tensor<1, 3> total;
  for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
    total[i % 3] -= f.local_element(i);
  total = dealii::Utilities::MPI::sum(total, f.get_mpi_communicator());
  const Tensor<1, 3> all      = terms.contact_forces({1., u, v})[0].second;
  const double       pressure = all[2];
  const double       speed    = std::hypot(3, -4, 0.1);
  EXPECT_GT(pressure, 0);
  EXPECT_NEAR(total[0], -0.25 * pressure * 3 / speed, 1e-10 * pressure);
  EXPECT_NEAR(total[1], 0.25 * pressure * 4 / speed, 1e-10 * pressure);
  EXPECT_NEAR(total[2], 0, 1e-10 * pressure);
  EXPECT_NEAR(all[0], total[0], 1e-10 * pressure);
}

// What the user may get wrong is named.
TEST(Contact, WrongInput)
{
  const auto refused = [](const std::string &text) {
    return refusal([&] { TouchingBlock body(1, text); });
  };
  const auto expect = [&](const std::string &text, const std::string &part) {
    EXPECT_NE(refused(text).find(part), std::string::npos) << refused(text);
  };
  expect(contact("floor: plain 0 0 0 0 0 1"), "this is no shape");
  expect(contact("floor: plane 0 0 0 0 0"), "another number of numbers");
  expect(contact("floor: plane 0 0 0 0 0 up"), "a word that is no number");
  expect(contact("floor: plane 0 0 0 0 0 0"), "a direction is zero");
  expect(contact("ball: sphere 0 0 0 -1"), "a radius is not positive");
  expect(contact("pole: cylinder 0 0 0 0 0 0 1"), "an axis has no length");
  expect(contact("box: box 0 0 0 1 0 1"), "a box has no thickness");
  expect(contact("a b: sphere 0 0 0 1"), "cannot be an obstacle's name");
  expect(contact("a: sphere 0 0 0 1, a: sphere 0 0 0 2"),
         "two obstacles are called 'a'");
  expect(contact("a: sphere 9 9 9 1", "b: 0.1"),
         "there is no obstacle 'b'; allowed: a");
  expect(contact("", "b: 0.1"), "allowed: none, as Contact/Obstacles is empty");
  expect(contact("a: sphere 9 9 9 1", "a: -0.1"),
         "a number that is not negative");
  expect(contact("a: sphere 9 9 9 1", "", "", "a: 0"), "a number above zero");
  expect(contact("a: sphere 9 9 9 1", "", "a: x; 0; 0"), "expressions in t");
  expect(contact("a: sphere 9 9 9 1") +
           section("Contact", {{"Boundaries", "top"}}),
         "Contact/Boundaries: ");
  expect(contact("a: sphere 9 9 9 1") +
           section("Contact", {{"Boundaries", "x-min: 1"}}),
         "found 'x-min: 1'; allowed: names of boundaries");
  expect(contact("a: sphere 9 9 9 1", "a: 0.1") +
           section("Contact", {{"Slip velocity", 0}}),
         "allowed: a velocity above zero");
}
