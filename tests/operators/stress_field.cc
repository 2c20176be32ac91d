// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Stress at points, recovered stress and its error estimate: where they are
// exact, that rotations do not change them, and that they do not depend on
// ranks or on the choice of cells.

#include <corotet/laws/linear.h>
#include <corotet/material/stress_measures.h>
#include <corotet/operators/stress_field.h>
#include <corotet/time_integration/load_stepping.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <span>
#include <vector>

#include "../all_laws.h"
#include "../body.h"
#include "../two_regions.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
  StressField
  stress_field(const MovingBody                         &body,
               const std::shared_ptr<const MaterialLaw> &law)
  {
    return {body.discretization, body.reference, body.materials, law, nullptr};
  }

  // A box of distorted cells with two materials, stiff for x < 1, soft beyond.
  SerialMesh
  two_materials()
  {
    const SerialMesh straight = box("2, 1, 1", "6, 3, 3");
    SerialMesh       mesh     = box("2, 1, 1", "6, 3, 3", 0.1);
    for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
      if (std::abs(straight.vertices[v][0] - 1) < 1e-10)
        mesh.vertices[v][0] = 1;
    return in_two_regions(mesh, 1, "stiff", "soft");
  }

  const std::string two_laws =
    section("Material",
            {{"Type", "linear"},
             {"Young's modulus", "stiff: 100, soft: 1"},
             {"Poisson's ratio", "stiff: 0.2, soft: 0.4"}});

  // A displacement of degree p in x: (a^p + y, b^p - x / 2, a^(p-1) b + 0.3 z)
  // with linear a and b, and its strain.
  const Tensor<1, 3> grad_a{{1., -0.4, 0.}}, grad_b{{0.2, 0., 0.7}};

  Tensor<1, 3>
  polynomial(const unsigned int p, const Point<3> &x)
  {
    const double a = grad_a * x + 0.3, b = grad_b * x - 0.1;
    return Tensor<1, 3>({std::pow(a, p) + x[1],
                         std::pow(b, p) - 0.5 * x[0],
                         std::pow(a, p - 1) * b + 0.3 * x[2]});
  }

  SymmetricTensor<2, 3>
  strain_of(const unsigned int p, const Point<3> &x)
  {
    const double a = grad_a * x + 0.3, b = grad_b * x - 0.1;
    Tensor<2, 3> gradient;
    gradient[0] = p * std::pow(a, p - 1) * grad_a;
    gradient[1] = p * std::pow(b, p - 1) * grad_b;
    gradient[2] = std::pow(a, p - 1) * grad_b;
    if (p > 1)
      gradient[2] += (p - 1) * std::pow(a, p - 2) * b * grad_a;
    gradient[0][1] += 1;
    gradient[1][0] -= 0.5;
    gradient[2][2] += 0.3;
    return symmetrize(gradient);
  }

  class StressFieldOf : public testing::TestWithParam<Element>
  {};

  const auto elements = testing::Values(Element(1),
                                        Element(2),
                                        Element(3),
                                        Element::quadratic_with_bubbles());

  std::string
  element_name(const testing::TestParamInfo<Element> &info)
  {
    return fmt::format("P{}{}",
                       info.param.degree(),
                       info.param.has_bubbles() ? "WithBubbles" : "");
  }
} // namespace

INSTANTIATE_TEST_SUITE_P(All, StressFieldOf, elements, element_name);

