// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_derivative_form_h
#define corotet_operators_derivative_form_h

#include <corotet/operators/cell_rule.h>
#include <corotet/operators/factored_kernel.h>

namespace corotet
{
  /// Derivatives by the reference coordinates, [3 component + k], from those of
  /// the n shape functions at a point, [node][k], and nodal values.
  template <int n>
  COROTET_ALWAYS_INLINE void
  derivatives_of(const double *dN,
                 const Simd<double> (&u)[n][3],
                 Simd<double> (&result)[9])
  {
    Simd<double> sum[9] = {};
    static_for<n>([&](auto i) {
      static_for<9>(
        [&](auto ak) { sum[ak] += dN[3 * i + ak % 3] * u[i][ak / 3]; });
    });
    static_for<9>([&](auto ak) { result[ak] = sum[ak]; });
  }

  /// Adds to nodal values what derivatives_of() makes of them, transposed.
  template <int n>
  COROTET_ALWAYS_INLINE void
  add_transposed(const double *dN,
                 const Simd<double> (&derivatives)[9],
                 Simd<double> (&f)[n][3])
  {
    static_for<n>([&](auto i) {
      static_for<9>(
        [&](auto ak) { f[i][ak / 3] += dN[3 * i + ak % 3] * derivatives[ak]; });
    });
  }

  /**
   * Derivatives of nodal values by the reference coordinates at quadrature
   * points, and the transpose of that; one cell per lane, for elements of n
   * nodes. A Rule is one of cell_rule.h.
   *
   * Derivatives have a form of their own, with coefficients
   * [polynomial][3 component + k] that are made once for all points: those of a
   * polynomial of degree p are, in Bernstein form, differences of its
   * coefficients, of degree p - 1 (see FactoredKernel). At a point they take
   * 10 numbers for each derivative in place of 20 at degree 3, 4 in place of 10
   * at degree 2.
   */
  template <int n>
  class DerivativeForm
  {
    static constexpr int degree = [] {
      int p = 1;
      while ((p + 1) * (p + 2) * (p + 3) / 6 < n)
        ++p;
      return p;
    }();
    static_assert(n == bernstein::size<degree>);

    using V    = Simd<double>;
    using Cell = FactoredKernel<degree, double>;

  public:
    static constexpr int n_polynomials = bernstein::size<degree - 1>;

    using NodalValues  = V[n][3];
    using Coefficients = V[n_polynomials][9];

    /// From nodal values.
    static COROTET_ALWAYS_INLINE void
    from_nodes(const NodalValues &u, Coefficients &c)
    {
      NodalValues b;
      static_for<3 * n>(
        [&](auto ia) { b[ia / 3][ia % 3] = u[ia / 3][ia % 3]; });
      Cell::to_bernstein(b);
      static_for<n_polynomials>([&](auto i) {
        constexpr auto &next = bernstein::raised<degree - 1>[i];
        static_for<9>([&](auto ak) {
          constexpr int a = ak / 3, k = ak % 3;
          c[i][ak] = b[next[k + 1]][a] - b[next[0]][a];
        });
      });
    }

    /// Adds to nodal values what from_nodes() makes of them, transposed.
    static COROTET_ALWAYS_INLINE void
    add_to_nodes(const Coefficients &c, NodalValues &f)
    {
      NodalValues b{};
      static_for<n_polynomials>([&](auto i) {
        constexpr auto &next = bernstein::raised<degree - 1>[i];
        static_for<9>([&](auto ak) {
          constexpr int a = ak / 3, k = ak % 3;
          b[next[k + 1]][a] += c[i][ak];
          b[next[0]][a] -= c[i][ak];
        });
      });
      Cell::to_lagrange_transposed(b);
      static_for<3 * n>(
        [&](auto ia) { f[ia / 3][ia % 3] += b[ia / 3][ia % 3]; });
    }

    /// Derivatives at the @p n_points points from @p q on, [point][3 component
    /// + k].
    template <int n_points, typename Rule>
    static COROTET_ALWAYS_INLINE void
    evaluate(const Rule         &rule,
             const unsigned int  q,
             const Coefficients &c,
             V (*derivatives)[9])
    {
      const double *basis[n_points];
      static_for<n_points>(
        [&](auto j) { basis[j] = derivative_basis_at(rule, q + j); });
      V sums[n_points][9] = {};
      static_for<n_polynomials>([&](auto i) {
        static_for<9>([&](auto ak) {
          const V coefficient = c[i][ak];
          static_for<n_points>(
            [&](auto j) { sums[j][ak] += basis[j][i] * coefficient; });
        });
      });
      static_for<9 * n_points>(
        [&](auto l) { derivatives[l / 9][l % 9] = sums[l / 9][l % 9]; });
    }

    /// Adds to coefficients what evaluate() makes of them, transposed.
    template <int n_points, typename Rule>
    static COROTET_ALWAYS_INLINE void
    add(const Rule        &rule,
        const unsigned int q,
        const V (*derivatives)[9],
        Coefficients &c)
    {
      const double *basis[n_points];
      V             own[n_points][9];
      static_for<n_points>([&](auto j) {
        basis[j] = derivative_basis_at(rule, q + j);
        static_for<9>([&](auto ak) { own[j][ak] = derivatives[j][ak]; });
      });
      static_for<n_polynomials>([&](auto i) {
        static_for<9>([&](auto ak) {
          V sum = c[i][ak];
          static_for<n_points>(
            [&](auto j) { sum += basis[j][i] * own[j][ak]; });
          c[i][ak] = sum;
        });
      });
    }
  };

  /// The quadratic element with bubbles: its derivatives have no form that is
  /// shorter than its nodal values.
  template <>
  class DerivativeForm<15>
  {
    static constexpr int n = 15;

    using V = Simd<double>;

  public:
    using NodalValues  = V[n][3];
    using Coefficients = NodalValues;

    static COROTET_ALWAYS_INLINE void
    from_nodes(const NodalValues &u, Coefficients &c)
    {
      static_for<3 * n>(
        [&](auto ia) { c[ia / 3][ia % 3] = u[ia / 3][ia % 3]; });
    }

    static COROTET_ALWAYS_INLINE void
    add_to_nodes(const Coefficients &c, NodalValues &f)
    {
      static_for<3 * n>(
        [&](auto ia) { f[ia / 3][ia % 3] += c[ia / 3][ia % 3]; });
    }

    template <int n_points, typename Rule>
    static COROTET_ALWAYS_INLINE void
    evaluate(const Rule         &rule,
             const unsigned int  q,
             const Coefficients &c,
             V (*derivatives)[9])
    {
      static_for<n_points>([&](auto j) {
        derivatives_of<n>(derivatives_at(rule, q + j), c, derivatives[j]);
      });
    }

    template <int n_points, typename Rule>
    static COROTET_ALWAYS_INLINE void
    add(const Rule        &rule,
        const unsigned int q,
        const V (*derivatives)[9],
        Coefficients &c)
    {
      static_for<n_points>([&](auto j) {
        add_transposed<n>(derivatives_at(rule, q + j), derivatives[j], c);
      });
    }
  };
} // namespace corotet

#endif
