// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_factored_tangent_h
#define corotet_operators_factored_tangent_h

#include <corotet/material/rotation_derivative.h>
#include <corotet/operators/factored_kernel.h>

namespace corotet
{
  /**
   * The exact tangent of one rotation per cell, for straight-sided cells of
   * degree p, without quadrature: with a change w of the rotation, one vector
   * for the whole cell, B = F R^T and the stress are still polynomials of
   * degree p - 1, so that all steps of FactoredKernel are the same.
   *
   * The coefficients of B are computed from the displacement in each
   * application: at degree 3 these are 90 numbers, and reading them would take
   * longer. At degree 1 there is one coefficient, and it is kept.
   */
  template <int p>
  class FactoredTangent : private FactoredKernel<p, double>
  {
    using Base = FactoredKernel<p, double>;

  public:
    using V = Simd<double>;
    using Base::n_nodes;
    using typename Base::NodalValues;

    /// f comes out divided by this number.
    static constexpr double scale = Base::stiffness_scale;
    /// The factor of masses.
    static constexpr double mass_scale = Base::mass_scale / scale;
    /// The unit of coefficients of gradients is sqrt(mu volume) times this
    /// number.
    static constexpr double gradient_scale = Base::strain_scale;

    /// Whether B is kept, so that the displacement is not needed.
    static constexpr bool keeps_B = p == 1;

    /// The data of n_lanes<double> cells.
    struct Cells
    {
      /// sqrt(mu volume) R grad lambda_k for k = 1, 2, 3.
      V gradients[9];
      /// lambda / mu [-].
      V lame_ratio;
      /// The product sqrt(mu volume) gradient_scale.
      V size;
      /// B without grad u, which is R^T, times size; all of B if it is kept.
      V B[3][3];
      /// G^{-1}, see rotation_derivative.h, over size.
      V G_inverse[6];
      /// Density times volume times mass_scale [kg], if there is a mass term.
      V masses;
    };

    /**
     * f = (K_T + (@p frozen_factor - 1) K_frozen + M) v / scale, where the
     * derivative of the stress is
     *
     *   dP R^T = sigma(H - W(w) B) + W(w) sigma(B - I),  H = grad v R^T,
     *   G w = a(H) at the centre.
     *
     * @p u, the displacement, is not read if B is kept; @p u and @p v are
     * overwritten.
     */
    template <bool with_mass>
    static COROTET_ALWAYS_INLINE void
    apply(const Cells &cells,
          const double frozen_factor,
          NodalValues &u,
          NodalValues &v,
          NodalValues &f)
    {
      if constexpr (!keeps_B)
        Base::to_bernstein(u);
      Base::to_bernstein(v);
      repeat<p, 3>([&](const auto a) {
        if constexpr (with_mass)
          {
            V c[n_nodes];
            static_for<n_nodes>([&](auto i) { c[i] = v[i][a]; });
            Base::template apply_mass<p, 1>(c);
            static_for<n_nodes>([&](auto i) { f[i][a] = cells.masses * c[i]; });
          }
        else
          static_for<n_nodes>([&](auto i) { f[i][a] = V{}; });
      });
      V w[3];
      change_of_rotation(cells, v, w);
      V P[n_gradients][3][3];
      repeat<p, n_gradients>([&](const auto b) {
        stress_derivative(cells, frozen_factor, b, w, u, v, P[b]);
      });
      repeat<p, 9>([&](const auto ab) {
        V c[n_gradients];
        static_for<n_gradients>([&](auto b) { c[b] = P[b][ab / 3][ab % 3]; });
        Base::template apply_mass<p - 1, 1>(c);
        static_for<n_gradients>([&](auto b) { P[b][ab / 3][ab % 3] = c[b]; });
      });
      static_for<n_gradients>(
        [&](auto b) { add_divergence<b>(cells, P[b], f); });
      Base::to_lagrange_transposed(f);
    }

  private:
    using Base::n_gradients;

