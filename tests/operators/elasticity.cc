// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Internal force, tangent and assembled matrix of linear and corotational
// elasticity: rigid motions, consistency with one another, energy.

#include <corotet/laws/corotational.h>
#include <corotet/material/polar_decomposition.h>
#include <corotet/operators/effective_operator.h>

#include <gtest/gtest.h>

#include "../body.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  std::string
  law_text(const unsigned int degree,
           const std::string &type,
           const std::string &mass = "consistent")
  {
    return element_text(degree, mass) + material_type(type) +
           material_text(1e3, 0.4, 2);
  }

  // A displacement without any symmetry, with rotations up to a right angle.
  Tensor<1, 3>
  bend(const Point<3> &x)
  {
    return Tensor<1, 3>({std::sin(2 * x[0] + x[1]) - x[0],
                         0.3 * std::cos(3 * x[2]) + 0.5 * x[0] * x[0],
                         std::sin(1.5 * x[0] * x[1])});
  }
} // namespace

class ElasticityTest : public testing::TestWithParam<unsigned int>
{};

// A rigid motion causes no strain. The forces are compared with those of linear
// elasticity for the same displacement, which are quadratic in the angle. The
// strain of corotational elasticity has the round-off of F, some 1e-16, at any
// angle: so small angles are compared with the force at an angle of 0.1.
TEST_P(ElasticityTest, RigidMotionGivesNoForce)
{
  const SerialMesh mesh = box("1, 2, 1", "2, 3, 2", 0.2);
  MovingBody       linear(mesh, law_text(GetParam(), "linear"));
  MovingBody       corotational(mesh, law_text(GetParam(), "corotational"));
  const std::vector<Tensor<1, 3>> axes{Tensor<1, 3>({1., 0., 0.}),
                                       Tensor<1, 3>({0.3, -1., 2.}),
                                       Tensor<1, 3>({-1., 1., 1.})};
  for (const Tensor<1, 3> &axis : axes)
    {
      double reference = 0, largest = 0;
      for (const double angle :
           {0.1, 1e-8, 1e-3, 0.01, 1., 2.5, dealii::numbers::PI, 6.})
        {
          const Tensor<2, 3> R = rotation_about(axis, angle);
          const Vector       u = linear.interpolate([&](const Point<3> &x) {
            return R * x - x + Tensor<1, 3>({0.5, -0.3, 0.2});
          });
          Vector             f(linear.state.u);
          linear.elasticity.internal_force(f, u);
          if (angle >= 0.1)
            reference = f.l2_norm();
          EXPECT_GT(reference, 1.);

          corotational.state.u.copy_locally_owned_data_from(u);
          const auto &forces =
            corotational.system.equation().evaluate(corotational.state, 0., 1.);
          largest = std::max(largest, forces.internal.l2_norm() / reference);
          EXPECT_LE(forces.internal.l2_norm(), 1e-12 * reference) << angle;
          const Elasticity &elasticity = corotational.elasticity;
          EXPECT_LE(elasticity.state(u).energy, 1e-24 * reference) << angle;
          for (const double found : elasticity.cell_results(u).rotation_angle)
            EXPECT_NEAR(found,
                        std::min(angle, 2 * dealii::numbers::PI - angle),
                        1e-14);
          for (const double det_F : elasticity.cell_results(u).det_F)
            EXPECT_NEAR(det_F, 1, 1e-14);
        }
      report("largest force, relative to linear elasticity", largest);
    }
}

// The matrix, assembled from blocks with rotated gradients, equals the tangent
// as the cell kernel applies it; also with mass, and in rows that ranks share.
TEST_P(ElasticityTest, MatrixEqualsTangent)
{
  for (const std::string mass : {"consistent", "diagonal scaling"})
    {
      MovingBody body(box("1, 2, 1", "2, 3, 2", 0.2),
                      law_text(GetParam(), "corotational", mass));
      body.state.u.copy_locally_owned_data_from(body.interpolate(bend));
      body.system.equation().evaluate(body.state, 0., 1.);
      const std::vector<unsigned char> free(
        std::size_t(3) * body.discretization.n_local_nodes(), 0);
      EffectiveOperator A(body.discretization,
                          body.elasticity,
                          body.mass,
                          free);
      const double      c_K = 0.7, c_M = 500;
      A.update(c_K, c_M);

      const Vector v = body.interpolate([](const Point<3> &x) {
        return Tensor<1, 3>({std::sin(7 * x[0]), x[1] * x[2], x[0] - x[2]});
      });
      Vector       owned(body.state.u), product(owned), Kv(owned), Mv(owned);
      owned.copy_locally_owned_data_from(v);
      A.vmult(product, owned);
      body.elasticity.apply_tangent(Kv, v);
      body.mass.apply(Mv, v);
      Kv *= c_K;
      Kv.add(c_M, Mv);
      EXPECT_LE(largest_difference(product, Kv), 1e-13 * Kv.linfty_norm());
    }
}

