// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Cell-wise products equal those with assembled matrices, and both equal
// integrals computed with deal.II's FEValues.

#include <corotet/material/corotational.h>
#include <corotet/operators/effective_operator.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <gtest/gtest.h>

#include <random>

#include "../body.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;
using FloatVector = dealii::LinearAlgebra::distributed::Vector<float>;

namespace
{
  struct Case
  {
    unsigned int degree;
    std::string  mass;
  };

  // GoogleTest would print the bytes, some of which are never set.
  void
  PrintTo(const Case &c, std::ostream *stream)
  {
    *stream << "P" << c.degree << c.mass;
  }

  std::string
  text(const Case &c)
  {
    return element_text(c.degree, c.mass) + material_text(2e5, 0.4) +
           displacements("x-min: 0; free; 0, z-max: free; 0; 0");
  }

  // Values in [-1, 1] without a pattern that depend on position and component
  // only, so they are the same on any number of ranks.
  Tensor<1, 3>
  noise(const Point<3> &x)
  {
    Tensor<1, 3> result;
    for (unsigned int a = 0; a < 3; ++a)
      {
        const double s = 43758.5453 * std::sin(12.9898 * x[0] + 78.233 * x[1] +
                                               37.719 * x[2] + 4. * a);
        result[a]      = 2 * (s - std::floor(s)) - 1;
      }
    return result;
  }

  // A displacement that rotates every cell by another angle, up to a half turn.
  Tensor<1, 3>
  crumple(const Point<3> &x)
  {
    return rotation_about(Tensor<1, 3>({0.3, 1. - x[1], x[0]}), 3 * x[0]) * x -
           x + 0.05 * noise(x);
  }

  class MatrixFreeTest : public testing::TestWithParam<Case>
  {
  protected:
    MatrixFreeTest()
      : body(box("1, 2, 1", "2, 4, 3", 0.2), text(GetParam()))
      , A(body.discretization,
          body.elasticity,
          body.mass,
          body.motion.is_prescribed())
    {
      body.state.u.copy_locally_owned_data_from(body.interpolate(crumple));
      body.state.a.copy_locally_owned_data_from(body.interpolate(noise));
      forces = &body.system.equation().evaluate(body.state, 0., 1.);
    }

    MovingBody                      body;
    EffectiveOperator               A;
    const EquationOfMotion::Forces *forces;
  };
} // namespace

TEST_P(MatrixFreeTest, EqualsMatrix)
{
  Vector x(body.state.a), product(x), by_matrix(x);
  x.copy_locally_owned_data_from(body.state.a);
  for (const auto &[c_K, c_M] :
       std::vector<std::pair<double, double>>{{1., 0.}, {0.7, 3e3}})
    {
      A.update(c_K, c_M);
      A.vmult(product, x);
      A.matrix().vmult(by_matrix, x);
      EXPECT_GT(by_matrix.linfty_norm(), 1.);
      EXPECT_LE(largest_difference(product, by_matrix),
                1e-13 * by_matrix.linfty_norm());
      double error = 0;
      for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
        {
          const double exact = A.matrix().diagonal(i);
          error              = std::max(error,
                           std::abs(A.diagonal().local_element(i) / exact - 1));
        }
      EXPECT_LE(error, 1e-13);
    }
}