// The stress of a displacement of degree p is of degree p - 1 in each material:
// the raw stress is exact, the recovered one too, on both sides of an interface
// where it jumps, and the estimated error is zero, to round-off of a few 1e-14
// of the stress.
TEST_P(StressFieldOf, IsExactForPolynomials)
{
  const unsigned int p = GetParam().degree();
  const MovingBody   body(two_materials(), element_text(GetParam()) + two_laws);
  const Vector       u =
    body.interpolate([&](const Point<3> &x) { return polynomial(p, x); });
  StressField field = stress_field(body, linear_law());
  EXPECT_EQ(field.law().n_materials(), 2u);
  field.set_displacement(u);
  const auto         nodal = field.at_nodes();
  const unsigned int n     = body.discretization.n_owned_nodes();
  ASSERT_EQ(nodal.stress.size(), n);
  const IsotropicMaterial stiff = isotropic_material(100, 0.2, 1),
                          soft  = isotropic_material(1, 0.4, 1);
  for (unsigned int node = 0; node < n; ++node)
    {
      const Point<3>        x      = body.discretization.node_position(node);
      const auto            strain = strain_of(p, x);
      SymmetricTensor<2, 3> expected;
      if (x[0] < 1 + 1e-10)
        expected += stress(stiff, strain);
      if (x[0] > 1 - 1e-10)
        expected += stress(soft, strain);
      if (std::abs(x[0] - 1) < 1e-10)
        expected /= 2;
      EXPECT_LE((nodal.stress[node] - expected).norm(), 1e-10) << x;
      EXPECT_LE((nodal.strain[node] - strain).norm(), 1e-11) << x;
    }
  EXPECT_GT(field.error().stress_norm, 10.);
  EXPECT_LE(field.error().energy_norm, 1e-12 * field.error().stress_norm);
  // The square of the norm is twice the elastic energy.
  EXPECT_NEAR(std::pow(field.error().stress_norm, 2),
              2 * body.elasticity.state(u).energy,
              1e-12 * std::pow(field.error().stress_norm, 2));
}

// Rotating the whole body rotates its stress, sigma -> Q sigma Q^T, for any
// placement of rotations; the estimated error does not change.
TEST(StressField, TurnsWithTheBody)
{
  const Tensor<2, 3> Q = rotation_about(Tensor<1, 3>({0.3, -1., 2.}), 2.1);
  const MovingBody   body(two_materials(), element_text(2) + two_laws);
  const auto         deformed = [](const Point<3> &x) {
    return Point<3>(x + 0.2 * polynomial(2, x));
  };
  const Vector u =
    body.interpolate([&](const Point<3> &x) { return deformed(x) - x; });
  const Vector v = body.interpolate(
    [&](const Point<3> &x) { return Q * Tensor<1, 3>(deformed(x)) - x; });
  for (const NamedLaw &law : nonlinear_laws())
    {
      StressField field = stress_field(body, law.law);
      field.set_displacement(u);
      const auto   before = field.at_nodes();
      const double error  = field.error().energy_norm,
                   size   = field.error().stress_norm;
      EXPECT_GT(error, 1e-4 * size);
      field.set_displacement(v);
      const auto after = field.at_nodes();
      EXPECT_NEAR(field.error().energy_norm, error, 1e-12 * size);
      for (unsigned int node = 0; node < before.stress.size(); ++node)
        EXPECT_LE((after.stress[node] -
                   symmetrize(Q * Tensor<2, 3>(before.stress[node]) *
                              transpose(Q)))
                    .norm(),
                  1e-11);
    }
}

// The recovered stress does not depend on the orientation of the body at rest
// either: where patches are small, the choice of fitted polynomials does not
// depend on the axes.
TEST(StressField, DoesNotDependOnTheAxes)
{
  const SerialMesh mesh = box("1, 1, 1", "2, 2, 1", 0.2);
  // Invariants of the field for a body rotated by Q: the sum of squares of the
  // nodes' stresses, and the error.
  const auto squares_and_error = [&](const Tensor<2, 3> &Q,
                                     const Element      &element) {
    SerialMesh turned = mesh;
    for (Point<3> &x : turned.vertices)
      x = Point<3>(Q * Tensor<1, 3>(x));
    const MovingBody body(turned, element_text(element) + material_text(1.));
    const Vector     u     = body.interpolate([&](const Point<3> &x) {
      const Point<3> at(transpose(Q) * Tensor<1, 3>(x));
      return Q * polynomial(5, at);
    });
    StressField      field = stress_field(body, linear_law());
    field.set_displacement(u);
    double sum = 0;
    for (const SymmetricTensor<2, 3> &sigma : field.at_nodes().stress)
      sum += sigma * sigma;
    return std::array<double, 2>{
      {dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD),
       field.error().energy_norm}};
  };
  Tensor<2, 3> identity;
  for (unsigned int a = 0; a < 3; ++a)
    identity[a][a] = 1;
  for (const Element element : {Element(1), Element(2), Element(3)})
    {
      const auto expected = squares_and_error(identity, element);
      for (const double angle : {0.3, 1.1, 2.1})
        {
          const auto found = squares_and_error(
            rotation_about(Tensor<1, 3>({0.3, -1., 2.}), angle), element);
          for (unsigned int i = 0; i < 2; ++i)
            EXPECT_NEAR(found[i] / expected[i], 1, 1e-10)
              << "degree " << element.degree() << ", " << i;
        }
    }
}

