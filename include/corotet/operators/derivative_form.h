// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_derivative_form_h
#define corotet_operators_derivative_form_h

#include <corotet/operators/basis_change.h>
#include <corotet/operators/cell_rule.h>
#include <corotet/operators/orbit_form.h>

namespace corotet
{
  /// Computes derivatives by the reference coordinates, [3 component + k], from
  /// those of the n shape functions at a point, [node][k], and nodal values.
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

  /// The transpose of derivatives_of(): adds to nodal values.
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
   * points, and the transposed operation; one cell per lane, for elements of n
   * nodes. A Rule is one of cell_rule.h.
   *
   * Derivatives have coefficients [polynomial][3 component + k] that are
   * computed once for all points: in Bernstein form, those of a polynomial of
   * degree p are differences of its coefficients, of degree p - 1 (see
   * FactoredKernel), and their values at the points of an orbit share most of
   * their sums (see OrbitSums).
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

    using V      = Simd<double>;
    using Change = BasisChange<degree, double>;

  public:
    static constexpr int n_polynomials = bernstein::size<degree - 1>;
    static constexpr int max_points = ReferenceElement::max_stiffness_points(n);
    /// Whether the coefficients are those of derivatives, and not nodal values.
    static constexpr bool has_coefficients = true;

    using NodalValues  = V[n][3];
    using Coefficients = V[n_polynomials][9];

    /// Computes coefficients from nodal values.
    static COROTET_ALWAYS_INLINE void
    from_nodes(const NodalValues &u, Coefficients &c)
    {
      repeat<degree, 3>([&](const auto a) {
        V b[n];
        static_for<n>([&](auto i) { b[i] = u[i][a]; });
        Change::to_bernstein(b);
        static_for<n_polynomials>([&](auto i) {
          constexpr auto &next = bernstein::raised<degree - 1>[i];
          static_for<3>(
            [&](auto k) { c[i][3 * a + k] = b[next[k + 1]] - b[next[0]]; });
        });
      });
    }

    /// The transpose of from_nodes(): adds to nodal values.
    static COROTET_ALWAYS_INLINE void
    add_to_nodes(const Coefficients &c, NodalValues &f)
    {
      repeat<degree, 3>([&](const auto a) {
        V b[n] = {};
        static_for<n_polynomials>([&](auto i) {
          constexpr auto &next = bernstein::raised<degree - 1>[i];
          static_for<3>([&](auto k) {
            b[next[k + 1]] += c[i][3 * a + k];
            b[next[0]] -= c[i][3 * a + k];
          });
        });
        Change::to_lagrange_transposed(b);
        static_for<n>([&](auto i) { f[i][a] += b[i]; });
      });
    }

    /// Derivatives at all points, [point][3 component + k].
    template <typename Rule>
    static COROTET_ALWAYS_INLINE void
    evaluate(const Rule         &rule,
             const Coefficients &c,
             V (&derivatives)[max_points][9])
    {
      if constexpr (degree == 1)
        for (unsigned int q = 0; q < n_points(rule); ++q)
          static_for<9>([&](auto ak) { derivatives[q][ak] = c[0][ak]; });
      else
        for (int ak = 0; ak < 9; ++ak)
          {
            V own[n_polynomials];
            static_for<n_polynomials>([&](auto i) { own[i] = c[i][ak]; });
            const OrbitSums<n_polynomials> sums(own);
            unsigned int                   q = 0;
            for (const PointOrbit &orbit : orbits_of(rule))
              {
                sums.evaluate(orbit, [&](const int i) -> V & {
                  return derivatives[q + i][ak];
                });
                q += orbit.n_points();
              }
          }
    }

    /// The transpose of evaluate(); with the weights of the points if
    /// @p weighted.
    template <bool weighted, typename Rule>
    static COROTET_ALWAYS_INLINE void
    sum_up(const Rule &rule,
           const V (&derivatives)[max_points][9],
           Coefficients &c)
    {
      if constexpr (degree == 1)
        static_for<9>([&](auto ak) {
          V sum{};
          for (unsigned int q = 0; q < n_points(rule); ++q)
            sum += weighted ? weight_at(rule, q) * derivatives[q][ak] :
                              derivatives[q][ak];
          c[0][ak] = sum;
        });
      else
        for (int ak = 0; ak < 9; ++ak)
          {
            OrbitSums<n_polynomials> sums;
            unsigned int             q = 0;
            for (const PointOrbit &orbit : orbits_of(rule))
              {
                sums.add(orbit,
                         weighted ? orbit.weighted_factors : orbit.factors,
                         [&](const int i) -> const V & {
                           return derivatives[q + i][ak];
                         });
                q += orbit.n_points();
              }
            V own[n_polynomials];
            sums.coefficients(own);
            static_for<n_polynomials>([&](auto i) { c[i][ak] = own[i]; });
          }
    }
  };

  /// The form of the quadratic element with bubbles: its derivatives have no
  /// coefficients that are fewer than its nodal values.
  template <>
  class DerivativeForm<15>
  {
    static constexpr int n = 15;

    using V = Simd<double>;

  public:
    static constexpr int max_points = ReferenceElement::max_stiffness_points(n);
    static constexpr bool has_coefficients = false;

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

    template <typename Rule>
    static COROTET_ALWAYS_INLINE void
    evaluate(const Rule         &rule,
             const Coefficients &c,
             V (&derivatives)[max_points][9])
    {
      for (unsigned int q = 0; q < n_points(rule); ++q)
        derivatives_of<n>(derivatives_at(rule, q), c, derivatives[q]);
    }

    template <bool weighted, typename Rule>
    static COROTET_ALWAYS_INLINE void
    sum_up(const Rule &rule,
           const V (&derivatives)[max_points][9],
           Coefficients &c)
    {
      static_assert(!weighted);
      static_for<3 * n>([&](auto ia) { c[ia / 3][ia % 3] = V{}; });
      for (unsigned int q = 0; q < n_points(rule); ++q)
        add_transposed<n>(derivatives_at(rule, q), derivatives[q], c);
    }
  };
} // namespace corotet

#endif
