// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Derivatives at quadrature points by way of their Bernstein form against those
// of the shape functions, and the transpose of both.

#include <corotet/discretization/reference_element.h>
#include <corotet/operators/derivative_form.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace corotet;

namespace
{
  using V = Simd<double>;

  /// Numbers without a pattern, other ones in each lane.
  V
  some_numbers(const int i)
  {
    V result;
    for (int lane = 0; lane < n_lanes<double>; ++lane)
      result[lane] = std::sin(1.7 * i + 0.3 * lane + 1);
    return result;
  }

  void
  expect_same(const V &a, const V &b)
  {
    // Some hundred products of numbers of size one, of which derivatives of
    // degree 3 are up to ten times as large.
    for (int lane = 0; lane < n_lanes<double>; ++lane)
      EXPECT_NEAR(a[lane], b[lane], 1e-13);
  }

  template <int n, int n_points>
  void
  compare_at_points(const ReferenceElement::PointValues &rule,
                    const unsigned int                   q)
  {
    using Form = DerivativeForm<n>;
    V u[n][3];
    for (int ia = 0; ia < 3 * n; ++ia)
      u[ia / 3][ia % 3] = some_numbers(ia);
    typename Form::Coefficients c;
    V                           found[n_points][9];
    Form::from_nodes(u, c);
    Form::template evaluate<n_points>(rule, q, c, found);
    V given[n_points][9];
    for (int l = 0; l < 9 * n_points; ++l)
      given[l / 9][l % 9] = some_numbers(1000 + l);
    V                           f[n][3] = {};
    typename Form::Coefficients sums{};
    Form::template add<n_points>(rule, q, given, sums);
    Form::add_to_nodes(sums, f);

    V expected_f[n][3] = {};
    for (int j = 0; j < n_points; ++j)
      for (int ak = 0; ak < 9; ++ak)
        {
          V expected{};
          for (int i = 0; i < n; ++i)
            {
              const double dN = rule.gradients(q + j, i, ak % 3);
              expected += dN * u[i][ak / 3];
              expected_f[i][ak / 3] += dN * given[j][ak];
            }
          expect_same(found[j][ak], expected);
        }
    for (int ia = 0; ia < 3 * n; ++ia)
      expect_same(f[ia / 3][ia % 3], expected_f[ia / 3][ia % 3]);
  }

  template <int n>
  void
  compare(const Element element)
  {
    const auto &rule = ReferenceElement::of(element).stiffness_rule;
    for (unsigned int q = 0; q < rule.weights.size(); ++q)
      compare_at_points<n, 1>(rule, q);
    for (unsigned int q = 0; q + 1 < rule.weights.size(); ++q)
      compare_at_points<n, 2>(rule, q);
  }
} // namespace

TEST(DerivativeForm, IsThatOfTheShapeFunctions)
{
  compare<4>(Element(1));
  compare<10>(Element(2));
  compare<20>(Element(3));
  compare<15>(Element::quadratic_with_bubbles());
}
