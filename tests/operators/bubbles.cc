// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The quadratic element with bubbles and its quadrature at the nodes: tables of
// the kernel, forces, energies and tangents, zero-energy modes, the order of
// eigenvalues.

#include <corotet/discretization/finite_element.h>
#include <corotet/laws/linear.h>
#include <corotet/operators/bubbles.h>
#include <corotet/operators/effective_operator.h>
#include <corotet/operators/surface.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/solver_cg.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "random_states.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  constexpr Element with_bubbles = Element::quadratic_with_bubbles();

  // Steps and weights of central differences of fourth order.
  const std::vector<std::pair<double, double>> differences{{-2, 1. / 12},
                                                           {-1, -2. / 3},
                                                           {1, 2. / 3},
                                                           {2, -1. / 12}};

  class BubblesNonlinear : public testing::TestWithParam<unsigned int>
  {
  protected:
    NamedLaw   law = nonlinear_laws()[GetParam()];
    MovingBody body{box("1, 2, 1", "2, 2, 2", 0.2),
                    case_text(with_bubbles, law)};
  };
} // namespace

// Points, weights and derivatives in the compiler's tables are deal.II's.
TEST(Bubbles, TablesAreThoseOfTheElement)
{
  const ReferenceElement reference(Element::quadratic_with_bubbles());
  const auto            &rule = reference.stiffness_rule;
  ASSERT_EQ(rule.points.size(), unsigned(bubbles::n_points));
  for (int q = 0; q < bubbles::n_points; ++q)
    {
      const auto    &l = bubbles::stiffness_rule[q].lambda;
      const Point<3> x(l[1], l[2], l[3]);
      EXPECT_NEAR(l[0] + l[1] + l[2] + l[3], 1, 1e-15);
      unsigned int same = 0;
      while (same < rule.points.size() && rule.points[same].distance(x) > 1e-14)
        ++same;
      ASSERT_LT(same, rule.points.size()) << "no point at " << x;
      EXPECT_NEAR(bubbles::stiffness_rule[q].weight, rule.weights[same], 1e-15);
      // The round-off of derivatives of O(10).
      for (int i = 0; i < bubbles::n_nodes; ++i)
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(bubbles::point_derivatives[q][i][k],
                      rule.gradients[same][i][k],
                      1e-13);
    }
  for (int i = 0; i < bubbles::n_nodes; ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(bubbles::centre_derivatives[i][k],
                  reference.centre.gradients(0, i, k),
                  1e-14);
}

// The element contains quadratic fields, and the rule is exact for them: the
// energy is that of the element without bubbles. In a linear field all cells
// have the same stress, and nodes inside have no force.
TEST(Bubbles, PatchTest)
{
  const SerialMesh  mesh   = box("1, 2, 1", "2, 4, 2", 0.2);
  const std::string linear = material_type("linear") + material_text(1e3, 0.4);
  MovingBody        body(mesh, element_text(with_bubbles) + linear),
    plain(mesh, element_text(2) + linear);
  const auto quadratic = [](const Point<3> &x) {
    return Tensor<1, 3>({x[0] * x[1] - x[2], x[1] * x[1], x[2] * x[0] + x[1]});
  };
  const double energy =
    body.elasticity.state(body.interpolate(quadratic)).energy;
  EXPECT_NEAR(plain.elasticity.state(plain.interpolate(quadratic)).energy,
              energy,
              1e-13 * energy);

  const Vector u = body.interpolate([](const Point<3> &x) {
    return Tensor<1, 3>({x[0] + 0.3 * x[1], x[2], 0.5 * x[0]});
  });
  Vector       f(body.state.u);
  body.elasticity.internal_force(f, u);
  const double size = f.linfty_norm();
  EXPECT_GT(size, 1.);
  for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
    {
      const Point<3> x = body.discretization.node_position(n);
      if (x[0] > 1e-10 && x[0] < 1 - 1e-10 && x[1] > 1e-10 &&
          x[1] < 2 - 1e-10 && x[2] > 1e-10 && x[2] < 1 - 1e-10)
        {
          for (unsigned int a = 0; a < 3; ++a)
            EXPECT_LE(std::abs(f.local_element(3 * n + a)), 1e-13 * size);
        }
    }
  // The strain is xx = 1, xy = 0.15, yz = 0.5, xz = 0.25.
  const auto   stresses = body.elasticity.cell_results(u).von_mises;
  const double mu       = 1e3 / 2.8;
  const double expected =
    std::sqrt(std::pow(2 * mu, 2) +
              3 * std::pow(2 * mu, 2) * (0.15 * 0.15 + 0.25 + 0.0625));
  for (const double stress : stresses)
    EXPECT_NEAR(stress, expected, 1e-12 * expected);
}

// Rigid motions cause no strain: forces are as small as the round-off of F,
// relative to those of linear elasticity, which takes the rotation for strain.
TEST_P(BubblesNonlinear, RigidMotionGivesNoForce)
{
  Elasticity elasticity = elasticity_of(body, law.law);
  Elasticity linear     = elasticity_of(body, linear_law());
  for (const double angle : {0.1, 1., 2.5, dealii::numbers::PI, 6.})
    {
      const Tensor<2, 3> R =
        rotation_about(Tensor<1, 3>({0.3, -1., 2.}), angle);
      const Vector u         = body.interpolate([&](const Point<3> &x) {
        return R * x - x + Tensor<1, 3>({0.5, -0.3, 0.2});
      });
      const double reference = norm(force(linear, u));
      EXPECT_GT(reference, 1.);
      EXPECT_LE(norm(force(elasticity, u)), 1e-12 * reference);
      EXPECT_LE(elasticity.state(u).energy, 1e-24 * reference);
      // internal_force() alone gives no force either, with the rotations
      // computed before.
      Vector f(body.state.u);
      elasticity.internal_force(f, u);
      EXPECT_LE(norm(f), 1e-12 * reference);
    }
}

// This test is like that in rotations.cc for the other elements.
TEST_P(BubblesNonlinear, ForceIsTheGradientOfTheEnergy)
{
  Elasticity   elasticity = elasticity_of(body, law.law);
  const Vector v          = random_direction(body);
  double       largest    = 0;
  for (const RandomState &state : states)
    {
      const Vector x = displacement(body, state, 2., 3);
      const double h = 2e-4;
      if (!has_state(elasticity, x))
        continue;
      double slope = 0;
      for (const auto &[step, weight] : differences)
        {
          const Vector u = moved(x, step * h, v);
          force(elasticity, u);
          slope += weight / h * elasticity.state(u).energy;
        }
      const double power = force(elasticity, x) * v;
      largest = std::max(largest, std::abs(power - slope) / std::abs(slope));
    }
  report("largest relative difference", largest);
  EXPECT_GT(largest, 0) << "no state was looked at";
  if (!law.law->has_energy(2))
    EXPECT_GE(largest, 1e-4) << "a law without an energy is expected here";
  else
    EXPECT_LE(largest, 1e-8);
}

TEST_P(BubblesNonlinear, ConsistentTangentIsTheDerivative)
{
  Elasticity   elasticity = elasticity_of(body, law.law);
  const Vector v          = random_direction(body);
  double       largest    = 0;
  for (const RandomState &state : states)
    {
      const Vector x = displacement(body, state, 1.5, 7);
      if (!has_state(elasticity, x))
        continue;
      const double h = 2e-4;
      Vector       difference(body.state.u);
      for (const auto &[step, weight] : differences)
        difference.add(weight / h, force(elasticity, moved(x, step * h, v)));
      force(elasticity, x);
      EXPECT_EQ(elasticity.linearize(x, Tangent::consistent), 0u);
      Vector product(difference);
      elasticity.apply_linearization(product, v, 1., 0., nullptr, nullptr);
      largest = std::max(largest,
                         largest_difference(product, difference) /
                           difference.linfty_norm());
    }
  report("largest relative difference", largest);
  EXPECT_GT(largest, 0) << "no state was looked at";
  EXPECT_LE(largest, 1e-6);
}

// The sweep of explicit dynamics gives the same as its parts one after another,
// to the round-off of sums in another order.
TEST_P(BubblesNonlinear, ExplicitStep)
{
  Elasticity elasticity = elasticity_of(body, law.law);
  Vector     u(body.state.u), v(u), external(u), inverse_mass(u);
  Vector     start = displacement(body, states[1], 1., 3);
  if (!has_state(elasticity, start))
    start = displacement(body, calm, 1., 3);
  ASSERT_TRUE(has_state(elasticity, start));
  u.copy_locally_owned_data_from(start);
  for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
    {
      v.local_element(i)            = std::sin(i);
      external.local_element(i)     = std::cos(i);
      inverse_mass.local_element(i) = 1 / body.mass.diagonal().local_element(i);
    }
  const double dt = 1e-3;
  const Vector f  = force(elasticity, moved(u, 0., v));
  Vector       expected_v(v), expected_u(u);
  for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
    {
      expected_v.local_element(i) +=
        dt * inverse_mass.local_element(i) *
        (external.local_element(i) - f.local_element(i));
      expected_u.local_element(i) += dt * expected_v.local_element(i);
    }
  elasticity.explicit_step(u, v, external, inverse_mass, dt);
  EXPECT_LE(largest_difference(v, expected_v),
            1e-13 * expected_v.linfty_norm());
  EXPECT_LE(largest_difference(u, expected_u),
            1e-13 * expected_u.linfty_norm());
}

INSTANTIATE_TEST_SUITE_P(Placements,
                         BubblesNonlinear,
                         testing::Range<unsigned int>(0,
                                                      nonlinear_laws().size()));

// The volume of the displaced body, computed from its surface, is the integral
// of det F for any bubbles: det F has degree 9, and the rule is exact for it.
TEST(Bubbles, DisplacedVolume)
{
  MovingBody   body(box("1, 2, 1", "2, 2, 2", 0.2),
                  case_text(with_bubbles, nonlinear_laws()[0]));
  const Vector u = displacement(body, states[0], 2., 5);
  const dealii::QWitherdenVincentSimplex<3> rule(5);
  const auto &fe     = finite_element(body.discretization.element());
  double      volume = 0;
  for (unsigned int c = 0; c < body.discretization.n_owned_cells(); ++c)
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        Tensor<2, 3> F;
        const auto   nodes = body.discretization.cell_nodes(c);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          for (unsigned int a = 0; a < 3; ++a)
            F[a] += (body.discretization.node_position(nodes[i])[a] +
                     u.local_element(3 * nodes[i] + a)) *
                    fe.shape_grad(i, rule.point(q));
        volume += rule.weight(q) * determinant(F);
      }
  volume = dealii::Utilities::MPI::sum(volume, MPI_COMM_WORLD);
  EXPECT_GT(std::abs(volume - 2), 1e-3);
  EXPECT_NEAR(displaced_volume(body.discretization, body.reference, u),
              volume,
              1e-12);
}

