// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_operators_random_states_h
#define corotet_tests_operators_random_states_h

#include <corotet/operators/elasticity.h>

#include <random>

#include "../all_laws.h"
#include "../body.h"

namespace corotet::tests
{
  inline std::string
  case_text(const Element element, const NamedLaw &law)
  {
    return element_text(element) + law.text + material_text(1e3, 0.4);
  }

  // The elasticity of the body with another law.
  inline Elasticity
  elasticity_of(const MovingBody                         &body,
                const std::shared_ptr<const MaterialLaw> &law)
  {
    return {body.discretization, body.reference, body.materials, law};
  }

  // A state of the body: stretches, then a rotation by any angle up to a half
  // turn, plus noise.
  struct RandomState
  {
    std::string          name;
    dealii::Tensor<1, 3> stretches;
    double               shear;
    double               noise;
    // Curvature of the map, so that rotations vary within a cell.
    double bending;
  };

  inline const std::vector<RandomState> states{
    {"rotated", dealii::Tensor<1, 3>({1., 1., 1.}), 0., 0.02, 0.1},
    {"stretched", dealii::Tensor<1, 3>({1.5, 0.8, 0.7}), 0., 0.02, 0.3},
    {"sheared", dealii::Tensor<1, 3>({1., 1.2, 0.9}), 0.8, 0.02, 0.3},
    {"nearly inverted",
     dealii::Tensor<1, 3>({1., 0.9, 0.02}),
     0.1,
     0.005,
     0.01},
    {"inverted", dealii::Tensor<1, 3>({1.1, 0.9, -0.3}), 0.1, 0.01, 0.05},
    {"calm", dealii::Tensor<1, 3>({1.2, 0.9, 0.95}), 0.1, 0.002, 0.1}};

  /// A state far from inverted at each point of each cell, so that all laws
  /// have it.
  inline const RandomState &calm = states.back();

  inline Vector
  displacement(const MovingBody  &body,
               const RandomState &state,
               const double       angle,
               const unsigned int seed)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    const dealii::Tensor<2, 3>             R =
      rotation_about(dealii::Tensor<1, 3>({0.3, -1., 2.}), angle);
    dealii::Tensor<2, 3> S;
    for (unsigned int a = 0; a < 3; ++a)
      S[a][a] = state.stretches[a];
    S[0][1] = S[1][0] = state.shear;
    const dealii::Tensor<2, 3> Q =
      rotation_about(dealii::Tensor<1, 3>({1., 2., 1.}), 1.);
    const dealii::Tensor<2, 3> F = R * Q * S * transpose(Q);
    // Noise is numbered by global unknowns, so that ranks agree.
    std::vector<double> noise(std::size_t(3) *
                              body.discretization.n_global_nodes());
    for (double &n : noise)
      n = state.noise * number(generator);
    Vector u = body.interpolate([&](const dealii::Point<3> &x) {
      dealii::Tensor<1, 3> b({x[1] * x[2], x[0] * x[0], x[0] * x[1]});
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

  // Whether the law has an energy in that state and near it: some laws have
  // none where cells are inverted, and are arbitrarily steep before.
  inline bool
  has_state(Elasticity &elasticity, const Vector &u)
  {
    dealii::Tensor<2, 3> flat;
    flat[2][2] = -1;
    elasticity.update_rotations(u);
    return std::isfinite(
             elasticity.law().energy_density(elasticity.material(0), flat)) ||
           elasticity.state(u).min_det_F > 0.5;
  }

  inline Vector
  force(Elasticity &elasticity, const Vector &u)
  {
    Vector f(u);
    f.zero_out_ghost_values();
    elasticity.update_rotations_and_force(f, u);
    return f;
  }

  // The vector u + factor v, with current ghost values.
  inline Vector
  moved(const Vector &u, const double factor, const Vector &v)
  {
    Vector result(u);
    result.zero_out_ghost_values();
    result.add(factor, v);
    result.update_ghost_values();
    return result;
  }

  inline Vector
  random_direction(const MovingBody &body)
  {
    return body.interpolate([](const dealii::Point<3> &x) {
      return dealii::Tensor<1, 3>({std::sin(7 * x[0] + x[1]),
                                   x[1] * x[2] + std::cos(9 * x[2]),
                                   x[0] - x[2] + std::sin(8 * x[1])});
    });
  }
} // namespace corotet::tests

#endif
