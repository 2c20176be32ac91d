// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_bernstein_h
#define corotet_discretization_bernstein_h

#include <corotet/discretization/tetrahedron.h>

#include <array>

/**
 * Polynomials on a tetrahedron in Bernstein form, as tables for the compiler.
 *
 * With barycentric coordinates lambda_0..3 the Bernstein polynomials of degree
 * n are B_alpha = n! / alpha! lambda^alpha for the multi-indices alpha of four
 * numbers that sum to n (Lai, Schumaker, Spline functions on triangulations,
 * 2007). Multi-indices are numbered as FE_SimplexP(n) numbers its nodes, which
 * are the points lambda = alpha / n: vertices, edges, faces. So number i means
 * the node i as well as the polynomial i.
 */
namespace corotet::bernstein
{
  using MultiIndex = std::array<int, 4>;

  /// The number of polynomials of degree n: 1, 4, 10, 20.
  template <int n>
  inline constexpr int size = (n + 1) * (n + 2) * (n + 3) / 6;

  /// The multi-indices of degree n <= 3, in the order of the nodes.
  template <int n>
  constexpr std::array<MultiIndex, size<n>>
  make_multi_indices()
  {
    static_assert(n >= 0 && n <= 3);
    std::array<MultiIndex, size<n>> indices{};
    int                             i = 0;
    if (n > 0)
      for (int v = 0; v < 4; ++v)
        indices[i++][v] = n;
    if (n > 1)
      for (const auto &edge : tetrahedron::edges)
        for (int k = 1; k < n; ++k, ++i)
          {
            indices[i][edge[0]] = n - k;
            indices[i][edge[1]] = k;
          }
    if (n > 2)
      for (const auto &face : tetrahedron::faces)
        {
          for (const int v : face)
            indices[i][v] = 1;
          ++i;
        }
    return indices;
  }

  template <int n>
  inline constexpr std::array<MultiIndex, size<n>> multi_indices =
    make_multi_indices<n>();

  template <int n>
  constexpr int
  number_of(const MultiIndex &alpha)
  {
    for (int i = 0; i < size<n>; ++i)
      if (multi_indices<n>[i] == alpha)
        return i;
    return -1;
  }

  /// raised<n>[i][k]: the number in degree n + 1 of the multi-index alpha +
  /// e_k, where alpha has the number i in degree n.
  template <int n>
  constexpr std::array<std::array<int, 4>, size<n>>
  make_raised()
  {
    std::array<std::array<int, 4>, size<n>> result{};
    for (int i = 0; i < size<n>; ++i)
      for (int k = 0; k < 4; ++k)
        {
          MultiIndex alpha = multi_indices<n>[i];
          ++alpha[k];
          result[i][k] = number_of<n + 1>(alpha);
        }
    return result;
  }

  template <int n>
  inline constexpr std::array<std::array<int, 4>, size<n>> raised =
    make_raised<n>();

  constexpr double
  power(const double x, const int n)
  {
    return n == 0 ? 1. : x * power(x, n - 1);
  }

  constexpr double
  binomial(const int n, const int k)
  {
    return k == 0 ? 1. : binomial(n - 1, k - 1) * n / k;
  }

  /// The value of B_alpha at the point with barycentric coordinates lambda.
  constexpr double
  value(const MultiIndex &alpha, const std::array<double, 4> &lambda)
  {
    double result = 1;
    int    sum    = 0;
    for (int k = 0; k < 4; ++k)
      {
        sum += alpha[k];
        result *= binomial(sum, alpha[k]) * power(lambda[k], alpha[k]);
      }
    return result;
  }

  template <int n>
  using Matrix = std::array<std::array<double, size<n>>, size<n>>;

  /// The inverse of a matrix by Gauss-Jordan elimination. Entries that are zero
  /// up to round-off become zero, so that the kernel leaves them out.
  template <int n>
  constexpr Matrix<n>
  inverse(Matrix<n> A)
  {
    constexpr int N = size<n>;
    Matrix<n>     X{};
    for (int i = 0; i < N; ++i)
      X[i][i] = 1;
    for (int k = 0; k < N; ++k)
      {
        // The matrices here are diagonally dominant enough to need no pivoting.
        const double pivot = 1 / A[k][k];
        for (int j = 0; j < N; ++j)
          {
            A[k][j] *= pivot;
            X[k][j] *= pivot;
          }
        for (int i = 0; i < N; ++i)
          if (const double factor = A[i][k]; i != k && factor != 0)
            for (int j = 0; j < N; ++j)
              {
                A[i][j] -= factor * A[k][j];
                X[i][j] -= factor * X[k][j];
              }
      }
    for (auto &row : X)
      for (double &entry : row)
        if (entry < 1e-12 && entry > -1e-12)
          entry = 0;
    return X;
  }

