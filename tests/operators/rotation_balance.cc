// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The balance of a single cell: net force and torque of its internal force for
// each placement of the rotation, the symmetry of its tangents, and the terms
// that make up the tangents.

#include <deal.II/lac/full_matrix.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "random_states.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  // A tetrahedron without any symmetry, scaled by h about a point.
  SerialMesh
  one_cell(const double h = 1)
  {
    const Point<3> centre(0.4, 0.3, 0.35);
    SerialMesh     mesh;
    mesh.vertices = {Point<3>(0.1, 0., 0.05),
                     Point<3>(1.1, 0.2, 0.),
                     Point<3>(0.3, 0.9, -0.1),
                     Point<3>(0.2, 0.3, 1.2)};
    for (Point<3> &x : mesh.vertices)
      x = centre + h * (x - centre);
    mesh.cells         = {{{{0, 1, 2, 3}}, 0}};
    mesh.regions.names = {{0, "body"}};
    return mesh;
  }

  struct Cell : public MovingBody
  {
    Cell(const unsigned int degree, const NamedLaw &law, const double h = 1)
      : MovingBody(one_cell(h), case_text(degree, law))
      , elasticity(elasticity_of(*this, law.law))
    {}

    // The product f = (K + (frozen_factor - 1) K_frozen + c_M M) v at the last
    // linearization.
    Vector
    product(const Vector &v,
            const double  frozen_factor = 1,
            const double  c_M           = 0) const
    {
      Vector f(v);
      f.zero_out_ghost_values();
      elasticity.apply_linearization(
        f, v, frozen_factor, c_M, mass.cell_masses().data(), nullptr);
      return f;
    }

    // The product f = K v with rotations frozen at u, where forces were
    // evaluated.
    Vector
    frozen_product(const Vector &u, const Vector &v)
    {
      if (!elasticity.is_by_cell(Tangent::frozen_rotation))
        {
          elasticity.linearize(u, Tangent::frozen_rotation);
          return product(v);
        }
      Vector f(v);
      f.zero_out_ghost_values();
      elasticity.apply_tangent(f, v);
      return f;
    }

    Elasticity elasticity;
  };

  // Net force and torque of the internal force at u, about the centroid of the
  // nodes, relative to the sums of |f_i| and of |x_i| |f_i|.
  struct Balance
  {
    double force, torque;
  };

  Balance
  balance(Cell &cell, const Vector &u)
  {
    const Vector          f    = force(cell.elasticity, u);
    const Discretization &disc = cell.discretization;
    const auto            at   = [](const Vector &v, const unsigned int node) {
      return Tensor<1, 3>({v.local_element(3 * node),
                           v.local_element(3 * node + 1),
                           v.local_element(3 * node + 2)});
    };
    const auto position = [&](const unsigned int node) {
      return disc.node_position(node) + at(u, node);
    };
    Tensor<1, 3> centroid, net_force, net_torque;
    double       forces = 0, torques = 0;
    for (unsigned int n = 0; n < disc.n_owned_nodes(); ++n)
      centroid += position(n) / disc.n_global_nodes();
    centroid = dealii::Utilities::MPI::sum(centroid, MPI_COMM_WORLD);
    for (unsigned int n = 0; n < disc.n_owned_nodes(); ++n)
      {
        const Tensor<1, 3> arm = position(n) - centroid;
        net_force += at(f, n);
        net_torque += cross_product_3d(arm, at(f, n));
        forces += at(f, n).norm();
        torques += arm.norm() * at(f, n).norm();
      }
    const auto sum = [](const auto &value) {
      return dealii::Utilities::MPI::sum(value, MPI_COMM_WORLD);
    };
    return {sum(net_force).norm() / sum(forces),
            sum(net_torque).norm() / sum(torques)};
  }

  // The smallest pivot of the elimination without pivoting: it is positive for
  // positive matrices.
  double
  smallest_pivot(dealii::FullMatrix<double> A)
  {
    double smallest = std::numeric_limits<double>::max();
    for (unsigned int k = 0; k < A.m(); ++k)
      {
        smallest = std::min(smallest, A(k, k));
        for (unsigned int i = k + 1; i < A.m(); ++i)
          for (unsigned int j = k + 1; j < A.m(); ++j)
            A(i, j) -= A(i, k) * A(k, j) / A(k, k);
      }
    return smallest;
  }

  // A bar along y, bent by a right angle over its unit length and stretched by
  // some 10 % along and across, by an amount that varies.
  Tensor<1, 3>
  bending(const Point<3> &x)
  {
    const double angle = dealii::numbers::PI / 2 * x[1];
    const double r     = 2 / dealii::numbers::PI + 1.1 * (x[0] - 0.3) +
                     0.1 * x[0] * x[0] + 0.05 * std::sin(2 * x[2]);
    return Tensor<1, 3>({r * std::cos(angle),
                         r * std::sin(angle),
                         0.95 * x[2] + 0.1 * x[1] * x[2]}) -
           x;
  }
} // namespace

