// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Mean dilatation at the vertices, in a body of two materials.

#include <corotet/operators/error_norms.h>
#include <corotet/operators/tangent_operator.h>
#include <corotet/operators/vertex_dilatation.h>

#include <gtest/gtest.h>

#include "../two_regions.h"
#include "random_states.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  // A mesh of distorted cells, some of which have a second material.
  SerialMesh
  mesh_of_two()
  {
    return in_two_regions(box("2, 1, 1", "6, 3, 3", 0.1), 1, "steel", "rubber");
  }

  const std::string steel_and_rubber =
    section("Material",
            {{"Young's modulus", "steel: 100, rubber: 1"},
             {"Poisson's ratio", "steel: 0.3, rubber: 0.49"},
             {"Density", "steel: 3, rubber: 1"}});

  std::string
  case_of(const std::string &type, const std::string &dilatation = "vertices")
  {
    return element_text(Element(1)) + material_type(type) + steel_and_rubber +
           section("Material", {{"Dilatation", dilatation}});
  }

  class VertexDilatations : public testing::TestWithParam<std::string>
  {};

  // Calls function(x, weight) for the points x = u + h v of the differences
  // that NonlinearLaws uses.
  template <typename Function>
  void
  for_fourth_order(const Vector &u, const Vector &v, const Function &function)
  {
    const double h = 2e-4;
    Vector       x(u);
    for (const auto &[step, weight] : {std::pair<double, double>{-2, 1. / 12},
                                       {-1, -2. / 3},
                                       {1, 2. / 3},
                                       {2, -1. / 12}})
      {
        x = moved(u, step * h, v);
        function(x, weight / h);
      }
  }
} // namespace

INSTANTIATE_TEST_SUITE_P(All,
                         VertexDilatations,
                         testing::Values("linear", "corotational"));

TEST_P(VertexDilatations, ForceIsTheGradientOfTheEnergy)
{
  MovingBody   body(mesh_of_two(), case_of(GetParam()));
  Elasticity  &elasticity = body.elasticity;
  const Vector v          = random_direction(body);
  double       largest    = 0;
  for (const RandomState &state : states)
    {
      const Vector u     = displacement(body, state, 2., 3);
      double       slope = 0;
      for_fourth_order(u, v, [&](const Vector &x, const double weight) {
        force(elasticity, x);
        slope += weight * elasticity.state(x).energy;
      });
      const double power = force(elasticity, u) * v;
      largest = std::max(largest, std::abs(power - slope) / std::abs(slope));
    }
  report("largest relative difference", largest);
  EXPECT_LE(largest, 1e-8);
}

TEST_P(VertexDilatations, TangentIsTheDerivative)
{
  MovingBody        body(mesh_of_two(), case_of(GetParam()));
  Elasticity       &elasticity = body.elasticity;
  EffectiveOperator A(body.discretization,
                      elasticity,
                      body.mass,
                      body.motion.is_prescribed());
  TangentOperator   J(A, elasticity, body.system.equation().terms);
  Vector            v       = random_direction(body);
  double            largest = 0;
  for (const RandomState &state : states)
    {
      const Vector u = displacement(body, state, 2., 7);
      Vector       difference(u);
      difference.zero_out_ghost_values();
      difference = 0;
      v.update_ghost_values();
      for_fourth_order(u, v, [&](const Vector &x, const double weight) {
        difference.add(weight, force(elasticity, x));
      });
      v.zero_out_ghost_values();
      force(elasticity, u);
      A.update(1., 0.);
      J.update({0., u, u}, Tangent::consistent, 1., 0.);
      Vector product(difference);
      J.vmult(product, v);
      largest = std::max(largest,
                         largest_difference(product, difference) /
                           difference.linfty_norm());
    }
  report("largest relative difference", largest);
  EXPECT_LE(largest, 1e-6);
}

