// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Derivatives at quadrature points from their Bernstein form, compared with
// those of the shape functions, and the transposes.

#include <corotet/discretization/reference_element.h>
#include <corotet/operators/derivative_form.h>

#include <gtest/gtest.h>

#include "lanes.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  using V = Simd<double>;

  // The tolerance: some hundred products of numbers of size one; for degree 3,
  // derivatives are up to ten times as large.
  constexpr double tolerance = 1e-13;

  template <int n>
  void
  compare(const ReferenceElement::PointValues &rule)
  {
    using Form         = DerivativeForm<n>;
    const int n_points = rule.weights.size();
    using Derivatives  = V[Form::max_points][9];
    ASSERT_LE(n_points, Form::max_points);
    V u[n][3];
    for (int ia = 0; ia < 3 * n; ++ia)
      u[ia / 3][ia % 3] = some_numbers(ia);
    typename Form::Coefficients c;
    Derivatives                 found;
    Form::from_nodes(u, c);
    Form::evaluate(rule, c, found);
    Derivatives given;
    for (int l = 0; l < 9 * n_points; ++l)
      given[l / 9][l % 9] = some_numbers(1000 + l);
    const auto sum_up = [&](const auto weighted, V(&f)[n][3]) {
      typename Form::Coefficients sums;
      Form::template sum_up<decltype(weighted)::value>(rule, given, sums);
      Form::add_to_nodes(sums, f);
    };
    V f[n][3] = {}, weighted_f[n][3] = {};
    sum_up(std::false_type(), f);
    if constexpr (Form::has_coefficients)
      sum_up(std::true_type(), weighted_f);

    V expected_f[n][3] = {}, expected_weighted_f[n][3] = {};
    for (int q = 0; q < n_points; ++q)
      for (int ak = 0; ak < 9; ++ak)
        {
          V expected{};
          for (int i = 0; i < n; ++i)
            {
              const double dN = rule.gradients(q, i, ak % 3);
              expected += dN * u[i][ak / 3];
              expected_f[i][ak / 3] += dN * given[q][ak];
              expected_weighted_f[i][ak / 3] +=
                rule.weights[q] * dN * given[q][ak];
            }
          expect_same(found[q][ak], expected, tolerance);
        }
    for (int ia = 0; ia < 3 * n; ++ia)
      {
        expect_same(f[ia / 3][ia % 3], expected_f[ia / 3][ia % 3], tolerance);
        if constexpr (Form::has_coefficients)
          expect_same(weighted_f[ia / 3][ia % 3],
                      expected_weighted_f[ia / 3][ia % 3],
                      tolerance);
      }
  }

  /// Compares the forms for the rules of straight and of curved cells.
  template <int n>
  void
  compare(const Element element)
  {
    compare<n>(ReferenceElement::of(element).stiffness_rule);
    compare<n>(ReferenceElement::curved_rule(element));
  }
} // namespace

TEST(DerivativeForm, IsThatOfTheShapeFunctions)
{
  compare<4>(Element(1));
  compare<10>(Element(2));
  compare<20>(Element(3));
  compare<15>(Element::quadratic_with_bubbles());
}
