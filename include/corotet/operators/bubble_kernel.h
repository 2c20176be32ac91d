// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_bubble_kernel_h
#define corotet_operators_bubble_kernel_h

#include <corotet/operators/bubbles.h>
#include <corotet/operators/factored_kernel.h>

namespace corotet
{
  /**
   * What FactoredKernel does, for the quadratic element with bubbles: stiffness
   * by the rule of bubbles.h, mass by quadrature at the nodes, so diagonal.
   */
  template <typename T>
  class BubbleKernel
  {
  public:
    using V = Simd<T>;

    static constexpr int n_nodes = bubbles::n_nodes;

    using NodalValues = V[n_nodes][3];
    /// xx, yy, zz, yz, xz, xy.
    using Strain = V[6];

    static constexpr double stiffness_scale   = 1;
    static constexpr double mass_scale        = 1;
    static constexpr double strain_scale      = 1;
    static constexpr auto  &diagonal_products = bubbles::diagonal_products;

    /// As FactoredKernel::apply(), but @p u remains.
    template <bool with_stiffness, bool with_mass, bool with_offset = false>
    static COROTET_ALWAYS_INLINE void
    apply(const CellCoefficients<T> *cell,
          const V                    masses,
          const Strain              *offset,
          const NodalValues         &u,
          NodalValues               &v)
    {
      static_for<3 * n_nodes>([&](auto ia) {
        constexpr int i = ia / 3, a = ia % 3;
        if constexpr (with_mass)
          v[i][a] = masses * T(bubbles::node_weights[i]) * u[i][a];
        else
          v[i][a] = V{};
      });
      if constexpr (with_stiffness)
        {
          V g[9];
          static_for<9>([&](auto i) {
            g[i] = load_aligned<n_lanes<T>>(cell->gradients[i]);
          });
          const V ratio = load_aligned<n_lanes<T>>(cell->lame_ratio);
          for (int q = 0; q < bubbles::n_points; ++q)
            {
              const auto &dN = bubbles::point_derivatives<T>[q];
              V           by_xi[3][3]{}, sigma[3][3];
              static_for<9 * n_nodes>([&](auto iak) {
                constexpr int i = iak / 9, a = iak % 9 / 3, k = iak % 3;
                by_xi[a][k] += dN[i][k] * u[i][a];
              });
              stress<with_offset>(g, ratio, offset, by_xi, sigma);
              const T weight = bubbles::stiffness_rule[q].weight;
              static_for<9>([&](auto ak) {
                constexpr int a = ak / 3, k = ak % 3;
                by_xi[a][k] = weight * (sigma[a][0] * g[3 * k] +
                                        sigma[a][1] * g[3 * k + 1] +
                                        sigma[a][2] * g[3 * k + 2]);
              });
              static_for<9 * n_nodes>([&](auto iak) {
                constexpr int i = iak / 9, a = iak % 9 / 3, k = iak % 3;
                v[i][a] += dN[i][k] * by_xi[a][k];
              });
            }
        }
    }

    /// As FactoredKernel::centre_gradient().
    static COROTET_ALWAYS_INLINE void
    centre_gradient(const NodalValues &u, V (&gradient)[3][3])
    {
      static_for<9>([&](auto ak) {
        constexpr int a = ak / 3, k = ak % 3;
        V             sum{};
        static_for<n_nodes>([&](auto i) {
          constexpr double weight = bubbles::centre_derivatives[i][k];
          if constexpr (weight > 1e-12 || weight < -1e-12)
            sum += T(weight) * u[i][a];
        });
        gradient[a][k] = sum;
      });
    }

  private:
    // In units of mu, of the gradient by the reference coordinates.
    template <bool with_offset>
    static COROTET_ALWAYS_INLINE void
    stress(const V (&g)[9],
           const V       ratio,
           const Strain *offset,
           const V (&by_xi)[3][3],
           V (&sigma)[3][3])
    {
      V H[3][3];
      static_for<9>([&](auto ab) {
        constexpr int a = ab / 3, b = ab % 3;
        H[a][b] =
          by_xi[a][0] * g[b] + by_xi[a][1] * g[3 + b] + by_xi[a][2] * g[6 + b];
      });
      if constexpr (with_offset)
        {
          static_for<3>([&](auto a) { H[a][a] += (*offset)[a]; });
          // Twice the shear strain.
          H[1][2] += (*offset)[3];
          H[0][2] += (*offset)[4];
          H[0][1] += (*offset)[5];
        }
      const V pressure = ratio * (H[0][0] + H[1][1] + H[2][2]);
      static_for<9>([&](auto ab) {
        constexpr int a = ab / 3, b = ab % 3;
        sigma[a][b] = H[a][b] + H[b][a];
        if constexpr (a == b)
          sigma[a][b] += pressure;
      });
    }
  };
} // namespace corotet

#endif