// Forces have no sum and no moment, and rotate with the body; the energy does
// not change.
TEST(VertexDilatation, IsObjective)
{
  MovingBody         body(mesh_of_two(), case_of("corotational"));
  Elasticity        &elasticity = body.elasticity;
  const Vector       u          = displacement(body, calm, 0., 7);
  const Tensor<2, 3> R = rotation_about(Tensor<1, 3>({1., -2., 0.5}), 2.5);
  Vector             turned(u);
  for (unsigned int n = 0; n < body.discretization.n_local_nodes(); ++n)
    {
      const Point<3> X = body.discretization.node_position(n);
      Tensor<1, 3>   x;
      for (unsigned int a = 0; a < 3; ++a)
        x[a] = X[a] + u.local_element(3 * n + a);
      x = R * x;
      for (unsigned int a = 0; a < 3; ++a)
        turned.local_element(3 * n + a) = x[a] + 10 - X[a];
    }
  turned.update_ghost_values();
  const Vector f      = force(elasticity, u);
  const double energy = elasticity.state(u).energy;
  const Vector g      = force(elasticity, turned);
  // Coordinates of size ten cost one and a half digits.
  EXPECT_NEAR(elasticity.state(turned).energy, energy, 1e-12 * energy);
  Tensor<1, 3> sum, moment;
  double       largest = 0;
  for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
    {
      const Point<3> X = body.discretization.node_position(n);
      Tensor<1, 3>   own, of_turned, x;
      for (unsigned int a = 0; a < 3; ++a)
        {
          own[a]       = f.local_element(3 * n + a);
          of_turned[a] = g.local_element(3 * n + a);
          x[a]         = X[a] + u.local_element(3 * n + a);
        }
      largest = std::max(largest, (R * own - of_turned).norm());
      sum += own;
      moment += cross_product_3d(x, own);
    }
  const double size = norm(f);
  EXPECT_LE(largest, 1e-12 * size);
  for (unsigned int a = 0; a < 3; ++a)
    {
      const MPI_Comm comm = body.discretization.communicator();
      EXPECT_LE(std::abs(dealii::Utilities::MPI::sum(sum[a], comm)),
                1e-13 * size);
      EXPECT_LE(std::abs(dealii::Utilities::MPI::sum(moment[a], comm)),
                1e-13 * size);
    }
}

// If each material has a uniform dilatation, that at the vertices is the same:
// so are force, energy and stress.
TEST_P(VertexDilatations, UniformDilatationIsThatOfTheCells)
{
  MovingBody   of_vertices(mesh_of_two(), case_of(GetParam()));
  MovingBody   of_cells(mesh_of_two(), case_of(GetParam(), "cells"));
  const Vector u = of_cells.interpolate([](const Point<3> &x) {
    return Tensor<1, 3>({0.1 * x[0] + 0.3 * x[1], -0.2 * x[2], 0.2 * x[1]});
  });
  const Vector f = force(of_vertices.elasticity, u),
               g = force(of_cells.elasticity, u);
  EXPECT_LE(largest_difference(f, g), 1e-13 * norm(g));
  const double energy = of_cells.elasticity.state(u).energy;
  EXPECT_NEAR(of_vertices.elasticity.state(u).energy, energy, 1e-13 * energy);
  StressField a = of_vertices.stress_field(), b = of_cells.stress_field();
  a.set_displacement(u);
  b.set_displacement(u);
  const auto &of_a = a.at_points(), &of_b = b.at_points();
  ASSERT_EQ(of_a.size(), of_b.size());
  for (std::size_t i = 0; i < of_a.size(); ++i)
    EXPECT_LE((of_a[i] - of_b[i]).norm(), 1e-12 * of_b[i].norm());
}