class RotationBalance
  : public testing::TestWithParam<std::tuple<unsigned int, unsigned int>>
{
protected:
  void
  SetUp() override
  {
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      GTEST_SKIP() << "each rank needs a cell, and this mesh has one";
  }

  unsigned int degree = std::get<0>(GetParam());
  NamedLaw     law    = nonlinear_laws()[std::get<1>(GetParam())];
  std::string  name   = law.name;
  // Whether the law has one rotation per cell while gradients vary in it.
  bool has_no_energy = !law.law->has_energy(degree);
};

// Force and torque vanish to round-off: strains are 1e-2 and more, and errors
// of 1e-16 add up in sums of some ten terms of that size.
TEST_P(RotationBalance, ForceAndTorqueOfACell)
{
  Cell   cell(degree, law);
  double largest_force = 0, largest_torque = 0;
  for (const RandomState &state : states)
    for (const double angle : {0.3, 1.5, 3., dealii::numbers::PI})
      for (unsigned int seed = 1; seed <= 5; ++seed)
        {
          const Vector u = displacement(cell, state, angle, seed);
          if (!has_state(cell.elasticity, u))
            continue;
          const Balance found = balance(cell, u);
          largest_force       = std::max(largest_force, found.force);
          largest_torque      = std::max(largest_torque, found.torque);
        }
  report(fmt::format("net force of a cell, P{}, {}", degree, name),
         largest_force);
  report(fmt::format("net torque of a cell, P{}, {}", degree, name),
         largest_torque);
  EXPECT_LE(largest_force, 1e-13);
  if (has_no_energy)
    EXPECT_GE(largest_torque, 1e-6);
  else
    EXPECT_LE(largest_torque, 1e-13);
}

// In a cell the rotation varies by O(h), at first linearly about the centre,
// and so does the stress. The torque comes from the skew part of the rotation's
// variation times the stress, so it averages to O(h^2) of the forces, for any
// degree.
TEST_P(RotationBalance, TorqueOfASmoothDeformation)
{
  double last = 0;
  for (const double h : {1., 1. / 2, 1. / 4, 1. / 8, 1. / 16, 1. / 32, 1. / 64})
    {
      Cell         cell(degree, law, h);
      const double torque = balance(cell, cell.interpolate(bending)).torque;
      report(fmt::format("torque of a cell, P{}, {}, h = {}", degree, name, h),
             torque);
      if (!has_no_energy)
        {
          EXPECT_LE(torque, 1e-13);
          continue;
        }
      if (h < 1)
        report(fmt::format("order of the torque, P{}, {}", degree, name),
               std::log2(last / torque));
      if (h < 0.02)
        {
          EXPECT_NEAR(std::log2(last / torque), 2, 0.2);
        }
      last = torque;
    }
}

// The tangent is the derivative of a gradient, so it is symmetric.
TEST_P(RotationBalance, SymmetryOfTheConsistentTangent)
{
  Cell         cell(degree, law);
  const Vector w         = cell.interpolate([](const Point<3> &x) {
    return Tensor<1, 3>({std::cos(5 * x[1] + x[2]),
                         std::sin(4 * x[0]) - x[2],
                         x[1] * x[0] + std::sin(6 * x[2])});
  });
  const Vector v         = random_direction(cell);
  double       asymmetry = 0;
  for (const RandomState &state : states)
    for (const double angle : {0.3, 1.5, 3., dealii::numbers::PI})
      {
        const Vector u = displacement(cell, state, angle, 11);
        if (!has_state(cell.elasticity, u))
          continue;
        force(cell.elasticity, u);
        cell.elasticity.linearize(u, Tangent::consistent);
        const Vector Kv = cell.product(v), Kw = cell.product(w);
        asymmetry = std::max(asymmetry,
                             std::abs(w * Kv - v * Kw) /
                               (norm(w) * norm(Kv) + norm(v) * norm(Kw)));
      }
  report(fmt::format("asymmetry of the tangent, P{}, {}", degree, name),
         asymmetry);
  if (has_no_energy)
    EXPECT_GE(asymmetry, 1e-5);
  else
    EXPECT_LE(asymmetry, 1e-13);
}

