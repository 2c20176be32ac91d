// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Tables of the factored kernel, made by the compiler, compared with deal.II's
// element: numbering, change of basis, derivatives, integrals.

#include <corotet/discretization/bernstein.h>
#include <corotet/discretization/reference_element.h>
#include <corotet/discretization/with_degree.h>
#include <corotet/operators/basis_change.h>

#include <deal.II/fe/fe_simplex_p.h>

#include <gtest/gtest.h>

#include "lanes.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;

namespace
{
  std::array<double, 4>
  barycentric(const Point<3> &xi)
  {
    return {{1 - xi[0] - xi[1] - xi[2], xi[0], xi[1], xi[2]}};
  }

  class BernsteinTest : public testing::TestWithParam<unsigned int>
  {};
} // namespace

// The multi-index i over p is the position of node i.
TEST_P(BernsteinTest, NumbersAreThoseOfTheNodes)
{
  const dealii::FE_SimplexP<3> fe(GetParam());
  with_degree(GetParam(), [&](const auto degree) {
    constexpr int p = decltype(degree)::value;
    ASSERT_EQ(bernstein::size<p>, static_cast<int>(fe.dofs_per_cell));
    for (int i = 0; i < bernstein::size<p>; ++i)
      for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(bernstein::multi_indices<p>[i][k] / double(p),
                    barycentric(fe.unit_support_point(i))[k],
                    1e-14);
  });
}

// Any Lagrange polynomial, written in Bernstein form, has deal.II's values at
// points where no polynomial of the basis vanishes.
TEST_P(BernsteinTest, ChangeOfBasis)
{
  const dealii::FE_SimplexP<3> fe(GetParam());
  with_degree(GetParam(), [&](const auto degree) {
    constexpr int p = decltype(degree)::value;
    for (const Point<3> &xi :
         {Point<3>(0.1, 0.2, 0.3), Point<3>(0.55, 0.03, 0.29)})
      for (int i = 0; i < bernstein::size<p>; ++i)
        {
          double value = 0;
          for (int a = 0; a < bernstein::size<p>; ++a)
            value +=
              bernstein::from_lagrange<p>[a][i] *
              bernstein::value(bernstein::multi_indices<p>[a], barycentric(xi));
          EXPECT_NEAR(value, fe.shape_value(i, xi), 1e-14) << i;
        }
  });
}

// The kernels' change of basis, applied to unit vectors, gives the columns of
// the matrix and of its transpose, to the round-off of numbers below ten.
TEST_P(BernsteinTest, ChangeOfBasisOfKernels)
{
  with_degree(GetParam(), [&](const auto degree) {
    constexpr int p = decltype(degree)::value;
    constexpr int n = bernstein::size<p>;
    for (int i = 0; i < n; ++i)
      {
        Simd<double> u[n] = {}, v[n] = {};
        u[i] = v[i] = broadcast(1.);
        BasisChange<p, double>::to_bernstein(u);
        BasisChange<p, double>::to_lagrange_transposed(v);
        for (int j = 0; j < n; ++j)
          {
            expect_same(u[j],
                        broadcast(bernstein::from_lagrange<p>[j][i]),
                        1e-14);
            expect_same(v[j],
                        broadcast(bernstein::from_lagrange<p>[i][j]),
                        1e-14);
          }
      }
  });
}

// Derivatives at the centre, and means of products, compared with exact
// quadrature.
TEST_P(BernsteinTest, DerivativesAndIntegrals)
{
  const ReferenceElement reference(GetParam());
  with_degree(GetParam(), [&](const auto degree) {
    constexpr int p = decltype(degree)::value;
    const auto   &d = bernstein::centre_derivatives<p>;
    const auto   &m = bernstein::diagonal_products<p>;
    for (int i = 0; i < bernstein::size<p>; ++i)
      {
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(d[i][k + 1] - d[i][0],
                      reference.centre.gradients(0, i, k),
                      1e-14);
        EXPECT_NEAR(m.mass[i], reference.mass(i, i), 1e-15);
        const double *g = &reference.gradient_products(i, i, 0);
        EXPECT_NEAR(m.gradient[i][0], g[0], 1e-14);
        EXPECT_NEAR(m.gradient[i][1], g[4], 1e-14);
        EXPECT_NEAR(m.gradient[i][2], g[8], 1e-14);
        EXPECT_NEAR(m.gradient[i][3], g[5] + g[7], 1e-14);
        EXPECT_NEAR(m.gradient[i][4], g[2] + g[6], 1e-14);
        EXPECT_NEAR(m.gradient[i][5], g[1] + g[3], 1e-14);
      }
  });
}

INSTANTIATE_TEST_SUITE_P(Degree, BernsteinTest, testing::Values(1u, 2u, 3u));
