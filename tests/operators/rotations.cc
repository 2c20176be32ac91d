// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Where the rotation is taken: forces, energies and exact tangents of the three
// placements, checked against differences, symmetry and balance of each cell.

#include <corotet/operators/elasticity.h>

#include <gtest/gtest.h>

#include <random>

#include "../body.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  const std::vector<std::pair<std::string, Rotation>> placements{
    {"cell centre", Rotation::cell_centre},
    {"quadrature points", Rotation::quadrature_points},
    {"cell centre, variational", Rotation::cell_centre_variational}};

  std::string
  case_text(const unsigned int degree, const std::string &rotation)
  {
    return "subsection Discretization\n set Degree = " +
           std::to_string(degree) +
           "\nend\nsubsection Material\n set Rotation = " + rotation +
           "\n set Young's modulus = 1e3\n set Poisson's ratio = 0.4\nend\n";
  }

  // A state of the body: a rotation with any angle up to a half turn after a
  // stretch, plus noise.
  struct RandomState
  {
    std::string  name;
    Tensor<1, 3> stretches;
    double       shear;
    double       noise;
    // Curvature of the map, so that rotations vary within a cell.
    double bending;
  };

  const std::vector<RandomState> states{
    {"rotated", Tensor<1, 3>({1., 1., 1.}), 0., 0.02, 0.1},
    {"stretched", Tensor<1, 3>({1.5, 0.8, 0.7}), 0., 0.02, 0.3},
    {"sheared", Tensor<1, 3>({1., 1.2, 0.9}), 0.8, 0.02, 0.3},
    {"nearly inverted", Tensor<1, 3>({1., 0.9, 0.02}), 0.1, 0.005, 0.01},
    {"inverted", Tensor<1, 3>({1.1, 0.9, -0.3}), 0.1, 0.01, 0.05}};

  Vector
  displacement(const Body        &body,
               const RandomState &state,
               const double       angle,
               const unsigned int seed)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    const Tensor<2, 3> R = rotation_about(Tensor<1, 3>({0.3, -1., 2.}), angle);
    Tensor<2, 3>       S;
    for (unsigned int a = 0; a < 3; ++a)
      S[a][a] = state.stretches[a];
    S[0][1] = S[1][0]    = state.shear;
    const Tensor<2, 3> Q = rotation_about(Tensor<1, 3>({1., 2., 1.}), 1.);
    const Tensor<2, 3> F = R * Q * S * transpose(Q);
    // By global number of the component, so that ranks agree.
    std::vector<double> noise(3 * body.discretization.n_global_nodes());
    for (double &n : noise)
      n = state.noise * number(generator);
    Vector u = body.interpolate([&](const Point<3> &x) {
      Tensor<1, 3> b({x[1] * x[2], x[0] * x[0], x[0] * x[1]});
      return F * (x + state.bending * b) - x;
    });
    u.zero_out_ghost_values();
    for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
      for (unsigned int a = 0; a < 3; ++a)
        u.local_element(3 * n + a) +=
          noise[3 * body.discretization.global_node(n) + a];
    u.update_ghost_values();
    return u;
  }

  Vector
  force(Elasticity &elasticity, const Vector &u)
  {
    Vector f(u);
    f.zero_out_ghost_values();
    elasticity.update_rotations_and_force(f, u);
    return f;
  }

  // u + factor v, with ghosts up to date.
  Vector
  moved(const Vector &u, const double factor, const Vector &v)
  {
    Vector result(u);
    result.zero_out_ghost_values();
    result.add(factor, v);
    result.update_ghost_values();
    return result;
  }

  Vector
  random_direction(const Body &body)
  {
    return body.interpolate([](const Point<3> &x) {
      return Tensor<1, 3>({std::sin(7 * x[0] + x[1]),
                           x[1] * x[2] + std::cos(9 * x[2]),
                           x[0] - x[2] + std::sin(8 * x[1])});
    });
  }
} // namespace

class RotationPlacement
  : public testing::TestWithParam<std::tuple<unsigned int, unsigned int>>
{
protected:
  unsigned int degree    = std::get<0>(GetParam());
  std::string  name      = placements[std::get<1>(GetParam())].first;
  Rotation     placement = placements[std::get<1>(GetParam())].second;
};

// Central differences of fourth order: with steps of 1e-3 their error is some
// 1e-12 of the higher derivatives, round-off 1e-13 / 1e-3.
TEST_P(RotationPlacement, ConsistentTangentIsTheDerivative)
{
  Body         body(box("1, 2, 1", "2, 2, 2", 0.2), case_text(degree, name));
  Elasticity   elasticity(body.discretization,
                        body.system.reference_element(),
                        body.parameters.material.materials(body.mesh.regions()),
                        placement);
  const Vector v       = random_direction(body);
  double       largest = 0;
  for (const RandomState &state : states)
    for (const double angle : {0.3, 1.5, 3., dealii::numbers::PI})
      {
        Vector       u = displacement(body, state, angle, 7);
        const Vector x = moved(u, 0., v);
        const double h = 2e-4;
        Vector       difference(u);
        difference.zero_out_ghost_values();
        difference = 0;
        for (const auto &[step, weight] :
             {std::pair<double, double>{-2, 1. / 12},
              {-1, -2. / 3},
              {1, 2. / 3},
              {2, -1. / 12}})
          {
            u = moved(x, step * h, v);
            difference.add(weight / h, force(elasticity, u));
          }
        force(elasticity, x);
        EXPECT_EQ(elasticity.linearize(x, Tangent::consistent), 0u);
        Vector product(difference);
        elasticity.apply_linearization(product, v, 1., 0., nullptr, nullptr);
        const double error =
          largest_difference(product, difference) / difference.linfty_norm();
        largest = std::max(largest, error);
        EXPECT_LE(error, 1e-6) << state.name << ", angle " << angle;
      }
  report("largest relative difference", largest);
}

// The force is the gradient of the energy, but for one rotation per cell above
// degree 1.
TEST_P(RotationPlacement, ForceIsTheGradientOfTheEnergy)
{
  Body         body(box("1, 2, 1", "2, 2, 2", 0.2), case_text(degree, name));
  Elasticity   elasticity(body.discretization,
                        body.system.reference_element(),
                        body.parameters.material.materials(body.mesh.regions()),
                        placement);
  const Vector v       = random_direction(body);
  double       largest = 0;
  for (const RandomState &state : states)
    {
      Vector       u     = displacement(body, state, 2., 3);
      const Vector x     = moved(u, 0., v);
      const double h     = 2e-4;
      double       slope = 0;
      for (const auto &[step, weight] : {std::pair<double, double>{-2, 1. / 12},
                                         {-1, -2. / 3},
                                         {1, 2. / 3},
                                         {2, -1. / 12}})
        {
          u = moved(x, step * h, v);
          force(elasticity, u);
          slope += weight / h * elasticity.state(u).energy;
        }
      const Vector f     = force(elasticity, x);
      const double power = f * v;
      largest = std::max(largest, std::abs(power - slope) / std::abs(slope));
    }
  report("largest relative difference", largest);
  if (placement != Rotation::cell_centre || degree == 1)
    EXPECT_LE(largest, 1e-8);
  else
    EXPECT_GE(largest, 1e-4) << "a law without an energy is expected here";
}

INSTANTIATE_TEST_SUITE_P(All,
                         RotationPlacement,
                         testing::Combine(testing::Values(1u, 2u, 3u),
                                          testing::Values(0u, 1u, 2u)));