// R K0 R^T with any rotations is a sum of squares. For degree 1 it is the same
// for all placements of rotations.
TEST_P(RotationBalance, FrozenTangentIsPositive)
{
  Cell               cell(degree, law);
  const unsigned int n        = 3 * cell.discretization.n_global_nodes();
  double             smallest = 1, asymmetry = 0;
  const double       shift = 1e-12;
  for (const RandomState &state : states)
    {
      const Vector u = displacement(cell, state, 2., 11);
      force(cell.elasticity, u);
      dealii::FullMatrix<double> K(n, n);
      for (unsigned int j = 0; j < n; ++j)
        {
          Vector unit(u);
          unit.zero_out_ghost_values();
          unit = 0;
          if (unit.in_local_range(j))
            unit(j) = 1;
          unit.update_ghost_values();
          const Vector column = cell.frozen_product(u, unit);
          for (unsigned int i = 0; i < n; ++i)
            if (column.in_local_range(i))
              K(i, j) = column(i);
        }
      for (unsigned int i = 0; i < n; ++i)
        dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(&K(i, 0),
                                                                    n),
                                    MPI_COMM_WORLD,
                                    dealii::ArrayView<double>(&K(i, 0), n));
      dealii::FullMatrix<double> skew(K), symmetric(K);
      skew.Tadd(-1., K);
      symmetric.symmetrize();
      asymmetry =
        std::max(asymmetry, skew.frobenius_norm() / K.frobenius_norm());
      // The shift keeps round-off of zero eigenvalues from making pivots
      // negative.
      for (unsigned int i = 0; i < n; ++i)
        symmetric(i, i) += shift * K.frobenius_norm();
      smallest = std::min(smallest, smallest_pivot(symmetric));
      if (degree == 1)
        {
          const Vector v = random_direction(cell);
          Vector       by_cell(v);
          by_cell.zero_out_ghost_values();
          cell.elasticity.apply_tangent(by_cell, v);
          EXPECT_LE(largest_difference(by_cell, cell.frozen_product(u, v)),
                    1e-13 * by_cell.linfty_norm());
        }
    }
  report(fmt::format("asymmetry of the frozen tangent, P{}, {}", degree, name),
         asymmetry);
  EXPECT_LE(asymmetry, 1e-14);
  EXPECT_GT(smallest, 0.);
}

// K_T + (c - 1) K_frozen + c_M M, term by term, for each placement and tangent.
TEST_P(RotationBalance, TermsOfTheTangent)
{
  Cell         cell(degree, law);
  const Vector v = random_direction(cell);
  const Vector u = displacement(cell, states[2], 2., 5);
  force(cell.elasticity, u);
  const double c = 1.7;
  // The mass term is as large as the stiffness.
  Vector Mv(v);
  Mv.zero_out_ghost_values();
  cell.mass.apply(Mv, v);
  const Vector frozen = cell.frozen_product(u, v);
  const double c_M    = norm(frozen) / norm(Mv);
  for (const Tangent tangent : {Tangent::frozen_rotation, Tangent::consistent})
    {
      if (cell.elasticity.is_by_cell(tangent))
        continue;
      cell.elasticity.linearize(u, tangent);
      Vector expected = cell.product(v);
      expected.add(c - 1, frozen, c_M, Mv);
      EXPECT_LE(largest_difference(cell.product(v, c, c_M), expected),
                1e-13 * expected.linfty_norm());
      // The sum is also right with a lumped mass.
      Vector lumped(expected), sum = cell.product(v, c);
      cell.elasticity.apply_linearization(
        lumped, v, c, c_M, nullptr, &cell.mass.diagonal());
      for (unsigned int i = 0; i < sum.locally_owned_size(); ++i)
        sum.local_element(i) +=
          c_M * cell.mass.diagonal().local_element(i) * v.local_element(i);
      EXPECT_LE(largest_difference(lumped, sum), 1e-13 * sum.linfty_norm());
    }
}

INSTANTIATE_TEST_SUITE_P(
  All,
  RotationBalance,
  testing::Combine(testing::Values(1u, 2u, 3u),
                   testing::Range<unsigned int>(0, nonlinear_laws().size())));
