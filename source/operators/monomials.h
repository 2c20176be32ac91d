// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_operators_monomials_h
#define corotet_source_operators_monomials_h

#include <corotet/discretization/with_degree.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <numbers>
#include <type_traits>

/// Polynomials of up to degree 3, by monomials.
namespace corotet::monomials
{
  constexpr int
  n_coefficients(const int degree)
  {
    return (degree + 1) * (degree + 2) * (degree + 3) / 6;
  }

  template <int degree>
  using Values = std::array<double, n_coefficients(degree)>;

  /**
   * Monomials of a degree and all lower ones at a point, each times the square
   * root of the number of orders of its factors. So a rotation of the point is
   * a rotation of the monomials of each degree, and eigenvalues of their
   * products do not depend on the coordinates.
   */
  template <int degree>
  Values<degree>
  at(const dealii::Tensor<1, 3> &point)
  {
    static_assert(degree >= 0 && degree <= 3);
    constexpr double root_2 = std::numbers::sqrt2, root_3 = std::numbers::sqrt3,
                     root_6 = root_2 * root_3;
    const double   x = point[0], y = point[1], z = point[2];
    Values<degree> result;
    result[0] = 1;
    if constexpr (degree > 0)
      {
        result[1] = x;
        result[2] = y;
        result[3] = z;
      }
    if constexpr (degree > 1)
      {
        result[4] = x * x;
        result[5] = root_2 * x * y;
        result[6] = root_2 * x * z;
        result[7] = y * y;
        result[8] = root_2 * y * z;
        result[9] = z * z;
      }
    if constexpr (degree > 2)
      {
        result[10] = x * x * x;
        result[11] = root_3 * x * x * y;
        result[12] = root_3 * x * x * z;
        result[13] = root_3 * x * y * y;
        result[14] = root_6 * x * y * z;
        result[15] = root_3 * x * z * z;
        result[16] = y * y * y;
        result[17] = root_3 * y * y * z;
        result[18] = root_3 * y * z * z;
        result[19] = z * z * z;
      }
    return result;
  }



  /// Calls @p function with std::integral_constant<int, degree>, degree 0 to 3.
  template <typename Function>
  void
  with_degree(const unsigned int degree, const Function &function)
  {
    if (degree == 0)
      function(std::integral_constant<int, 0>());
    else
      corotet::with_degree(degree, function);
  }
} // namespace corotet::monomials

#endif
