// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_curved_kernel_h
#define corotet_operators_curved_kernel_h

#include <corotet/discretization/curved_batches.h>
#include <corotet/operators/factored_kernel.h>

namespace corotet
{
  /**
   * The functions of FactoredKernel for n_lanes<T> curved cells with n nodes,
   * by quadrature: with the rotated gradients of the centre's coordinates, and
   * the matrices of CurvedBatches, which turn derivatives by xi into
   * derivatives by these coordinates.
   */
  template <int n, typename T>
  class CurvedKernel
  {
  public:
    using V           = Simd<T>;
    using NodalValues = V[n][3];

    /**
     * The point of a rule.
     */
    struct Point
    {
      Point(const CurvedBatches &curved,
            const unsigned int   batch,
            const unsigned int   q)
        : shapes(curved.shape_numbers<T>() + std::size_t(4 * n) * q)
        , numbers(curved.numbers<T>(batch) +
                  CurvedBatches::n_numbers * n_lanes<T> * std::size_t(q))
      {}

      /// N_i (k = 0) or its derivatives by xi_k.
      COROTET_ALWAYS_INLINE T
      shape(const int i, const int k) const
      {
        return shapes[4 * i + k];
      }

      /// Entries of J^{-1} J_c, and the share of the volume (k = 9).
      COROTET_ALWAYS_INLINE V
      number(const int k) const
      {
        return load_aligned<n_lanes<T>>(numbers + k * n_lanes<T>);
      }

      const T *shapes;
      const T *numbers;
    };

    /**
     * v = stiffness_factor K u + M u, or one of the terms. @p masses are those
     * of the cells, @p cell is not used without stiffness.
     */
    template <bool with_stiffness, bool with_mass>
    static COROTET_ALWAYS_INLINE void
    apply(const CurvedBatches       &curved,
          const unsigned int         batch,
          const CellCoefficients<T> *cell,
          const T                    stiffness_factor,
          const V                    masses,
          const NodalValues         &u,
          NodalValues               &v)
    {
      static_for<3 * n>([&](auto ia) { v[ia / 3][ia % 3] = V{}; });
      for (unsigned int q = 0; q < curved.n_points(); ++q)
        {
          const Point point(curved, batch, q);
          V           value[3]{}, by_xi[3][3]{};
          static_for<n>([&](auto i) {
            static_for<3>([&](auto a) {
              if constexpr (with_mass)
                value[a] += point.shape(i, 0) * u[i][a];
              if constexpr (with_stiffness)
                static_for<3>([&](auto k) {
                  by_xi[a][k] += point.shape(i, k + 1) * u[i][a];
                });
            });
          });
          const V weight = point.number(9);
          static_for<3>([&](auto a) { value[a] *= weight * masses; });
          if constexpr (with_stiffness)
            stress(point, *cell, stiffness_factor * weight, by_xi);
          static_for<n>([&](auto i) {
            static_for<3>([&](auto a) {
              if constexpr (with_mass)
                v[i][a] += point.shape(i, 0) * value[a];
              if constexpr (with_stiffness)
                static_for<3>([&](auto k) {
                  v[i][a] += point.shape(i, k + 1) * by_xi[a][k];
                });
            });
          });
        }
    }

    /// The diagonal of K + M, or of K.
    template <bool with_mass>
    static COROTET_ALWAYS_INLINE void
    diagonal(const CurvedBatches       &curved,
             const unsigned int         batch,
             const CellCoefficients<T> &cell,
             const V                    masses,
             NodalValues               &v)
    {
      static_for<3 * n>([&](auto ia) { v[ia / 3][ia % 3] = V{}; });
      const V ratio = T(1) + load_aligned<n_lanes<T>>(cell.lame_ratio);
      for (unsigned int q = 0; q < curved.n_points(); ++q)
        {
          const Point point(curved, batch, q);
          V           g[3][3];
          gradients(point, cell, g);
          const V weight = point.number(9);
          static_for<n>([&](auto i) {
            V D[3];
            static_for<3>([&](auto a) {
              V sum{};
              static_for<3>(
                [&](auto k) { sum += point.shape(i, k + 1) * g[k][a]; });
              D[a] = weight * sum * sum;
            });
            V same = D[0] + D[1] + D[2];
            if constexpr (with_mass)
              same += point.shape(i, 0) * point.shape(i, 0) * (weight * masses);
            static_for<3>([&](auto a) { v[i][a] += ratio * D[a] + same; });
          });
        }
    }

    /// sqrt(mu volume) R grad xi_k at a point, [k][component].
    static COROTET_ALWAYS_INLINE void
    gradients(const Point &point, const CellCoefficients<T> &cell, V (&g)[3][3])
    {
      static_for<9>([&](auto ka) {
        V sum{};
        static_for<3>([&](auto l) {
          sum += point.number(3 * (ka / 3) + l) *
                 load_aligned<n_lanes<T>>(cell.gradients[3 * l + ka % 3]);
        });
        g[ka / 3][ka % 3] = sum;
      });
    }

  private:
    // From derivatives of u by xi computes those of the energy by them,
    // [component][k].
    static COROTET_ALWAYS_INLINE void
    stress(const Point               &point,
           const CellCoefficients<T> &cell,
           const V                    weight,
           V (&by_xi)[3][3])
    {
      V g[3][3], H[3][3]{};
      gradients(point, cell, g);
      static_for<3>([&](auto k) {
        static_for<9>([&](auto ab) {
          H[ab / 3][ab % 3] += by_xi[ab / 3][k] * g[k][ab % 3];
        });
      });
      const V pressure = weight * load_aligned<n_lanes<T>>(cell.lame_ratio) *
                         (H[0][0] + H[1][1] + H[2][2]);
      V sigma[3][3];
      static_for<9>([&](auto ab) {
        constexpr int a = ab / 3, b = ab % 3;
        sigma[a][b] = weight * (H[a][b] + H[b][a]);
        if constexpr (a == b)
          sigma[a][b] += pressure;
      });
      static_for<9>([&](auto ak) {
        V sum{};
        static_for<3>([&](auto b) { sum += sigma[ak / 3][b] * g[ak % 3][b]; });
        by_xi[ak / 3][ak % 3] = sum;
      });
    }
  };
} // namespace corotet

#endif
