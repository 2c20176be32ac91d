// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/curved_kernel.h>
#include <corotet/operators/gather.h>
#include <corotet/operators/quadrature_kernel.h>
#include <corotet/operators/rotated_frame.h>
#include <corotet/operators/with_tangent.h>

namespace corotet
{
  namespace
  {
    using V = Simd<double>;

    // Numbers of a linearization, one register after another.
    struct Reader
    {
      const double *next;

      template <int n>
      COROTET_ALWAYS_INLINE void
      read(V (&values)[n])
      {
        static_for<n>(
          [&](auto i) { values[i] = lanes(next + i * batch_size); });
        next += n * batch_size;
      }

      COROTET_ALWAYS_INLINE void
      read(V (&values)[3][3])
      {
        static_for<9>(
          [&](auto i) { values[i / 3][i % 3] = lanes(next + i * batch_size); });
        next += 9 * batch_size;
      }
    };

    // f = c_M M u. Changes u.
    template <typename CellKernel, bool is_curved>
    COROTET_ALWAYS_INLINE void
    apply_mass(const TangentData &data,
               const unsigned int batch,
               V (&u)[CellKernel::n_nodes][3],
               V (&f)[CellKernel::n_nodes][3])
    {
      const V masses = data.mass_factor * lanes(data.masses[batch].mass);
      if constexpr (is_curved)
        CurvedKernel<CellKernel::n_nodes, double>::template apply<false, true>(
          *data.elastic.batches.curved(), batch, nullptr, 0., masses, u, f);
      else
        CellKernel::template apply<false, true>(
          nullptr, CellKernel::mass_scale * masses, nullptr, u, f);
    }

    template <typename CellKernel, bool is_curved>
    COROTET_ALWAYS_INLINE void
    gather_with_mass(const TangentData &data,
                     const unsigned int batch,
                     const double      *source,
                     V (&u)[CellKernel::n_nodes][3],
                     V (&f)[CellKernel::n_nodes][3])
    {
      constexpr int n_nodes = CellKernel::n_nodes;
      gather_batch<n_nodes>(data.elastic.batches, batch, source, u);
      if (data.masses == nullptr)
        {
          static_for<3 * n_nodes>([&](auto ia) { f[ia / 3][ia % 3] = V{}; });
          return;
        }
      V copy[n_nodes][3];
      static_for<3 * n_nodes>(
        [&](auto ia) { copy[ia / 3][ia % 3] = u[ia / 3][ia % 3]; });
      apply_mass<CellKernel, is_curved>(data, batch, copy, f);
    }

    template <typename CellKernel, Tangent tangent, typename IsCurved>
    __attribute__((flatten)) void
    tangent_at_points(const IsCurved     is_curved,
                      const TangentData &data,
                      const unsigned int first,
                      const unsigned int end,
                      const double      *source,
                      double            *sums)
    {
      using Kernel = QuadratureKernel<CellKernel::n_nodes>;
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.elastic.shapes[batch];
          typename Kernel::NodalValues u, f;
          typename Kernel::Geometry    g;
          gather_with_mass<CellKernel, IsCurved::value>(
            data, batch, source, u, f);
          Kernel::load(shapes, g);
          const V mu     = data.frozen_factor * lanes(shapes.mu),
                  lambda = data.frozen_factor * lanes(shapes.lambda);
          const auto &rule =
            cell_rule(is_curved, data.reference, data.elastic.batches, batch);
          Reader numbers{
            data.linearization +
            linearization_start<IsCurved::value>(data.reference,
                                                 data.elastic.batches,
                                                 Rotation::quadrature_points,
                                                 tangent,
                                                 batch)};
          const auto stress =
            [&](const unsigned int, const V(&dF)[3][3], V(&P)[3][3]) {
              V R[3][3], A[3][3], sigma[3][3];
              numbers.read(R);
              transposed_times(R, dF, A);
              isotropic_stress(lambda, mu, A, sigma);
              if constexpr (tangent == Tangent::consistent)
                {
                  V T[6], a[3], t[3];
                  numbers.read(T);
                  axial_vector(A, a);
                  symmetric_times(T, a, t);
                  add_skew(t, sigma);
                }
              times(R, sigma, P);
            };
          Kernel::integrate(rule, g, lanes(shapes.volume), u, f, stress);
          scatter_add<Kernel::n_nodes>(f,
                                       data.elastic.batches.nodes(batch),
                                       sums);
        }
    }