  template <int p>
  constexpr Matrix<p>
  make_from_lagrange()
  {
    Matrix<p> values{};
    for (int i = 0; i < size<p>; ++i)
      for (int j = 0; j < size<p>; ++j)
        {
          std::array<double, 4> lambda{};
          for (int k = 0; k < 4; ++k)
            lambda[k] = double(multi_indices<p>[i][k]) / p;
          values[i][j] = value(multi_indices<p>[j], lambda);
        }
    return inverse<p>(values);
  }

  /// from_lagrange<p>[i][j]: the factor of the value at node j in the Bernstein
  /// coefficient i of a polynomial of degree p.
  template <int p>
  inline constexpr Matrix<p> from_lagrange = make_from_lagrange<p>();

  /**
   * The mean of B_alpha B_beta over the tetrahedron is mass_scale(n) times the
   * product of the four binomials (alpha_i + beta_i choose alpha_i).
   */
  constexpr double
  mass_scale(const int n)
  {
    return 1 / (binomial(2 * n, n) * binomial(2 * n + 3, 3));
  }

  /// centre_derivatives<p>[i][k]: the derivative d N_i / d lambda_k of a
  /// Lagrange polynomial at the barycentre, with all four lambda taken as
  /// independent.
  template <int p>
  constexpr std::array<std::array<double, 4>, size<p>>
  make_centre_derivatives()
  {
    std::array<std::array<double, 4>, size<p>> result{};
    for (int i = 0; i < size<p>; ++i)
      for (int b = 0; b < size<p - 1>; ++b)
        for (int k = 0; k < 4; ++k)
          result[i][k] +=
            p * value(multi_indices<p - 1>[b], { {0.25, 0.25, 0.25, 0.25} }) *
            from_lagrange<p>[raised<p - 1>[b][k]][i];
    return result;
  }

  template <int p>
  inline constexpr std::array<std::array<double, 4>, size<p>>
    centre_derivatives = make_centre_derivatives<p>();
  /// The mean of the product of two Bernstein polynomials of the same degree.
  constexpr double
  mean_product(const MultiIndex &alpha, const MultiIndex &beta)
  {
    int    n       = 0;
    double product = 1;
    for (int k = 0; k < 4; ++k)
      {
        n += alpha[k];
        product *= binomial(alpha[k] + beta[k], alpha[k]);
      }
    return mass_scale(n) * product;
  }

  /// The means of squares of the Lagrange polynomials N_i, and of products of
  /// their derivatives d_k by lambda_k - lambda_0.
  template <int p>
  struct DiagonalProducts
  {
    std::array<double, size<p>> mass{};
    /// The means of d_1 d_1, d_2 d_2, d_3 d_3, 2 d_2 d_3, 2 d_1 d_3, 2 d_1 d_2.
    std::array<std::array<double, 6>, size<p>> gradient{};
  };

  template <int p>
  constexpr DiagonalProducts<p>
  make_diagonal_products()
  {
    DiagonalProducts<p> result;
    for (int a = 0; a < size<p>; ++a)
      for (int b = 0; b < size<p>; ++b)
        {
          const double product =
            mean_product(multi_indices<p>[a], multi_indices<p>[b]);
          for (int i = 0; i < size<p>; ++i)
            result.mass[i] +=
              from_lagrange<p>[a][i] * from_lagrange<p>[b][i] * product;
        }
    constexpr int pairs[6][2] = {
      {1, 1}, {2, 2}, {3, 3}, {2, 3}, {1, 3}, {1, 2}};
    const auto derivative = [](const int i, const int b, const int k) {
      return from_lagrange<p>[raised<p - 1>[b][k]][i] -
             from_lagrange<p>[raised<p - 1>[b][0]][i];
    };
    for (int a = 0; a < size<p - 1>; ++a)
      for (int b = 0; b < size<p - 1>; ++b)
        {
          const double product =
            mean_product(multi_indices<p - 1>[a], multi_indices<p - 1>[b]);
          for (int i = 0; i < size<p>; ++i)
            for (int s = 0; s < 6; ++s)
              result.gradient[i][s] += (s < 3 ? 1 : 2) * p * p * product *
                                       derivative(i, a, pairs[s][0]) *
                                       derivative(i, b, pairs[s][1]);
        }
    return result;
  }

  template <int p>
  inline constexpr DiagonalProducts<p> diagonal_products =
    make_diagonal_products<p>();
} // namespace corotet::bernstein

#endif
