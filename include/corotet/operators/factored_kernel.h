// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_factored_kernel_h
#define corotet_operators_factored_kernel_h

#include <corotet/base/simd.h>
#include <corotet/operators/basis_change.h>

namespace corotet
{
  /**
   * The data of n_lanes<T> cells for the factored kernel.
   *
   * An isotropic law does not depend on the directions in which strains are
   * measured, so R K0(grad lambda) R^T = K0(R grad lambda): the rotation of a
   * cell costs nothing once the gradients of its barycentric coordinates are
   * rotated. Lanes without a cell have zeros.
   */
  template <typename T>
  struct alignas(sizeof(Simd<T>)) CellCoefficients
  {
    /// sqrt(mu volume) R grad lambda_k for k = 1, 2, 3: [3 (k - 1) +
    /// component].
    T gradients[9][n_lanes<T>];
    /// lambda / mu [-].
    T lame_ratio[n_lanes<T>];
  };

  /// Masses of n_lanes<T> cells, density times volume [kg].
  template <typename T>
  struct alignas(sizeof(Simd<T>)) CellMasses
  {
    T mass[n_lanes<T>];
  };

  /**
   * Linear forms of n_lanes<T> straight-sided cells of degree p, exactly and
   * without quadrature. Nodal values are arrays [node][component].
   *
   * With u = sum_alpha c_alpha B_alpha in Bernstein form,
   *
   *   grad u = p sum_beta B_beta sum_k (c_{beta + e_k} - c_{beta + e_0}) (x)
   *            grad lambda_k
   *
   * over the multi-indices beta of degree p - 1: differences of neighbouring
   * coefficients. Stress has the same form, its integral against grad v needs
   * the mass matrix of degree p - 1, and the rest is the transpose. With
   * Vandermonde's identity the products of binomials in a mass matrix factor
   * into
   *
   *   M_n = I + U_n (I + 1/4 U_{n-1} (I + 1/9 U_{n-2} (..) U_{n-2}^T)
   *         U_{n-1}^T) U_n^T,
   *
   * where U_n raises the degree from n - 1 to n: it takes B_alpha's coefficient
   * from those of alpha - e_i with the weight alpha_i. (For the fraction 1/k^2:
   * k steps reach the same multi-index on k! ways, and M needs each product of
   * binomials once.)
   */
  template <int p, typename T>
  class FactoredKernel
  {
  public:
    using V = Simd<T>;

    static constexpr int n_nodes = bernstein::size<p>;
    /// Number of Bernstein polynomials of the gradient.
    static constexpr int n_gradients = bernstein::size<p - 1>;

    using NodalValues = V[n_nodes][3];
    /// Components xx, yy, zz, yz, xz, xy.
    using Strain = V[6];

    /// The stiffness form comes out divided by this number.
    static constexpr double stiffness_scale =
      p * p * bernstein::mass_scale(p - 1);
    /// The mass form comes out divided by this number.
    static constexpr double mass_scale = bernstein::mass_scale(p);
    /// The unit of offsets is sqrt(mu volume) times this number.
    static constexpr double strain_scale = 1. / p;

    static constexpr auto &diagonal_products = bernstein::diagonal_products<p>;

    /**
     * v = K u / stiffness_scale + M u / mass_scale, or one of the terms.
     * @p u is overwritten; @p masses are those of the cells, @p cell is not
     * used without stiffness.
     *
     * @p offset is a strain that is added to that of u; both are sqrt(mu
     * volume) strain_scale times strain, with twice the shear strain.
     */
    template <bool with_stiffness, bool with_mass, bool with_offset = false>
    static COROTET_ALWAYS_INLINE void
    apply(const CellCoefficients<T> *cell,
          const V                    masses,
          const Strain              *offset,
          NodalValues               &u,
          NodalValues               &v)
    {
      to_bernstein(u);
      if constexpr (with_mass)
        {
          repeat<p, 3>([&](const auto a) {
            V c[n_nodes];
            static_for<n_nodes>([&](auto i) { c[i] = u[i][a]; });
            apply_mass<p, 1>(c);
            static_for<n_nodes>([&](auto i) { v[i][a] = masses * c[i]; });
          });
        }
      else
        static_for<n_nodes>(
          [&](auto i) { static_for<3>([&](auto a) { v[i][a] = V{}; }); });
      if constexpr (with_stiffness)
        {
          Strain sigma[n_gradients];
          compute_stress<with_offset>(*cell, offset, u, sigma);
          repeat<p, 6>([&](const auto s) {
            V c[n_gradients];
            static_for<n_gradients>([&](auto b) { c[b] = sigma[b][s]; });
            apply_mass<p - 1, 1>(c);
            static_for<n_gradients>([&](auto b) { sigma[b][s] = c[b]; });
          });
          add_divergence(*cell, sigma, v);
        }
      to_lagrange_transposed(v);
    }

    /**
     * Derivatives of u by lambda_k - lambda_0 at the barycentre,
     * [component][k - 1].
     */
    static COROTET_ALWAYS_INLINE void
    centre_gradient(const NodalValues &u, V (&gradient)[3][3])
    {
      static_for<3>([&](auto a) {
        static_for<3>([&](auto k) {
          V sum{};
          static_for<n_nodes>([&](auto i) {
            constexpr double weight =
              bernstein::centre_derivatives<p>[i][k + 1] -
              bernstein::centre_derivatives<p>[i][0];
            if constexpr (weight > 1e-12 || weight < -1e-12)
              sum += T(weight) * u[i][a];
          });
          gradient[a][k] = sum;
        });
      });
    }