// The steps of a smoother: the residual, and the update of the solution in the
// same sweep.
TEST_P(MatrixFreeTest, SmootherSteps)
{
  A.update(0.7, 3e3);
  const auto              &mass = body.mass;
  CellwiseOperator<double> fused(body.discretization,
                                 marked_unknowns(body.motion.is_prescribed()));
  fused.set_terms(0.7,
                  body.elasticity.coefficients().data(),
                  3e3,
                  mass.cell_masses().data(),
                  mass.is_lumped() ? &mass.diagonal() : nullptr);
  Vector x(body.state.a), b(x), r(x), expected(x), d(x), inverse(x);
  x.copy_locally_owned_data_from(body.state.a);
  body.motion.set_zero(x);
  b.copy_locally_owned_data_from(forces->internal);
  body.motion.set_zero(b);
  A.matrix().vmult(expected, x);
  expected.sadd(-1., b);
  body.motion.set_zero(expected);
  fused.residual(r, b, x);
  const double size = expected.linfty_norm() + b.linfty_norm();
  EXPECT_LE(largest_difference(r, expected), 1e-13 * size);

  Vector sum(x);
  for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
    {
      inverse.local_element(i) = 1 / A.diagonal().local_element(i);
      d.local_element(i)       = std::cos(i);
      sum.local_element(i) += 0.3 * std::cos(i) + 0.6 *
                                                    inverse.local_element(i) *
                                                    expected.local_element(i);
    }
  for (const unsigned int i : fused.prescribed_unknowns())
    if (i < x.locally_owned_size())
      {
        inverse.local_element(i) = 0;
        d.local_element(i)       = 0;
        sum.local_element(i)     = 0;
      }
  fused.chebyshev_step(x, d, b, inverse, 0.3, 0.6);
  EXPECT_LE(largest_difference(x, sum), 1e-13 * sum.linfty_norm());
}

// The same in single precision, to the round-off of sums of that many terms.
TEST_P(MatrixFreeTest, SinglePrecision)
{
  A.update(0.7, 3e3);
  const auto &batches = body.discretization.batches();
  dealii::AlignedVector<CellCoefficients<float>> cells(
    batches.n_owned_batches() / floats_per_batch);
  dealii::AlignedVector<CellMasses<float>> masses(cells.size());
  for (unsigned int b = 0; b < batches.n_owned_batches(); ++b)
    for (unsigned int lane = 0; lane < batch_size; ++lane)
      {
        const unsigned int to   = b % floats_per_batch * batch_size + lane;
        const auto        &from = body.elasticity.coefficients()[b];
        auto              &cell = cells[b / floats_per_batch];
        for (unsigned int i = 0; i < 9; ++i)
          cell.gradients[i][to] = from.gradients[i][lane];
        cell.lame_ratio[to] = from.lame_ratio[lane];
        masses[b / floats_per_batch].mass[to] =
          body.mass.cell_masses()[b].mass[lane];
      }
  FloatVector x, y, lumped, diagonal;
  for (FloatVector *vector : {&x, &y, &lumped, &diagonal})
    body.discretization.initialize_vector(*vector);
  x.copy_locally_owned_data_from(body.state.a);
  lumped.copy_locally_owned_data_from(body.mass.diagonal());
  CellwiseOperator<float> single(body.discretization,
                                 marked_unknowns(body.motion.is_prescribed()));
  single.set_terms(0.7,
                   cells.data(),
                   3e3,
                   masses.data(),
                   body.mass.is_lumped() ? &lumped : nullptr);
  single.compute_diagonal();
  single.vmult(y, x);

  Vector product(body.state.a), in_double(product);
  A.vmult(product, body.state.a);
  in_double.copy_locally_owned_data_from(y);
  EXPECT_LE(largest_difference(in_double, product),
            1e-6 * product.linfty_norm());
  in_double.copy_locally_owned_data_from(single.diagonal());
  EXPECT_LE(largest_difference(in_double, A.diagonal()),
            1e-6 * A.diagonal().linfty_norm());
}

namespace
{
  // Cells by the unknowns of their vertices, as deal.II has another order of
  // cells.
  std::map<std::array<dealii::types::global_dof_index, 4>, unsigned int>
  cells_by_vertices(const Discretization &discretization)
  {
    std::map<std::array<dealii::types::global_dof_index, 4>, unsigned int>
      number;
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      {
        std::array<dealii::types::global_dof_index, 4> key;
        for (unsigned int i = 0; i < 4; ++i)
          key[i] =
            3 * discretization.global_node(discretization.cell_nodes(c)[i]);
        number[key] = c;
      }
    return number;
  }
} // namespace

