// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_operators_monomials_h
#define corotet_source_operators_monomials_h

#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>

#include <Eigen/Core>

/// Polynomials of up to degree 3, by monomials.
namespace corotet::monomials
{
  /// Of degree 3.
  inline constexpr int max_size = 20;

  using Basis = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_size, 1>;

  constexpr int
  n_coefficients(const unsigned int degree)
  {
    return (degree + 1) * (degree + 2) * (degree + 3) / 6;
  }

  /**
   * Monomials of a degree and all lower ones at @p x, each times the square
   * root of the number of orders that its factors have. So a rotation of x is
   * one of the monomials of each degree, and what eigenvalues of their products
   * tell does not depend on the coordinates.
   */
  inline Basis
  at(const unsigned int degree, const dealii::Tensor<1, 3> &x)
  {
    // 1; x, y, z; xx, xy, xz, yy, yz, zz; xxx, xxy, xxz, xyy, xyz, xzz, yyy,
    // yyz, yzz, zzz.
    constexpr std::array<double, max_size> n_orders{
      {1, 1, 1, 1, 1, 2, 2, 1, 2, 1, 1, 3, 3, 3, 6, 3, 1, 3, 3, 1}};
    Basis result(n_coefficients(degree));
    int   n           = 0;
    result[n++]       = 1;
    int first_of_last = 0;
    // Each degree is x[0] times the one before, x[1] times what has no x[0]
    // there, and x[2] times the last.
    for (unsigned int d = 1; d <= degree; ++d)
      {
        const int                first = n;
        const std::array<int, 3> begins{
          {first_of_last, first - static_cast<int>(d), first - 1}};
        for (unsigned int a = 0; a < 3; ++a)
          for (int i = begins[a]; i < first; ++i)
            result[n++] = x[a] * result[i];
        first_of_last = first;
      }
    for (int i = 0; i < n; ++i)
      result[i] *= std::sqrt(n_orders[i]);
    return result;
  }
} // namespace corotet::monomials

#endif