    /// Bernstein coefficients from values at the nodes.
    static COROTET_ALWAYS_INLINE void
    to_bernstein(NodalValues &u)
    {
      if constexpr (p > 1)
        repeat<p, 3>([&](const auto a) {
          V c[n_nodes];
          static_for<n_nodes>([&](auto i) { c[i] = u[i][a]; });
          BasisChange<p, T>::to_bernstein(c);
          // Coefficients at the vertices are the values there.
          static_for<n_nodes - 4>([&](auto i) { u[i + 4][a] = c[i + 4]; });
        });
    }

    /// The transpose of to_bernstein().
    static COROTET_ALWAYS_INLINE void
    to_lagrange_transposed(NodalValues &v)
    {
      if constexpr (p > 1)
        repeat<p, 3>([&](const auto a) {
          V c[n_nodes];
          static_for<n_nodes>([&](auto i) { c[i] = v[i][a]; });
          BasisChange<p, T>::to_lagrange_transposed(c);
          static_for<n_nodes>([&](auto i) { v[i][a] = c[i]; });
        });
    }

  protected:
    // c = (I + 1/k^2 U_n (..) U_n^T) c: with k = 1 the mass matrix of degree n.
    template <int n, int k>
    static COROTET_ALWAYS_INLINE void
    apply_mass(V (&c)[bernstein::size<n>])
    {
      if constexpr (n > 0)
        {
          using bernstein::multi_indices;
          using bernstein::raised;
          constexpr int size = bernstein::size<n - 1>;
          V             lower[size];
          static_for<size>([&](auto b) {
            V sum{};
            static_for<4>([&](auto i) {
              add<multi_indices<n - 1>[b][i] + 1>(sum, c[raised<n - 1>[b][i]]);
            });
            lower[b] = sum;
          });
          apply_mass<n - 1, k + 1>(lower);
          static_for<size>([&](auto b) {
            const V scaled = k == 1 ? lower[b] : lower[b] * T(1. / (k * k));
            static_for<4>([&](auto i) {
              add<multi_indices<n - 1>[b][i] + 1>(c[raised<n - 1>[b][i]],
                                                  scaled);
            });
          });
        }
    }

    template <int weight>
    static COROTET_ALWAYS_INLINE void
    add(V &sum, const V x)
    {
      if constexpr (weight == 1)
        sum += x;
      else
        sum += T(weight) * x;
    }

    // Bernstein coefficients of the stress in units of mu.
    template <bool with_offset>
    static COROTET_ALWAYS_INLINE void
    compute_stress(const CellCoefficients<T> &cell,
                   const Strain              *offset,
                   const NodalValues         &c,
                   Strain (&sigma)[n_gradients])
    {
      V g[9];
      static_for<9>(
        [&](auto i) { g[i] = load_aligned<n_lanes<T>>(cell.gradients[i]); });
      const V ratio = load_aligned<n_lanes<T>>(cell.lame_ratio);
      repeat<p, n_gradients>([&](const auto b) {
        const auto &next = bernstein::raised<p - 1>[b];
        V           e[6];
        if constexpr (with_offset)
          static_for<6>([&](auto s) { e[s] = (*offset)[s]; });
        else
          static_for<6>([&](auto s) { e[s] = V{}; });
        static_for<3>([&](auto k) {
          const V x = c[next[k + 1]][0] - c[next[0]][0];
          const V y = c[next[k + 1]][1] - c[next[0]][1];
          const V z = c[next[k + 1]][2] - c[next[0]][2];
          e[0] += x * g[3 * k];
          e[1] += y * g[3 * k + 1];
          e[2] += z * g[3 * k + 2];
          e[3] += y * g[3 * k + 2] + z * g[3 * k + 1];
          e[4] += x * g[3 * k + 2] + z * g[3 * k];
          e[5] += x * g[3 * k + 1] + y * g[3 * k];
        });
        const V pressure = ratio * (e[0] + e[1] + e[2]);
        static_for<3>([&](auto s) { sigma[b][s] = T(2) * e[s] + pressure; });
        static_for<3>([&](auto s) { sigma[b][s + 3] = e[s + 3]; });
      });
    }

    // v_alpha += sum of sigma_beta grad lambda_k over beta + e_k = alpha.
    static COROTET_ALWAYS_INLINE void
    add_divergence(const CellCoefficients<T> &cell,
                   const Strain (&sigma)[n_gradients],
                   NodalValues &v)
    {
      V g[9];
      static_for<9>(
        [&](auto i) { g[i] = load_aligned<n_lanes<T>>(cell.gradients[i]); });
      static_for<n_gradients>([&](auto b) {
        constexpr auto &next   = bernstein::raised<p - 1>[b];
        const V        *s      = sigma[b];
        V               sum[3] = {};
        static_for<3>([&](auto k) {
          const V *h = g + 3 * k;
          const V  x = s[0] * h[0] + s[5] * h[1] + s[4] * h[2];
          const V  y = s[5] * h[0] + s[1] * h[1] + s[3] * h[2];
          const V  z = s[4] * h[0] + s[3] * h[1] + s[2] * h[2];
          v[next[k + 1]][0] += x;
          v[next[k + 1]][1] += y;
          v[next[k + 1]][2] += z;
          sum[0] += x;
          sum[1] += y;
          sum[2] += z;
        });
        static_for<3>([&](auto a) { v[next[0]][a] -= sum[a]; });
      });
    }
  };
} // namespace corotet

#endif