// For degree 1 the stress is constant in cells, so its von Mises equivalent is
// that of the cell results.
TEST(StressField, AgreesWithTheCentres)
{
  const MovingBody body(two_materials(), element_text(1) + two_laws);
  const Vector     u =
    body.interpolate([](const Point<3> &x) { return polynomial(2, x); });
  StressField field = stress_field(body, linear_law());
  field.set_displacement(u);
  const auto expected = body.elasticity.cell_results(u).von_mises;
  for (unsigned int c = 0; c < body.discretization.n_owned_cells(); ++c)
    EXPECT_NEAR(von_mises(field.at_points()[c]),
                expected[c],
                1e-13 * (1 + expected[c]));
}

// Every rank also computes the whole body by itself: stress at nodes and error
// are the same, to round-off.
TEST(StressField, RanksMakeNoDifference)
{
  Log                    log(MPI_COMM_SELF, true);
  const MovingBody       body(two_materials(), element_text(3) + two_laws);
  const Mesh             mesh(two_materials(), 0, 1., MPI_COMM_SELF, log);
  const Discretization   discretization(mesh, 3);
  const ReferenceElement reference(3);
  Vector                 w;
  discretization.initialize_vector(w);
  for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
    {
      const auto value = polynomial(5, discretization.node_position(n));
      for (unsigned int a = 0; a < 3; ++a)
        w.local_element(3 * n + a) = value[a];
    }
  w.update_ghost_values();
  const auto  materials = body.materials;
  StressField alone(
    discretization, reference, materials, linear_law(), nullptr);
  StressField together = stress_field(body, linear_law());
  alone.set_displacement(w);
  const Vector u =
    body.interpolate([](const Point<3> &x) { return polynomial(5, x); });
  together.set_displacement(u);
  const double size = alone.error().stress_norm;
  EXPECT_NEAR(together.error().stress_norm, size, 1e-13 * size);
  EXPECT_NEAR(together.error().energy_norm,
              alone.error().energy_norm,
              1e-12 * size);

  const auto key = [](const Point<3> &x) {
    std::array<long, 3> result;
    for (unsigned int a = 0; a < 3; ++a)
      result[a] = std::lround(1e6 * x[a]);
    return result;
  };
  std::map<std::array<long, 3>, SymmetricTensor<2, 3>> expected;
  const auto all = alone.at_nodes(), own = together.at_nodes();
  for (unsigned int n = 0; n < all.stress.size(); ++n)
    expected[key(discretization.node_position(n))] = all.stress[n];
  double largest = 0;
  for (const auto &[x, sigma] : expected)
    largest = std::max(largest, sigma.norm());
  for (unsigned int n = 0; n < own.stress.size(); ++n)
    EXPECT_LE((own.stress[n] -
               expected.at(key(body.discretization.node_position(n))))
                .norm(),
              1e-12 * largest);
}

