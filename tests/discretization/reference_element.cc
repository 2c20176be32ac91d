// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The tables on the reference tetrahedron against exact integrals.

#include <corotet/discretization/finite_element.h>
#include <corotet/discretization/reference_element.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../body.h"

using corotet::Element;
using corotet::finite_element;
using corotet::ReferenceElement;

namespace
{
  double
  factorial(const unsigned int n)
  {
    return n < 2 ? 1. : n * factorial(n - 1);
  }

  // The largest error of the rule for the means of all monomials of degree up
  // to @p degree, which are 6 i! j! k! / (i + j + k + 3)!.
  double
  rule_error(const ReferenceElement::PointValues &rule,
             const unsigned int                   degree)
  {
    double largest = 0;
    for (unsigned int i = 0; i <= degree; ++i)
      for (unsigned int j = 0; i + j <= degree; ++j)
        for (unsigned int k = 0; i + j + k <= degree; ++k)
          {
            double sum = 0;
            for (unsigned int q = 0; q < rule.weights.size(); ++q)
              sum += rule.weights[q] * std::pow(rule.points[q][0], i) *
                     std::pow(rule.points[q][1], j) *
                     std::pow(rule.points[q][2], k);
            largest = std::max(largest,
                               std::abs(sum - 6 * factorial(i) * factorial(j) *
                                                factorial(k) /
                                                factorial(i + j + k + 3)));
          }
    return largest;
  }
} // namespace

class ReferenceElementTest : public testing::TestWithParam<Element>
{};

// The stiffness rule integrates products of gradients, of degree 2(p-1), and
// the load rule products of shape functions. The tolerance is the round-off of
// a sum of up to 35 terms with weights of 16 digits.
TEST_P(ReferenceElementTest, RulesAreExact)
{
  const ReferenceElement element(GetParam());
  const unsigned int     p = element.degree;
  EXPECT_LE(rule_error(element.stiffness_rule, 2 * (p - 1)), 4e-15);
  EXPECT_LE(rule_error(element.load_rule, 2 * p), 4e-15);
  const unsigned int n_points[] = {1, 4, 14};
  EXPECT_EQ(element.stiffness_rule.weights.size(),
            GetParam().has_bubbles() ? 14 : n_points[p - 1]);
}

// Shape functions sum to one, their gradients to zero; so do the rows of the
// tables, and all masses together are the whole.
TEST_P(ReferenceElementTest, PartitionOfUnity)
{
  const ReferenceElement element(GetParam());
  for (unsigned int q = 0; q < element.load_rule.weights.size(); ++q)
    {
      double value = 0, gradient = 0;
      for (unsigned int i = 0; i < element.n_nodes; ++i)
        {
          value += element.load_rule.values[q][i];
          for (unsigned int k = 0; k < 3; ++k)
            gradient += element.load_rule.gradients[q][i][k];
        }
      EXPECT_NEAR(value, 1, 1e-14);
      EXPECT_NEAR(gradient, 0, 1e-13);
    }
  double mass = 0;
  for (unsigned int i = 0; i < element.n_nodes; ++i)
    {
      double products = 0;
      for (unsigned int j = 0; j < element.n_nodes; ++j)
        {
          mass += element.mass[i][j];
          products += element.gradient_products[i][j][4];
        }
      EXPECT_NEAR(products, 0, 1e-13);
    }
  EXPECT_NEAR(mass, 1, 1e-14);
}

// The area vectors of the faces of the reference tetrahedron point outwards and
// are half the cross product of the tangents; their sum is zero.
TEST_P(ReferenceElementTest, FacesPointOutwards)
{
  const ReferenceElement element(GetParam());
  dealii::Tensor<1, 3>   sum;
  const unsigned int     p = element.degree;
  for (unsigned int f = 0; f < 4; ++f)
    {
      const auto area = cross_product_3d(element.face_tangents[f][0],
                                         element.face_tangents[f][1]) /
                        2;
      sum += area;
      const dealii::Point<3> centre(0.25, 0.25, 0.25);
      for (const auto &point : element.face_rules[f].points)
        EXPECT_GT((point - centre) * area, 0.);
      EXPECT_EQ(element.face_nodes[f].size(),
                (p + 1) * (p + 2) / 2 + GetParam().has_bubbles());
    }
  EXPECT_LE(sum.norm(), 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Elements,
                         ReferenceElementTest,
                         testing::Values(Element(1),
                                         Element(2),
                                         Element(3),
                                         Element::quadratic_with_bubbles()));

class BubblesTest : public testing::Test
{
protected:
  const Element          quadratic = Element::quadratic_with_bubbles();
  const ReferenceElement element{quadratic};
};

// Quadrature at the nodes: weights are the means of the shape functions, 17/840
// at vertices, 4/105 at edges, 27/280 at faces, 32/105 in the cell (Geevers,
// Mulder, van der Vegt 2018). They are positive; the rule is exact for the
// functions of the element, so up to degree 3, and no further.
TEST_F(BubblesTest, NodalQuadrature)
{
  ReferenceElement::PointValues nodes;
  nodes.points = finite_element(quadratic).get_unit_support_points();
  ASSERT_EQ(nodes.points.size(), 15u);
  for (unsigned int i = 0; i < 15; ++i)
    {
      double mean = 0;
      for (unsigned int j = 0; j < 15; ++j)
        mean += element.mass[i][j];
      nodes.weights.push_back(mean);
      EXPECT_NEAR(mean,
                  i < 4  ? 17. / 840 :
                  i < 10 ? 4. / 105 :
                  i < 14 ? 27. / 280 :
                           32. / 105,
                  1e-15);
    }
  // The round-off of means that are sums of products.
  EXPECT_LE(rule_error(nodes, 3), 4e-15);
  EXPECT_GE(rule_error(nodes, 4), 1e-4);
}

// The stiffness rule is exact for linear functions times gradients, degree 4;
// the load rule for quadratic functions times shape functions; the mass for
// products of two shape functions, degree 8.
TEST_F(BubblesTest, Rules)
{
  EXPECT_LE(rule_error(element.stiffness_rule, 5), 4e-15);
  EXPECT_EQ(element.stiffness_rule.weights.size(), 14u);
  EXPECT_LE(rule_error(element.load_rule, 6), 4e-15);
  // The square of the cell's bubble has the mean 256^2 6 (2!)^4 / 11!.
  EXPECT_NEAR(element.mass[14][14], 65536. * 6 * 16 / factorial(11), 1e-15);
}

// Only the shape functions of a face's own seven nodes do not vanish on it.
TEST_F(BubblesTest, FaceNodes)
{
  for (unsigned int f = 0; f < 4; ++f)
    {
      const auto &values = element.face_rules[f].values;
      const auto &nodes  = element.face_nodes[f];
      EXPECT_EQ(nodes.size(), 7u);
      for (unsigned int i = 0; i < 15; ++i)
        {
          double largest = 0;
          for (unsigned int q = 0; q < values.size(0); ++q)
            largest = std::max(largest, std::abs(values[q][i]));
          if (std::find(nodes.begin(), nodes.end(), i) != nodes.end())
            EXPECT_GT(largest, 0.1);
          else
            EXPECT_LE(largest, 1e-15);
        }
    }
}

// For degree 1, M_ij is (1 + delta_ij) / 20 of the cell's mass.
TEST(ReferenceElement, LinearMass)
{
  const ReferenceElement element(1);
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int j = 0; j < 4; ++j)
      EXPECT_NEAR(element.mass[i][j], (i == j ? 2. : 1.) / 20, 1e-16);
}