// The rule leaves no mode without energy: the kernel of a cell's stiffness
// consists of the six rigid motions.
TEST(Bubbles, NoZeroEnergyModes)
{
  const ReferenceElement           reference(Element::quadratic_with_bubbles());
  const unsigned int               n = 3 * reference.n_nodes;
  dealii::LAPACKFullMatrix<double> K(n, n);
  for (unsigned int i = 0; i < reference.n_nodes; ++i)
    for (unsigned int j = 0; j < reference.n_nodes; ++j)
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          {
            const double *D = &reference.gradient_products(i, j, 0);
            K(3 * i + a, 3 * j + b) =
              D[3 * b + a] + (a == b ? D[0] + D[4] + D[8] : 0.);
          }
  K.compute_eigenvalues();
  std::vector<double> eigenvalues;
  for (unsigned int i = 0; i < n; ++i)
    eigenvalues.push_back(K.eigenvalue(i).real());
  std::sort(eigenvalues.begin(), eigenvalues.end());
  EXPECT_LE(std::abs(eigenvalues[5]), 1e-13 * eigenvalues.back());
  report("smallest over largest eigenvalue of a cell",
         eigenvalues[6] / eigenvalues.back());
  EXPECT_GE(eigenvalues[6], 1e-3 * eigenvalues.back());
}