    // Derivative of the force of one rotation per cell. With H = dF R^T and the
    // change w of the rotation, G w = a(H) at the centre, the strain changes by
    // sym(H - W(w) B) and P R^T by sigma(H - W(w) B) + W(w) sigma. In the
    // variational force, the stress W(n) at the centre, G n = m, changes by
    // W(w) W(n) + W(dn), where G dn = dm - dG n.
    template <typename CellKernel, Rotation rotation, typename IsCurved>
    __attribute__((flatten)) void
    tangent_by_cell(const IsCurved     is_curved,
                    const TangentData &data,
                    const unsigned int first,
                    const unsigned int end,
                    const double      *source,
                    double            *sums)
    {
      using Kernel = QuadratureKernel<CellKernel::n_nodes>;
      constexpr bool variational =
        rotation == Rotation::cell_centre_variational;
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.elastic.shapes[batch];
          typename Kernel::NodalValues u, f;
          typename Kernel::Geometry    g;
          gather_with_mass<CellKernel, IsCurved::value>(
            data, batch, source, u, f);
          load_rotated(data.elastic, batch, g);
          const V mu = lanes(shapes.mu), lambda = lanes(shapes.lambda),
                  volume = lanes(shapes.volume);
          const auto &rule =
            cell_rule(is_curved, data.reference, data.elastic.batches, batch);
          Reader numbers{
            data.linearization +
            linearization_start<IsCurved::value>(data.reference,
                                                 data.elastic.batches,
                                                 rotation,
                                                 Tangent::consistent,
                                                 batch)};
          V G_inverse[6], S[6], H[3][3], a[3], w[3], dm[3]{};
          numbers.read(G_inverse);
          if constexpr (variational)
            numbers.read(S);
          Kernel::gradient(data.reference.centre, 0, g, u, H);
          axial_vector(H, a);
          symmetric_times(G_inverse, a, w);
          const auto stress =
            [&](const unsigned int q, const V(&H)[3][3], V(&P)[3][3]) {
              V B[3][3], e[3][3], WB[3][3], sigma[3][3], W_sigma[3][3];
              numbers.read(B);
              stress_of_stretch(lambda, mu, B, sigma);
              skew_times(w, sigma, W_sigma);
              skew_times(w, B, WB);
              // Of the part with frozen rotations a multiple is wanted.
              static_for<9>([&](auto ab) {
                constexpr int a = ab / 3, b = ab % 3;
                e[a][b]  = H[a][b] - WB[a][b];
                WB[a][b] = data.frozen_factor * H[a][b] - WB[a][b];
              });
              isotropic_stress(lambda, mu, WB, P);
              if constexpr (variational)
                {
                  const V weight = weight_at(rule, q) * volume;
                  V       d_sigma[3][3];
                  isotropic_stress(lambda, mu, e, d_sigma);
                  add_moment(weight, d_sigma, B, dm);
                  add_moment(weight, sigma, e, dm);
                }
              static_for<9>(
                [&](auto ab) { P[ab / 3][ab % 3] += W_sigma[ab / 3][ab % 3]; });
            };
          Kernel::integrate(rule, g, volume, u, f, stress);
          if constexpr (variational)
            {
              V n[3], dS[6], dG[6], dG_n[3], dn[3], Wn[3][3]{}, P[3][3];
              numbers.read(n);
              V WS[3][3], S_full[3][3];
              static_for<6>([&](auto s) {
                constexpr int a = internal::symmetric_pairs[s][0],
                              b = internal::symmetric_pairs[s][1];
                S_full[a][b]    = S[s];
                S_full[b][a]    = S[s];
              });
              skew_times(w, S_full, WS);
              static_for<9>([&](auto ab) {
                WS[ab / 3][ab % 3] = H[ab / 3][ab % 3] - WS[ab / 3][ab % 3];
              });
              symmetric_part(WS, dS);
              spin_tensor(dS, dG);
              symmetric_times(dG, n, dG_n);
              static_for<3>([&](auto a) { dm[a] -= dG_n[a]; });
              symmetric_times(G_inverse, dm, dn);
              add_skew(n, Wn);
              skew_times(w, Wn, P);
              add_skew(dn, P);
              Kernel::add(data.reference.centre, 0, g, P, f);
            }
          scatter_add<Kernel::n_nodes>(f,
                                       data.elastic.batches.nodes(batch),
                                       sums);
        }
    }

    template <typename CellKernel, Rotation rotation, Tangent tangent>
    void
    apply(const TangentData &data,
          const unsigned int first,
          const unsigned int end,
          const double      *source,
          double            *sums)
    {
      for_each_kind(data.elastic.batches,
                    first,
                    end,
                    [&](const auto begin, const auto stop, const auto curved) {
                      if constexpr (rotation == Rotation::quadrature_points)
                        tangent_at_points<CellKernel, tangent>(
                          curved, data, begin, stop, source, sums);
                      else
                        tangent_by_cell<CellKernel, rotation>(
                          curved, data, begin, stop, source, sums);
                    });
    }
  } // namespace

  TangentSweep
  tangent_sweep(const Element  element,
                const Rotation rotation,
                const Tangent  tangent)
  {
    TangentSweep result = nullptr;
    with_tangent(element,
                 rotation,
                 tangent,
                 [&](const auto kernel, const auto r, const auto t) {
                   result = apply<typename decltype(kernel)::type,
                                  decltype(r)::value,
                                  decltype(t)::value>;
                 });
    return result;
  }
} // namespace corotet
