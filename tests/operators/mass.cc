// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Mass matrices compared with the exact shares in theory.md (HRZ and row sums),
// and the total mass.

#include <corotet/operators/mass.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "../body.h"
#include "../refusal.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  std::vector<double>
  sorted_shares(const unsigned int degree, const MassType type)
  {
    std::vector<double> shares = lumped_shares(ReferenceElement(degree), type);
    std::sort(shares.begin(), shares.end());
    return shares;
  }
} // namespace

// The shares of diagonal scaling: vertices 1/4 for degree 1; 1/36 and edges
// 4/27 for degree 2; 1/193, edges 27/772 and faces 27/193 for degree 3.
TEST(Mass, DiagonalScalingShares)
{
  const auto p1 = sorted_shares(1, MassType::diagonal_scaling);
  const auto p2 = sorted_shares(2, MassType::diagonal_scaling);
  const auto p3 = sorted_shares(3, MassType::diagonal_scaling);
  for (const double share : p1)
    EXPECT_NEAR(share, 1. / 4, 1e-15);
  for (unsigned int i = 0; i < 10; ++i)
    EXPECT_NEAR(p2[i], i < 4 ? 1. / 36 : 4. / 27, 1e-15);
  for (unsigned int i = 0; i < 20; ++i)
    EXPECT_NEAR(p3[i],
                i < 4  ? 1. / 193 :
                i < 16 ? 27. / 772 :
                         27. / 193,
                1e-15);
}

// Row sums are 1/4 for degree 1; for higher degrees -1/20 (vertices) and 0
// (edges) occur, which are refused.
TEST(Mass, RowSumsAreRefusedForDegree2And3)
{
  for (const double share : sorted_shares(1, MassType::row_sum))
    EXPECT_NEAR(share, 1. / 4, 1e-15);
  EXPECT_EQ(refusal([] { sorted_shares(2, MassType::row_sum); }),
            "Discretization/Mass: row-sum lumping with degree 2 gives some "
            "nodes the share -0.05 of a cell's mass, and a mass must be "
            "positive; found 'row sum', allowed: 'nodal quadrature', "
            "'diagonal scaling' or 'consistent' (or degree 1)");
  EXPECT_EQ(refusal([] { sorted_shares(3, MassType::row_sum); }),
            "Discretization/Mass: row-sum lumping with degree 3 gives some "
            "nodes the share 0 of a cell's mass, and a mass must be positive; "
            "found 'row sum', allowed: 'diagonal scaling' or 'consistent' (or "
            "degree 1)");
}

// The shares of quadrature at the nodes are its published weights.
TEST(Mass, NodalQuadratureShares)
{
  const std::vector<double> shares =
    lumped_shares(ReferenceElement(Element::quadratic_with_bubbles()),
                  MassType::nodal_quadrature);
  ASSERT_EQ(shares.size(), 15u);
  for (unsigned int i = 0; i < 15; ++i)
    EXPECT_NEAR(shares[i],
                i < 4  ? 17. / 840 :
                i < 10 ? 4. / 105 :
                i < 14 ? 27. / 280 :
                         32. / 105,
                1e-15);
}

class MassTest
  : public testing::TestWithParam<std::tuple<unsigned int, std::string>>
{};

// The box has 2 m^3 of 3 kg/m^3. M times a constant acceleration gives the
// total mass. The consistent M is exact for linear fields, and so is quadrature
// at the nodes, of degree 3: int rho x y over the box.
TEST_P(MassTest, TotalAndMoments)
{
  const auto &[degree, type] = GetParam();
  MovingBody  body(box("1, 2, 1", "2, 3, 2", 0.2),
                  element_text(degree, type) +
                    section("Material", {{"Density", 3}}));
  const Mass &mass = body.mass;
  EXPECT_NEAR(mass.total(), 6, 1e-13);
  const Vector one = body.interpolate(
    [](const Point<3> &) { return Tensor<1, 3>({1., 0., 0.}); });
  Vector product(body.state.u);
  mass.apply(product, one);
  EXPECT_NEAR(product * one, 6, 1e-13);
  double smallest = 1;
  for (unsigned int i = 0; i < product.locally_owned_size(); ++i)
    smallest = std::min(smallest, mass.diagonal().local_element(i));
  EXPECT_GT(smallest, 0.);

  // Masses that are lumped without regard to moments are not exact here.
  if (type != "consistent" && type != "nodal quadrature")
    return;
  const Vector x = body.interpolate(
    [](const Point<3> &p) { return Tensor<1, 3>({p[0], p[1], 0.}); });
  const Vector y = body.interpolate(
    [](const Point<3> &p) { return Tensor<1, 3>({p[1], p[1], 0.}); });
  mass.apply(product, x);
  // int x y = 1/2 * 2, int y^2 = 8/3.
  EXPECT_NEAR(product * y, 3 * (1. + 8. / 3), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
  DegreesAndTypes,
  MassTest,
  testing::Values(std::make_tuple(1u, "consistent"),
                  std::make_tuple(2u, "consistent"),
                  std::make_tuple(3u, "consistent"),
                  std::make_tuple(1u, "row sum"),
                  std::make_tuple(1u, "diagonal scaling"),
                  std::make_tuple(2u, "diagonal scaling"),
                  std::make_tuple(2u, "nodal quadrature"),
                  std::make_tuple(3u, "diagonal scaling")));