    /// H += coefficient b of grad u, rotated.
    static COROTET_ALWAYS_INLINE void
    add_gradient(const Cells       &cells,
                 const int          b,
                 const NodalValues &c,
                 V (&H)[3][3])
    {
      const auto &next = bernstein::raised<p - 1>[b];
      static_for<3>([&](auto k) {
        static_for<3>([&](auto a) {
          const V difference = c[next[k + 1]][a] - c[next[0]][a];
          static_for<3>([&](auto d) {
            H[a][d] += difference * cells.gradients[3 * k + d];
          });
        });
      });
    }

    /// Computes @p w with G w = a(grad v) at the centre.
    static COROTET_ALWAYS_INLINE void
    change_of_rotation(const Cells &cells, const NodalValues &v, V (&w)[3])
    {
      V by_lambda[3][3]{}, H[3][3]{}, a[3];
      static_for<n_gradients>([&](auto b) {
        constexpr auto  &next = bernstein::raised<p - 1>[b];
        constexpr double share =
          bernstein::value(bernstein::multi_indices<p - 1>[b],
                           { {0.25, 0.25, 0.25, 0.25} });
        static_for<9>([&](auto ak) {
          constexpr int a = ak / 3, k = ak % 3;
          by_lambda[a][k] += share * (v[next[k + 1]][a] - v[next[0]][a]);
        });
      });
      static_for<9>([&](auto ad) {
        constexpr int a = ad / 3, d = ad % 3;
        static_for<3>([&](auto k) {
          H[a][d] += by_lambda[a][k] * cells.gradients[3 * k + d];
        });
      });
      axial_vector(H, a);
      symmetric_times(cells.G_inverse, a, w);
    }

    /// Coefficient b of dP R^T in units of mu.
    static COROTET_ALWAYS_INLINE void
    stress_derivative(const Cells &cells,
                      const double frozen_factor,
                      const int    b,
                      const V (&w)[3],
                      const NodalValues &u,
                      const NodalValues &v,
                      V (&P)[3][3])
    {
      V B[3][3], H[3][3]{}, WB[3][3], W_sigma[3][3];
      static_for<9>(
        [&](auto ad) { B[ad / 3][ad % 3] = cells.B[ad / 3][ad % 3]; });
      if constexpr (!keeps_B)
        add_gradient(cells, b, u, B);
      add_gradient(cells, b, v, H);
      skew_times(w, B, WB);
      static_for<9>([&](auto ad) {
        constexpr int a = ad / 3, d = ad % 3;
        P[a][d] = frozen_factor * H[a][d] - WB[a][d];
      });
      stress(cells.lame_ratio, P);
      static_for<3>([&](auto a) { B[a][a] -= cells.size; });
      stress(cells.lame_ratio, B);
      skew_times(w, B, W_sigma);
      static_for<9>(
        [&](auto ad) { P[ad / 3][ad % 3] += W_sigma[ad / 3][ad % 3]; });
    }

    /// A <- A + A^T + ratio tr(A) I: the stress of the strain sym(A).
    static COROTET_ALWAYS_INLINE void
    stress(const V ratio, V (&A)[3][3])
    {
      const V pressure = ratio * (A[0][0] + A[1][1] + A[2][2]);
      static_for<3>([&](auto a) {
        constexpr int b = (a + 1) % 3;
        A[a][a]         = 2. * A[a][a] + pressure;
        A[a][b] += A[b][a];
        A[b][a] = A[a][b];
      });
    }

    /// f_alpha += P grad lambda_k over beta + e_k = alpha.
    template <int b>
    static COROTET_ALWAYS_INLINE void
    add_divergence(const Cells &cells, const V (&P)[3][3], NodalValues &f)
    {
      constexpr auto &next = bernstein::raised<p - 1>[b];
      static_for<3>([&](auto a) {
        V sum{};
        static_for<3>([&](auto k) {
          const V *const g = &cells.gradients[3 * k];
          const V        x = P[a][0] * g[0] + P[a][1] * g[1] + P[a][2] * g[2];
          f[next[k + 1]][a] += x;
          sum += x;
        });
        f[next[0]][a] -= sum;
      });
    }
  };

  /// The degree of a cell kernel that is a FactoredKernel; 0 for others.
  template <typename CellKernel>
  inline constexpr int degree_of_factored_kernel = 0;

  template <int p>
  inline constexpr int degree_of_factored_kernel<FactoredKernel<p, double>> = p;
} // namespace corotet

#endif
