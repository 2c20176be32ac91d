// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_bubble_kernel_h
#define corotet_operators_bubble_kernel_h

#include <corotet/operators/bubbles.h>
#include <corotet/operators/factored_kernel.h>

namespace corotet
{
  /**
   * The functions of FactoredKernel for the quadratic element with bubbles.
   * Mass is by quadrature at the nodes, so diagonal. Stiffness equals that by
   * the rule of bubbles.h, but is computed without its points:
   *
   * Quadratic functions and the bubbles of faces are cubic, u = q + b B with
   * the bubble B of the cell, and the kernel of degree 3 computes the part of
   * q. As B vanishes on the surface, and its mean times a linear function is
   * its mean times the function's value at the centre,
   *
   *   int dB/dlambda_v B_beta = -int B dB_beta/dlambda_v,
   *
   * for quadratic B_beta, is one number for each vertex of beta, which couples
   * b to the coefficients of stress and strain. The rule is exact for these
   * terms, but not for products of B with itself; for those the kernel uses the
   * value by the rule.
   */
  template <typename T>
  class BubbleKernel : private FactoredKernel<3, T>
  {
  public:
    using V = Simd<T>;

    static constexpr int n_nodes = bubbles::n_nodes;

    using NodalValues = V[n_nodes][3];
    /// Components xx, yy, zz, yz, xz, xy.
    using Strain = V[6];

    using FactoredKernel<3, T>::stiffness_scale;
    using FactoredKernel<3, T>::strain_scale;
    static constexpr double mass_scale        = 1;
    static constexpr auto  &diagonal_products = bubbles::diagonal_products;

    /// The same as FactoredKernel::apply(), but @p u is not overwritten.
    template <bool with_stiffness, bool with_mass, bool with_offset = false>
    static COROTET_ALWAYS_INLINE void
    apply(const CellCoefficients<T> *cell,
          const V                    masses,
          const Strain              *offset,
          const NodalValues         &u,
          NodalValues               &v)
    {
      if constexpr (with_stiffness)
        apply_stiffness<with_offset>(*cell, offset, u, v);
      else
        static_for<3 * n_nodes>([&](auto ia) { v[ia / 3][ia % 3] = V{}; });
      if constexpr (with_mass)
        static_for<n_nodes>([&](auto i) {
          const V mass = masses * T(bubbles::node_weights[i]);
          static_for<3>([&](auto a) { v[i][a] += mass * u[i][a]; });
        });
    }

    /// The same as FactoredKernel::centre_gradient().
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
    using Cubic = FactoredKernel<3, T>;

    // In the units of the kernel of degree 3: the integral of dB/dlambda_v
    // B_beta for a vertex of beta, from the mean 32/105 of B, and that of
    // dB/dlambda_v dB/dlambda_v minus that of dB/dlambda_v dB/dlambda_w.
    static constexpr double coupling =
      -0.5 * bubbles::node_weights[14] / (3 * bernstein::mass_scale(2));
    static constexpr double square =
      0.5 * bubbles::diagonal_products.gradient[14][0] / Cubic::stiffness_scale;

    template <bool with_offset>
    static COROTET_ALWAYS_INLINE void
    apply_stiffness(const CellCoefficients<T> &cell,
                    const Strain              *offset,
                    const NodalValues         &u,
                    NodalValues               &v)
    {
      typename Cubic::NodalValues c;
      V                           b[3], f[3]{}, g[4][3];
      Strain                      sigma[Cubic::n_gradients], bubble[4];
      to_coefficients(u, c, b);
      Cubic::template compute_stress<with_offset>(cell, offset, c, sigma);
      const V ratio = load_aligned<n_lanes<T>>(cell.lame_ratio);
      static_for<3>([&](auto a) {
        static_for<3>([&](auto k) {
          g[k + 1][a] = load_aligned<n_lanes<T>>(cell.gradients[3 * k + a]);
        });
        g[0][a] = -(g[1][a] + g[2][a] + g[3][a]);
      });
      static_for<4>([&](auto v) {
        stress_of_product(b, g[v], ratio, bubble[v]);
        Strain s;
        static_for<6>([&](auto i) {
          V sum{};
          static_for<4>(
            [&](auto w) { sum += sigma[bernstein::raised<1>[v][w]][i]; });
          s[i] = T(coupling) * sum + T(square) * bubble[v][i];
        });
        f[0] += s[0] * g[v][0] + s[5] * g[v][1] + s[4] * g[v][2];
        f[1] += s[5] * g[v][0] + s[1] * g[v][1] + s[3] * g[v][2];
        f[2] += s[4] * g[v][0] + s[3] * g[v][1] + s[2] * g[v][2];
      });
      repeat<3, 6>([&](const auto s) {
        V x[Cubic::n_gradients];
        static_for<Cubic::n_gradients>([&](auto i) { x[i] = sigma[i][s]; });
        Cubic::template apply_mass<2, 1>(x);
        static_for<4>([&](auto i) { x[i] += T(coupling) * bubble[i][s]; });
        static_for<6>([&](auto e) {
          x[4 + e] += T(coupling) * (bubble[tetrahedron::edges[e][0]][s] +
                                     bubble[tetrahedron::edges[e][1]][s]);
        });
        static_for<Cubic::n_gradients>([&](auto i) { sigma[i][s] = x[i]; });
      });
      static_for<3 * Cubic::n_nodes>([&](auto ia) { c[ia / 3][ia % 3] = V{}; });
      Cubic::add_divergence(cell, sigma, c);
      from_coefficients(c, f, v);
    }