// The stress in results is that of the force: both do the same work. The
// corotational law's stress is R sigma R^T in results, and R sigma in forces.
TEST_P(VertexDilatations, StressIsThatOfTheForce)
{
  MovingBody   body(mesh_of_two(), case_of(GetParam()));
  const Vector u     = displacement(body, calm, 0.3, 7);
  const Vector v     = random_direction(body);
  const double power = force(body.elasticity, u) * v;
  StressField  field = body.stress_field();
  double       work  = 0;
  field.set_displacement(u);
  for (unsigned int c = 0; c < body.discretization.n_owned_cells(); ++c)
    {
      const auto   nodes = body.discretization.cell_nodes(c);
      const auto  &cell  = body.discretization.geometry(c);
      Tensor<2, 3> by_xi;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int a = 0; a < 3; ++a)
          by_xi[a][k] = v.local_element(3 * nodes[k + 1] + a) -
                        v.local_element(3 * nodes[0] + a);
      work += cell.volume * scalar_product(Tensor<2, 3>(field.at_points()[c]) *
                                             body.elasticity.rotation(c),
                                           by_xi * cell.inverse_jacobian);
    }
  EXPECT_NEAR(dealii::Utilities::MPI::sum(work,
                                          body.discretization.communicator()),
              power,
              1e-12 * std::abs(power));
}

// For a smooth displacement without change of volume the estimated error is
// near the true one however large lambda is.
TEST(VertexDilatation, ErrorIsEstimated)
{
  for (const double ratio : {0.3, 0.4999})
    {
      MovingBody body(box("1, 1, 1", "8, 8, 8", 0.1),
                      element_text(Element(1)) + material_type("linear") +
                        material_text(1, ratio) +
                        section("Material", {{"Dilatation", "vertices"}}));
      const auto exact = [](const Point<3> &x) {
        return PointDisplacement{
          Tensor<1, 3>({std::sin(x[1]), std::sin(x[2]), std::sin(x[0])}),
          Tensor<2, 3>({{0., std::cos(x[1]), 0.},
                        {0., 0., std::cos(x[2])},
                        {std::cos(x[0]), 0., 0.}})};
      };
      const Vector u =
        body.interpolate([&](const Point<3> &x) { return exact(x).value; });
      StressField field = body.stress_field();
      field.set_displacement(u);
      const double estimated = field.error().energy_norm;
      const double found     = error_norms(body.discretization,
                                       body.materials,
                                       u,
                                       exact,
                                       body.elasticity.vertex_dilatation())
                             .error.energy;
      report("estimated over true error", estimated / found);
      // The remaining difference is usual for so coarse a mesh.
      EXPECT_NEAR(estimated / found, 1, 0.2);
    }
}

// Operator, matrix and diagonal agree, with supports, with mass of either kind,
// and for both tangents.
TEST_P(VertexDilatations, MatrixIsTheOperator)
{
  for (const std::string mass : {"consistent", "diagonal scaling"})
    {
      MovingBody        body(mesh_of_two(),
                      case_of(GetParam()) +
                        section("Discretization", {{"Mass", mass}}) +
                        displacements("x-min: 0; free; 0"));
      EffectiveOperator A(body.discretization,
                          body.elasticity,
                          body.mass,
                          body.motion.is_prescribed());
      TangentOperator   J(A, body.elasticity, body.system.equation().terms);
      const Vector      u = displacement(body, calm, 1., 7);
      Vector            v = random_direction(body);
      v.zero_out_ghost_values();
      for (const unsigned int i : A.prescribed_unknowns())
        if (i < v.locally_owned_size())
          v.local_element(i) = 0;
      force(body.elasticity, u);
      A.update(1., 2.);
      Vector product(v), found(v);
      J.update({0., u, u}, Tangent::consistent, 1., 0.);
      ASSERT_EQ(J.has_matrix(), GetParam() == "corotational");
      if (J.has_matrix())
        for (const double n_frozen : {0., 3.})
          {
            J.vmult(product, v);
            if (n_frozen > 0)
              {
                Vector            Kv(v);
                EffectiveOperator K(body.discretization,
                                    body.elasticity,
                                    body.mass,
                                    body.motion.is_prescribed());
                K.update(n_frozen, 0.);
                K.vmult(Kv, v);
                product += Kv;
              }
            J.matrix(n_frozen).vmult(found, v);
            EXPECT_LE(largest_difference(found, product),
                      1e-13 * norm(product));
          }
      // Prescribed unknowns are decoupled from the others.
      v = random_direction(body);
      v.zero_out_ghost_values();
      A.vmult(product, v);
      A.matrix().vmult(found, v);
      EXPECT_LE(largest_difference(found, product), 1e-13 * norm(product));
      const BlockMatrix &matrix = A.matrix();
      for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
        found.local_element(i) = matrix.diagonal(i);
      EXPECT_LE(largest_difference(found, A.diagonal()),
                1e-13 * A.diagonal().linfty_norm());
    }
}