// Prescribed unknowns are decoupled in rows and columns, on every rank.
TEST_P(ElasticityTest, PrescribedUnknownsAreDecoupled)
{
  MovingBody        body(box("1, 1, 1", "2, 2, 2"),
                  law_text(GetParam(), "linear") +
                    displacements("x-min: 0; free; 0"));
  const auto       &motion = body.motion;
  EffectiveOperator A(body.discretization,
                      body.elasticity,
                      body.mass,
                      motion.is_prescribed());
  A.update(1., 0.);
  Vector ones(body.state.u), product(ones), fixed(ones);
  for (const unsigned int i : motion.unknowns())
    ones.local_element(i) = 1;
  A.vmult(product, ones);
  fixed = product;
  motion.set_zero(product);
  EXPECT_EQ(product.linfty_norm(), 0.);
  for (const unsigned int i : motion.unknowns())
    EXPECT_GT(fixed.local_element(i), 0.);
}

// Linear elasticity: f = K u, the energy is u f / 2, and K is symmetric.
TEST_P(ElasticityTest, LinearEnergy)
{
  MovingBody   body(box("1, 2, 1", "2, 3, 2", 0.2),
                  law_text(GetParam(), "linear"));
  const Vector u = body.interpolate(bend);
  const Vector v = body.interpolate([](const Point<3> &x) { return 2. * x; });
  Vector       f(body.state.u), Ku(f), Kv(f);
  const Elasticity &elasticity = body.elasticity;
  elasticity.internal_force(f, u);
  elasticity.apply_tangent(Ku, u);
  elasticity.apply_tangent(Kv, v);
  EXPECT_LE(largest_difference(f, Ku), 1e-13 * f.linfty_norm());
  const double energy = elasticity.state(u).energy;
  EXPECT_NEAR(energy, 0.5 * (u * f), 1e-13 * energy);
  EXPECT_NEAR(u * Kv, v * Ku, 1e-13 * u.l2_norm() * Kv.l2_norm());
}

// With degree 1, R is constant in the cell and the corotational force is the
// gradient of the energy (both placements of R coincide): compared with central
// differences, of error O(h^2) and round-off 1e-16 / h.
TEST(Elasticity, LinearElementsHaveAnEnergy)
{
  MovingBody body(box("1, 2, 1", "1, 2, 1", 0.), law_text(1, "corotational"));
  Vector     u = body.interpolate(bend);
  Vector     f(body.state.u);
  body.state.u.copy_locally_owned_data_from(u);
  f = body.system.equation().evaluate(body.state, 0., 1.).internal;
  const Vector direction = body.interpolate([](const Point<3> &x) {
    return Tensor<1, 3>({x[1], std::cos(3 * x[0]), x[2] * x[0]});
  });
  const double h         = 1e-5;
  double       energy[2];
  for (const int side : {0, 1})
    {
      body.state.u.copy_locally_owned_data_from(u);
      Vector owned(body.state.u);
      owned.copy_locally_owned_data_from(direction);
      body.state.u.add(side == 0 ? -h : h, owned);
      body.system.equation().evaluate(body.state, 0., 1.);
      energy[side] =
        body.elasticity.state(body.system.equation().displacement()).energy;
    }
  Vector owned(body.state.u);
  owned.copy_locally_owned_data_from(direction);
  const double work = f * owned;
  EXPECT_NEAR((energy[1] - energy[0]) / (2 * h), work, 1e-7 * std::abs(work));
}