    // The stress of the gradient b (x) g, in units of mu.
    static COROTET_ALWAYS_INLINE void
    stress_of_product(const V (&b)[3],
                      const V (&g)[3],
                      const V ratio,
                      Strain &sigma)
    {
      const V x = b[0] * g[0], y = b[1] * g[1], z = b[2] * g[2];
      const V pressure = ratio * (x + y + z);
      sigma[0]         = T(2) * x + pressure;
      sigma[1]         = T(2) * y + pressure;
      sigma[2]         = T(2) * z + pressure;
      sigma[3]         = b[1] * g[2] + b[2] * g[1];
      sigma[4]         = b[0] * g[2] + b[2] * g[0];
      sigma[5]         = b[0] * g[1] + b[1] * g[0];
    }

    // Bernstein coefficients c of the cubic part and the factor b of the cell's
    // bubble, from values at the nodes.
    static COROTET_ALWAYS_INLINE void
    to_coefficients(const NodalValues           &u,
                    typename Cubic::NodalValues &c,
                    V (&b)[3])
    {
      repeat<3, 3>([&](const auto a) {
        V vertices{}, middles{}, centres{};
        static_for<4>([&](auto v) {
          c[v][a] = u[v][a];
          vertices += u[v][a];
        });
        static_for<6>([&](auto e) {
          const V middle  = T(4. / 3) * u[4 + e][a];
          c[4 + 2 * e][a] = middle - T(1. / 3) * u[tetrahedron::edges[e][1]][a];
          c[5 + 2 * e][a] = middle - T(1. / 3) * u[tetrahedron::edges[e][0]][a];
          middles += u[4 + e][a];
        });
        static_for<4>([&](auto f) {
          constexpr auto &v = tetrahedron::faces[f];
          constexpr auto &e = tetrahedron::edges_of_faces[f];
          c[16 + f][a] =
            T(4.5) * u[10 + f][a] +
            T(1. / 6) * (u[v[0]][a] + u[v[1]][a] + u[v[2]][a]) -
            T(4. / 3) * (u[4 + e[0]][a] + u[4 + e[1]][a] + u[4 + e[2]][a]);
          centres += u[10 + f][a];
        });
        b[a] = u[14][a] - T(27. / 64) * centres - T(1. / 64) * vertices +
               T(1. / 8) * middles;
      });
    }

    // The transpose of to_coefficients(), for coefficients c and f of a linear
    // form.
    static COROTET_ALWAYS_INLINE void
    from_coefficients(const typename Cubic::NodalValues &c,
                      const V (&f)[3],
                      NodalValues &u)
    {
      repeat<3, 3>([&](const auto a) {
        static_for<4>([&](auto v) { u[v][a] = c[v][a] - T(1. / 64) * f[a]; });
        static_for<6>([&](auto e) {
          u[tetrahedron::edges[e][1]][a] -= T(1. / 3) * c[4 + 2 * e][a];
          u[tetrahedron::edges[e][0]][a] -= T(1. / 3) * c[5 + 2 * e][a];
          u[4 + e][a] =
            T(4. / 3) * (c[4 + 2 * e][a] + c[5 + 2 * e][a]) + T(1. / 8) * f[a];
        });
        static_for<4>([&](auto k) {
          const V vertex = T(1. / 6) * c[16 + k][a];
          const V middle = T(4. / 3) * c[16 + k][a];
          static_for<3>([&](auto i) {
            u[tetrahedron::faces[k][i]][a] += vertex;
            u[4 + tetrahedron::edges_of_faces[k][i]][a] -= middle;
          });
          u[10 + k][a] = T(4.5) * c[16 + k][a] - T(27. / 64) * f[a];
        });
        u[14][a] = f[a];
      });
    }
  };
} // namespace corotet

#endif