// Where rotations are not unique, all ranks take the same ones: forces have no
// sum, and the matrix equals the operator.
TEST(VertexDilatation, OfACrushedBody)
{
  for (const auto &s : {Tensor<1, 3>({1., 1., -1.}),
                        Tensor<1, 3>({1., 0., 0.}),
                        Tensor<1, 3>({0., 0., 0.})})
    {
      MovingBody        body(mesh_of_two(), case_of("corotational"));
      EffectiveOperator A(body.discretization,
                          body.elasticity,
                          body.mass,
                          body.motion.is_prescribed());
      const Vector      u = body.interpolate([&](const Point<3> &x) {
        Tensor<1, 3> value;
        for (unsigned int a = 0; a < 3; ++a)
          value[a] = (s[a] - 1) * (x[a] - 0.5);
        return value;
      });
      const Vector      f = force(body.elasticity, u);
      A.update(1., 0.);
      Tensor<1, 3> sum;
      for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
        sum[i % 3] += f.local_element(i);
      for (unsigned int a = 0; a < 3; ++a)
        EXPECT_LE(std::abs(dealii::Utilities::MPI::sum(
                    sum[a], body.discretization.communicator())),
                  1e-12 * norm(f));
      Vector v = random_direction(body);
      v.zero_out_ghost_values();
      Vector product(v), found(v);
      A.vmult(product, v);
      A.matrix().vmult(found, v);
      EXPECT_LE(largest_difference(found, product), 1e-13 * norm(product));
    }
}

// Ranks together give the results of one rank, even with next to no cells.
TEST_P(VertexDilatations, RanksAgree)
{
  for (const bool is_small : {false, true})
    {
      const SerialMesh mesh =
        is_small ? box("1, 1, 1", "1, 1, 1") : mesh_of_two();
      const std::string text =
        is_small ? element_text(Element(1)) + material_type(GetParam()) +
                     material_text(10, 0.49) +
                     section("Material", {{"Dilatation", "vertices"}}) :
                   case_of(GetParam());
      const auto figures = [&](const MPI_Comm comm) {
        MovingBody        body(mesh, text, comm);
        EffectiveOperator A(body.discretization,
                            body.elasticity,
                            body.mass,
                            body.motion.is_prescribed());
        const Vector      u = body.interpolate([](const Point<3> &x) {
          return Tensor<1, 3>({std::sin(2 * x[0] * x[1]),
                               0.3 * x[2] * x[2],
                               0.5 * std::cos(x[0] + x[1])});
        });
        Vector            v = random_direction(body);
        v.zero_out_ghost_values();
        const Vector f = force(body.elasticity, u);
        A.update(1., 0.);
        Vector product(v), of_matrix(v);
        A.vmult(product, v);
        A.matrix().vmult(of_matrix, v);
        return std::vector<double>{body.elasticity.state(u).energy,
                                   norm(f),
                                   norm(product),
                                   norm(of_matrix),
                                   norm(A.diagonal())};
      };
      const auto one = figures(MPI_COMM_SELF), all = figures(MPI_COMM_WORLD);
      for (unsigned int i = 0; i < one.size(); ++i)
        EXPECT_NEAR(all[i], one[i], 1e-12 * one[i]) << i;
    }
}