// Internal force, tangent and inertia against integrals by FEValues.
TEST_P(MatrixFreeTest, EqualsFEValues)
{
  const auto       &disc       = body.discretization;
  const Elasticity &elasticity = body.elasticity;
  const auto       &fe         = disc.finite_element();
  // An exact rule; with bubbles, the one that defines the stiffness.
  const dealii::QWitherdenVincentSimplex<3> rule(
    disc.element().has_bubbles() ? 3 : 4);
  dealii::FEValues<3>                      values(disc.mapping(),
                             fe,
                             rule,
                             dealii::update_values | dealii::update_gradients |
                               dealii::update_JxW_values);
  const dealii::FEValuesExtractors::Vector all(0);
  const Vector                             u = body.interpolate(crumple);
  const Vector                             v = body.interpolate(noise);
  Vector force(body.state.u), tangent(force), inertia(force);
  force   = 0;
  tangent = 0;
  inertia = 0;
  std::vector<Tensor<2, 3>> grad_u(rule.size()), grad_v(rule.size());
  std::vector<Tensor<1, 3>> accelerations(rule.size());
  std::vector<dealii::types::global_dof_index> dofs(fe.dofs_per_cell);

  const auto number = cells_by_vertices(disc);
  for (const auto &cell : disc.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
      {
        values.reinit(cell);
        cell->get_dof_indices(dofs);
        std::array<dealii::types::global_dof_index, 4> key;
        for (unsigned int i = 0; i < 4; ++i)
          key[i] = dofs[fe.component_to_system_index(0, i)];
        const unsigned int c = number.at(key);
        values[all].get_function_gradients(u, grad_u);
        values[all].get_function_gradients(v, grad_v);
        values[all].get_function_values(v, accelerations);
        const Tensor<2, 3>       R        = elasticity.rotation(c);
        const IsotropicMaterial &material = elasticity.material(c);
        for (unsigned int q = 0; q < rule.size(); ++q)
          for (unsigned int i = 0; i < fe.dofs_per_cell; ++i)
            {
              const Tensor<2, 3> gradient = values[all].gradient(i, q);
              const double       w        = values.JxW(q);
              force(dofs[i]) +=
                w * scalar_product(corotational_stress(material, grad_u[q], R),
                                   gradient);
              tangent(dofs[i]) +=
                w * scalar_product(corotational_tangent(material, grad_v[q], R),
                                   gradient);
              inertia(dofs[i]) += w * material.density *
                                  (accelerations[q] * values[all].value(i, q));
            }
      }
  for (Vector *vector : {&force, &tangent, &inertia})
    vector->compress(dealii::VectorOperation::add);

  EXPECT_LE(largest_difference(forces->internal, force),
            1e-13 * force.linfty_norm());
  Vector product(body.state.u);
  elasticity.apply_tangent(product, v);
  EXPECT_LE(largest_difference(product, tangent),
            1e-13 * tangent.linfty_norm());
  elasticity.apply_tangent_by_quadrature(product, v);
  EXPECT_LE(largest_difference(product, tangent),
            1e-13 * tangent.linfty_norm());
  // internal_force() gives the same as the sweep that also computes rotations.
  elasticity.internal_force(product, u);
  EXPECT_LE(largest_difference(product, force), 1e-13 * force.linfty_norm());
  if (GetParam().mass == "consistent")
    {
      EXPECT_LE(largest_difference(forces->inertia, inertia),
                1e-13 * inertia.linfty_norm());
    }
}

INSTANTIATE_TEST_SUITE_P(All,
                         MatrixFreeTest,
                         testing::Values(Case{1, "consistent"},
                                         Case{2, "consistent"},
                                         Case{3, "consistent"},
                                         Case{1, "row sum"},
                                         Case{2, "diagonal scaling"},
                                         Case{2, "nodal quadrature"},
                                         Case{3, "diagonal scaling"}),
                         [](const auto &info) {
                           return "P" + std::to_string(info.param.degree) +
                                  (info.param.mass == "consistent" ?
                                     "Consistent" :
                                   info.param.mass == "nodal quadrature" ?
                                     "WithBubbles" :
                                     "Lumped");
                         });