namespace
{
  // The relative error of the lowest eigenvalue of K v = lambda M v, from
  // inverse iteration, for a bar of length 1 held at one end that slides along
  // its sides, without Poisson's effect. Exact: E / rho (pi / 2)^2.
  double
  eigenvalue_error(const std::string &mass, const unsigned int n)
  {
    MovingBody        body(box("1, 0.5, 0.5",
                        fmt::format("{}, {}, {}", 2 * n, n, n),
                        0.1),
                    element_text(2, mass) + material_type("linear") +
                      material_text(1, 0, 1) + sliding_along_x());
    EffectiveOperator A(body.discretization,
                        body.elasticity,
                        body.mass,
                        body.motion.is_prescribed());
    A.update(1., 0.);
    Vector inverse(body.state.u), v(inverse), Mv(inverse), x(inverse);
    for (unsigned int i = 0; i < inverse.locally_owned_size(); ++i)
      inverse.local_element(i) = 1 / A.diagonal().local_element(i);
    const dealii::DiagonalMatrix<Vector> jacobi(inverse);
    v.copy_locally_owned_data_from(body.interpolate([](const Point<3> &p) {
      return Tensor<1, 3>({std::sin(dealii::numbers::PI / 2 * p[0]), 0., 0.});
    }));
    // The next eigenvalue is nine times as large, so each iteration divides the
    // error by 81.
    double lambda = 0;
    for (unsigned int k = 0; k < 4; ++k)
      {
        Vector ghosted(v);
        ghosted.update_ghost_values();
        body.mass.apply(Mv, ghosted);
        body.motion.set_zero(Mv);
        dealii::SolverControl    control(5000, 1e-12 * Mv.l2_norm());
        dealii::SolverCG<Vector> cg(control);
        cg.solve(A, x, Mv, jacobi);
        // The Rayleigh quotient x K x / x M x, with K x = M v.
        ghosted.zero_out_ghost_values();
        ghosted.copy_locally_owned_data_from(x);
        ghosted.update_ghost_values();
        const double stiffness = x * Mv;
        body.mass.apply(Mv, ghosted);
        lambda = stiffness / (x * Mv);
        v.equ(1 / x.l2_norm(), x);
      }
    const double exact = std::pow(dealii::numbers::PI / 2, 2);
    return lambda / exact - 1;
  }
} // namespace

// Eigenvalues have order 2p = 4 with the consistent mass, and with that of
// quadrature at the nodes; with diagonal scaling the order is lower.
TEST(Bubbles, OrderOfEigenvalues)
{
  for (const auto &[mass, least] :
       {std::pair<std::string, double>{"consistent", 3.8},
        {"nodal quadrature", 3.8},
        {"diagonal scaling", 1.8}})
    {
      double last = 0, order = 0;
      for (const unsigned int n : {1, 2, 4})
        {
          const double error = eigenvalue_error(mass, n);
          report(fmt::format("error of the eigenvalue, {}, n = {}", mass, n),
                 error);
          order = std::log2(std::abs(last / error));
          if (n > 1)
            report("its order", order);
          last = error;
        }
      EXPECT_GE(order, least) << mass;
      if (mass == "diagonal scaling")
        {
          EXPECT_LE(order, 2.2);
        }
    }
}
