// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The exact tangent of a step, K_T + c_M M.

#include <gtest/gtest.h>

#include "../all_laws.h"
#include "../body.h"
#include "../curved_mesh.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

// The tangent contains the mass, of any kind, once, and not at all in statics:
// J(c_M) v - J(0) v = c_M M v where nothing is prescribed. c_M makes both parts
// of the same size, so that little cancels.
TEST(TangentOperator, HasTheMassOnce)
{
  for (const auto &[type, rotation] :
       {std::pair<std::string, std::string>("consistent", "quadrature points"),
        {"diagonal scaling", "quadrature points"},
        {"consistent", "cell centre"},
        {"diagonal scaling", "cell centre"}})
    {
      SCOPED_TRACE(type + ", " + rotation);
      MovingBody        body(box("1, 2, 1", "2, 2, 2", 0.2),
                      element_text(2) + rotation_at(rotation) +
                        section("Discretization", {{"Mass", type}}) +
                        section("Material", {{"Density", 3}}));
      EffectiveOperator A(body.discretization,
                          body.elasticity,
                          body.mass,
                          body.motion.is_prescribed());
      TangentOperator   J(A, body.elasticity, body.system.equation().terms);
      const Vector      u = body.interpolate([](const Point<3> &x) {
        return Tensor<1, 3>(
          {0.1 * x[1] * x[2], -0.2 * x[0], 0.05 * x[0] * x[1]});
      });
      const Vector      v = body.interpolate([](const Point<3> &x) {
        return Tensor<1, 3>({std::sin(3 * x[0]), 1., x[1] * x[2]});
      });
      body.elasticity.update_rotations(u);
      const auto applied = [&](const double c_M) {
        A.update(1., c_M);
        J.update({0., u, u}, Tangent::consistent, 1., 0.);
        Vector result(v);
        J.vmult(result, v);
        return result;
      };
      Vector Mv(v);
      body.mass.apply(Mv, v);
      const Vector without = applied(0);
      const double c_M     = norm(without) / norm(Mv);
      Vector       found   = applied(c_M);
      found -= without;
      Mv *= c_M;
      EXPECT_LE(largest_difference(found, Mv), 1e-13 * norm(Mv));
    }
}

namespace
{
  void
  expect_matrix_to_be_the_operator(const SerialMesh  &mesh,
                                   const std::string &text)
  {
    MovingBody        body(mesh, text + displacements("x-min: 0; free; 0"));
    EffectiveOperator A(body.discretization,
                        body.elasticity,
                        body.mass,
                        body.motion.is_prescribed());
    TangentOperator   J(A, body.elasticity, body.system.equation().terms);
    const Vector      u = body.interpolate([](const Point<3> &x) {
      return Tensor<1, 3>({0.1 * x[1] * x[2], -0.2 * x[0], 0.05 * x[0] * x[1]});
    });
    Vector            v = body.interpolate([](const Point<3> &x) {
      return Tensor<1, 3>({std::sin(3 * x[0]), 1., x[1] * x[2]});
    });
    Vector            w = body.interpolate([](const Point<3> &x) {
      return Tensor<1, 3>({x[2], std::cos(2 * x[1]), x[0] - x[1] * x[1]});
    });
    // On prescribed unknowns J has the diagonal of A, and its matrix another
    // one.
    for (const unsigned int i : A.prescribed_unknowns())
      if (i < v.locally_owned_size())
        {
          v.local_element(i) = 0;
          w.local_element(i) = 0;
        }
    body.elasticity.update_rotations(u);
    A.update(1., 2.);
    Vector found(v), expected(v), Jw(v);
    for (const Tangent tangent :
         {Tangent::consistent, Tangent::frozen_rotation})
      {
        J.update({0., u, u}, tangent, 1., 0.);
        if (!J.has_matrix())
          continue;
        J.vmult(expected, v);
        J.vmult(Jw, w);
        J.matrix(0.).vmult(found, v);
        EXPECT_NEAR(w * found,
                    (w * expected + v * Jw) / 2,
                    1e-13 * norm(w) * norm(expected));
        if (!J.is_symmetric())
          continue;
        // The round-off of sums of some hundred terms in another order.
        EXPECT_LE(largest_difference(found, expected), 1e-13 * norm(expected));
      }
    // The matrix of A, which J has used, is restored.
    A.vmult(expected, v);
    A.matrix().vmult(found, v);
    EXPECT_LE(largest_difference(found, expected), 1e-13 * norm(expected));
  }
} // namespace

// The assembled matrix equals the operator, or its symmetric part, for straight
// and curved cells, with either mass, on any number of ranks.
TEST(TangentOperator, Matrix)
{
  for (const NamedLaw &law : nonlinear_laws())
    for (const std::string type : {"consistent", "diagonal scaling"})
      for (const unsigned int degree : {1u, 2u, 3u})
        {
          const std::string text = element_text(degree) + law.text +
                                   section("Discretization", {{"Mass", type}}) +
                                   section("Material", {{"Density", 3}});
          SCOPED_TRACE(text);
          expect_matrix_to_be_the_operator(box("1, 2, 1", "2, 2, 2", 0.2),
                                           text);
          if (degree > 1)
            expect_matrix_to_be_the_operator(half_curved_box(degree), text);
        }
}