// det F of a reflection is negative in every cell.
TEST_P(ElasticityTest, InvertedCellsAreCounted)
{
  MovingBody   body(box("1, 1, 1", "1, 1, 1"),
                  law_text(GetParam(), "corotational"));
  const Vector u = body.interpolate(
    [](const Point<3> &x) { return Tensor<1, 3>({-2 * x[0], 0., 0.}); });
  const ElasticState state = body.elasticity.state(u);
  EXPECT_EQ(state.inverted_cells, 5u);
  EXPECT_NEAR(state.min_det_F, -1, 1e-13);
}

// A body pressed flat: every cell is collapsed to a plane.
TEST_P(ElasticityTest, DegenerateCellsAreCounted)
{
  MovingBody body(box("1, 1, 1", "1, 1, 1"),
                  law_text(GetParam(), "corotational"));
  body.state.u.copy_locally_owned_data_from(body.interpolate(
    [](const Point<3> &x) { return Tensor<1, 3>({0., 0., -x[2]}); }));
  body.system.equation().evaluate(body.state, 0., 1.);
  const ElasticState state =
    body.elasticity.state(body.system.equation().displacement());
  EXPECT_EQ(state.degenerate_cells, 5u);
  // A flat cell is not counted as inverted.
  EXPECT_EQ(state.inverted_cells, 0u);
}

// Rotations computed for preconditioners do not change what the law has counted
// at its points while it computed the force.
TEST_P(ElasticityTest, CountsAreThoseOfTheForce)
{
  for (const std::string type : {"corotational", "Saint Venant-Kirchhoff"})
    {
      MovingBody body(box("1, 1, 1", "1, 1, 1"),
                      law_text(GetParam(), type) +
                        (type == "corotational" ?
                           rotation_at("quadrature points") :
                           ""));
      body.state.u.copy_locally_owned_data_from(body.interpolate(
        [](const Point<3> &x) { return Tensor<1, 3>({0., 0., -x[2]}); }));
      EquationOfMotion &equation = body.system.equation();
      equation.evaluate(body.state, 0., 1.);
      const ElasticState before =
        body.elasticity.state(equation.displacement());
      EXPECT_EQ(before.degenerate_cells, type == "corotational" ? 5u : 0u);
      equation.set_state(body.state);
      const ElasticState after = body.elasticity.state(equation.displacement());
      EXPECT_EQ(after.degenerate_cells, before.degenerate_cells);
      EXPECT_EQ(after.robust_rotations, before.robust_rotations);
    }
}

// The sweep of explicit dynamics gives the same as its parts one after another,
// to the round-off of sums in another order.
TEST_P(ElasticityTest, ExplicitStep)
{
  MovingBody body(box("1, 2, 1", "2, 3, 2", 0.2),
                  law_text(GetParam(),
                           "corotational",
                           GetParam() == 1 ? "row sum" : "diagonal scaling"));
  Vector     u(body.state.u), v(u), external(u), inverse_mass(u);
  u.copy_locally_owned_data_from(body.interpolate(bend));
  const double dt = 0.01;
  for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
    {
      v.local_element(i)            = std::sin(i);
      external.local_element(i)     = std::cos(i);
      inverse_mass.local_element(i) = 1 / body.mass.diagonal().local_element(i);
    }
  body.state.u  = u;
  const auto &f = body.system.equation().evaluate(body.state, 0., 1.).internal;
  Vector      expected_v(v), expected_u(u);
  for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
    {
      expected_v.local_element(i) +=
        dt * inverse_mass.local_element(i) *
        (external.local_element(i) - f.local_element(i));
      expected_u.local_element(i) += dt * expected_v.local_element(i);
    }

  Elasticity elasticity(body.discretization,
                        body.reference,
                        body.materials,
                        corotational_law(Rotation::cell_centre));
  elasticity.explicit_step(u, v, external, inverse_mass, dt);
  EXPECT_LE(largest_difference(v, expected_v),
            1e-13 * expected_v.linfty_norm());
  EXPECT_LE(largest_difference(u, expected_u),
            1e-13 * expected_u.linfty_norm());
}

INSTANTIATE_TEST_SUITE_P(Degrees, ElasticityTest, testing::Values(1u, 2u, 3u));