// A bar is clamped at one end and pulled at the other. Where its free sides
// meet the clamped one the exact stress is infinite: the cell with the largest
// error per volume is there, with ten times the error of most cells.
TEST(StressField, FindsSingularEdges)
{
  MovingBody   body(box("2, 1, 1", "8, 4, 4"),
                  element_text(2) + material_type("linear") + fixed("x-min") +
                    tractions("x-max: 1; 0; 0"));
  LoadStepping load_stepping;
  load_stepping.step(body.system, {0., 1., 1.}, body.state);
  body.system.equation().set_state(body.state);
  StressField field = stress_field(body, linear_law());
  field.set_displacement(body.system.equation().displacement());
  const auto  &of_cells = field.error().of_cells;
  double       largest  = 0;
  unsigned int n_large  = 0;
  Point<3>     centre;
  const auto   density = [&](const unsigned int c) {
    return of_cells[c] / std::sqrt(body.discretization.geometry(c).volume);
  };
  for (unsigned int c = 0; c < of_cells.size(); ++c)
    if (density(c) > largest)
      {
        largest = density(c);
        centre  = Point<3>();
        for (unsigned int k = 0; k < 4; ++k)
          centre += 0.25 * body.discretization.node_position(
                             body.discretization.cell_nodes(c)[k]);
      }
  const double overall = dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
  if (largest == overall)
    {
      EXPECT_LT(centre[0], 0.25) << centre;
      EXPECT_LT(std::min({centre[1], 1 - centre[1], centre[2], 1 - centre[2]}),
                0.25)
        << centre;
    }
  for (unsigned int c = 0; c < of_cells.size(); ++c)
    n_large += density(c) > 0.1 * overall ? 1 : 0;
  EXPECT_LT(dealii::Utilities::MPI::sum(n_large, MPI_COMM_WORLD),
            body.discretization.n_global_cells() / 2);
}

// Stress that is recovered in some cells of one or more ranks is that of a
// recovery in all cells, to the last bit, as the sums are the same; also for
// other displacements and cells. The displacement has no symmetry.
TEST(StressField, RecoveredInSomeCells)
{
  for (const unsigned int degree : {1, 2, 3})
    {
      MovingBody  body(two_materials(), element_text(degree) + two_laws);
      const auto &disc  = body.discretization;
      StressField whole = stress_field(body, linear_law()),
                  parts = stress_field(body, linear_law());
      const auto &rule  = body.reference.load_rule;
      Vector      u;
      disc.initialize_vector(u);
      for (const unsigned int run : {0, 1, 2})
        {
          for (unsigned int n = 0; n < disc.n_owned_nodes(); ++n)
            for (unsigned int a = 0; a < 3; ++a)
              u.local_element(3 * n + a) =
                std::sin((1. + a + run) * disc.node_position(n)[a] +
                         disc.node_position(n)[(a + 1) % 3]);
          u.update_ghost_values();
          whole.set_displacement(u);
          parts.set_displacement(u);
          whole.recover();
          // Cells are recovered twice, then others; in the end none on rank 0.
          std::vector<unsigned int> cells;
          for (unsigned int c = run / 2; c < disc.n_owned_cells(); c += 40)
            cells.push_back(c);
          for (unsigned int k = 0; k < 2; ++k)
            {
              parts.recover(cells);
              for (const unsigned int c : cells)
                for (unsigned int q = 0; q < rule.weights.size(); ++q)
                  {
                    const std::span<const double> values{
                      &rule.values(q, 0), body.reference.n_nodes};
                    EXPECT_EQ(parts.recovered(c, values),
                              whole.recovered(c, values))
                      << degree << ' ' << run << ' ' << c;
                  }
              if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
                cells.clear();
            }
          u.zero_out_ghost_values();
        }
      // After parts, the whole field is recovered.
      u.update_ghost_values();
      parts.recover();
      const std::span<const double> values{&rule.values(0, 0),
                                           body.reference.n_nodes};
      for (unsigned int c = 0; c < disc.n_owned_cells(); ++c)
        ASSERT_EQ(parts.recovered(c, values), whole.recovered(c, values));
    }
}
