// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/with_degree.h>
#include <corotet/operators/gather.h>
#include <corotet/operators/quadrature_kernel.h>
#include <corotet/operators/tangent_sweep.h>

namespace corotet
{
  namespace
  {
    using V = Simd<double>;

    COROTET_ALWAYS_INLINE V
    lanes(const double *values)
    {
      return load_aligned<batch_size>(values);
    }

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

    struct Writer
    {
      double *next;

      template <int n>
      COROTET_ALWAYS_INLINE void
      write(const V (&values)[n])
      {
        static_for<n>(
          [&](auto i) { store_aligned(values[i], next + i * batch_size); });
        next += n * batch_size;
      }

      COROTET_ALWAYS_INLINE void
      write(const V (&values)[3][3])
      {
        static_for<9>([&](auto i) {
          store_aligned(values[i / 3][i % 3], next + i * batch_size);
        });
        next += 9 * batch_size;
      }
    };

    // The gradients of the reference coordinates as the cells' rotations turn
    // them: with these, F R^T stands where F stands with those at rest.
    COROTET_ALWAYS_INLINE void
    load_rotated(const ElasticData &data, const unsigned int batch, V (&g)[9])
    {
      const V scale = lanes(data.shapes[batch].scale);
      // Lanes without a cell have zeros throughout.
      const V factor = 1. / (scale > 0. ? scale : broadcast(1.));
      static_for<9>([&](auto i) {
        g[i] = factor * lanes(data.coefficients[batch].gradients[i]);
      });
    }

    // B <- R^T + B: F R^T from grad u R^T.
    COROTET_ALWAYS_INLINE void
    add_transposed(const V (&R)[3][3], V (&B)[3][3])
    {
      static_for<9>([&](auto ab) { B[ab / 3][ab % 3] += R[ab % 3][ab / 3]; });
    }

    COROTET_ALWAYS_INLINE void
    symmetric_part(const V (&B)[3][3], V (&S)[6])
    {
      static_for<6>([&](auto s) {
        constexpr int a = internal::symmetric_pairs[s][0],
                      b = internal::symmetric_pairs[s][1];
        S[s]            = a == b ? B[a][a] : 0.5 * (B[a][b] + B[b][a]);
      });
    }

    COROTET_ALWAYS_INLINE void
    count(unsigned int clamped, const CellShapes &shapes, unsigned int &n)
    {
      if (__builtin_expect(clamped != 0, 0))
        for (unsigned int lane = 0; lane < batch_size; ++lane)
          n += (clamped >> lane & 1u) != 0 && shapes.volume[lane] > 0;
    }

    template <int p, Tangent tangent>
    __attribute__((flatten)) void
    linearize_at_points(const ReferenceElement &reference,
                        const ElasticData      &data,
                        const unsigned int      first,
                        const unsigned int      end,
                        const double           *displacement,
                        double                 *linearization,
                        unsigned int           &n_clamped)
    {
      using Kernel     = QuadratureKernel<p>;
      const auto &rule = reference.stiffness_rule;
      const auto  size =
        batch_size * linearization_size(reference, data.rotation, tangent);
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u;
          typename Kernel::Geometry    g;
          gather_differences<Kernel::n_nodes>(data.batches,
                                              batch,
                                              displacement,
                                              u);
          Kernel::load(shapes, g);
          const V      mu = lanes(shapes.mu), lambda = lanes(shapes.lambda);
          Writer       numbers{linearization + size * std::size_t(batch)};
          unsigned int clamped = 0;
          for (unsigned int q = 0; q < rule.weights.size(); ++q)
            {
              V F[3][3], R[3][3];
              Kernel::gradient(rule, q, g, u, F);
              add_identity(F);
              polar_decomposition(F, R);
              numbers.write(R);
              if constexpr (tangent == Tangent::consistent)
                {
                  V S[6], T[6];
                  stretch(R, F, S);
                  clamped |= rotation_stiffness(lambda, mu, S, T);
                  numbers.write(T);
                }
            }
          count(clamped, shapes, n_clamped);
        }
    }

    // With one rotation per cell, everything is turned by it: B = F R^T stands
    // for R^T F, and R disappears from the formulas.
    template <int p, Rotation rotation>
    __attribute__((flatten)) void
    linearize_by_cell(const ReferenceElement &reference,
                      const ElasticData      &data,
                      const unsigned int      first,
                      const unsigned int      end,
                      const double           *displacement,
                      double                 *linearization,
                      unsigned int           &n_clamped)
    {
      using Kernel     = QuadratureKernel<p>;
      const auto &rule = reference.stiffness_rule;
      const auto  size =
        batch_size *
        linearization_size(reference, rotation, Tangent::consistent);
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u;
          typename Kernel::Geometry    g;
          gather_differences<Kernel::n_nodes>(data.batches,
                                              batch,
                                              displacement,
                                              u);
          load_rotated(data, batch, g);
          Writer numbers{linearization + size * std::size_t(batch)};
          V      R[3][3], B[3][3], S[6], G_inverse[6], moment[3]{};
          rotations_of(data, batch, R);
          Kernel::gradient(reference.centre, 0, g, u, B);
          add_transposed(R, B);
          symmetric_part(B, S);
          count(inverse_spin_tensor(S, G_inverse), shapes, n_clamped);
          numbers.write(G_inverse);
          if constexpr (rotation == Rotation::cell_centre_variational)
            numbers.write(S);
          for (unsigned int q = 0; q < rule.weights.size(); ++q)
            {
              Kernel::gradient(rule, q, g, u, B);
              add_transposed(R, B);
              numbers.write(B);
              if constexpr (rotation == Rotation::cell_centre_variational)
                {
                  V e[3][3], sigma[3][3];
                  internal::copy(B, e);
                  static_for<3>([&](auto a) { e[a][a] -= 1.; });
                  isotropic_stress(lanes(shapes.lambda),
                                   lanes(shapes.mu),
                                   e,
                                   sigma);
                  add_moment(rule.weights[q] * lanes(shapes.volume),
                             sigma,
                             B,
                             moment);
                }
            }
          if constexpr (rotation == Rotation::cell_centre_variational)
            {
              V n[3];
              symmetric_times(G_inverse, moment, n);
              numbers.write(n);
            }
        }
    }

    // f = c_M M u. Changes u.
    template <int p>
    COROTET_ALWAYS_INLINE void
    apply_mass(const TangentData &data,
               const unsigned int batch,
               V (&u)[bernstein::size<p>][3],
               V (&f)[bernstein::size<p>][3])
    {
      using Factored = FactoredKernel<p, double>;
      const V masses = data.mass_factor * Factored::mass_scale *
                       lanes(data.masses[batch].mass);
      Factored::template apply<false, true>(nullptr, masses, nullptr, u, f);
    }

    template <int p>
    COROTET_ALWAYS_INLINE void
    gather_with_mass(const TangentData &data,
                     const unsigned int batch,
                     const double      *source,
                     V (&u)[bernstein::size<p>][3],
                     V (&f)[bernstein::size<p>][3])
    {
      constexpr int n_nodes = bernstein::size<p>;
      gather_batch<n_nodes>(data.elastic.batches, batch, source, u);
      if (data.masses == nullptr)
        {
          static_for<3 * n_nodes>([&](auto ia) { f[ia / 3][ia % 3] = V{}; });
          return;
        }
      V copy[n_nodes][3];
      static_for<3 * n_nodes>(
        [&](auto ia) { copy[ia / 3][ia % 3] = u[ia / 3][ia % 3]; });
      apply_mass<p>(data, batch, copy, f);
    }

    template <int p, Tangent tangent>
    __attribute__((flatten)) void
    tangent_at_points(const TangentData &data,
                      const unsigned int first,
                      const unsigned int end,
                      const double      *source,
                      double            *sums)
    {
      using Kernel     = QuadratureKernel<p>;
      const auto &rule = data.reference.stiffness_rule;
      const auto  size =
        batch_size * linearization_size(data.reference,
                                        Rotation::quadrature_points,
                                        tangent);
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.elastic.shapes[batch];
          typename Kernel::NodalValues u, f;
          typename Kernel::Geometry    g;
          gather_with_mass<p>(data, batch, source, u, f);
          Kernel::load(shapes, g);
          const V mu     = data.frozen_factor * lanes(shapes.mu),
                  lambda = data.frozen_factor * lanes(shapes.lambda);
          Reader     numbers{data.linearization + size * std::size_t(batch)};
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
    template <int p, Rotation rotation>
    __attribute__((flatten)) void
    tangent_by_cell(const TangentData &data,
                    const unsigned int first,
                    const unsigned int end,
                    const double      *source,
                    double            *sums)
    {
      using Kernel = QuadratureKernel<p>;
      constexpr bool variational =
        rotation == Rotation::cell_centre_variational;
      const auto &rule = data.reference.stiffness_rule;
      const auto  size =
        batch_size *
        linearization_size(data.reference, rotation, Tangent::consistent);
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.elastic.shapes[batch];
          typename Kernel::NodalValues u, f;
          typename Kernel::Geometry    g;
          gather_with_mass<p>(data, batch, source, u, f);
          load_rotated(data.elastic, batch, g);
          const V mu = lanes(shapes.mu), lambda = lanes(shapes.lambda),
                  volume = lanes(shapes.volume);
          Reader numbers{data.linearization + size * std::size_t(batch)};
          V      G_inverse[6], S[6], H[3][3], a[3], w[3], dm[3]{};
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
              internal::copy(B, e);
              static_for<3>([&](auto a) { e[a][a] -= 1.; });
              isotropic_stress(lambda, mu, e, sigma);
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
                  const V weight = rule.weights[q] * volume;
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

    // function(p) with each of the three tangents for a degree.
    template <typename Sweep, typename AtPoints, typename ByCell>
    Sweep
    choose(const unsigned int degree,
           const Rotation     rotation,
           const Tangent      tangent,
           const AtPoints    &at_points,
           const ByCell      &by_cell)
    {
      Sweep result = nullptr;
      with_degree(degree, [&](const auto p) {
        using std::integral_constant;
        if (rotation == Rotation::quadrature_points)
          result =
            tangent == Tangent::frozen_rotation ?
              at_points(
                p, integral_constant<Tangent, Tangent::frozen_rotation>()) :
              at_points(p, integral_constant<Tangent, Tangent::consistent>());
        else if (tangent == Tangent::consistent)
          result =
            rotation == Rotation::cell_centre ?
              by_cell(p, integral_constant<Rotation, Rotation::cell_centre>()) :
              by_cell(p,
                      integral_constant<Rotation,
                                        Rotation::cell_centre_variational>());
      });
      Assert(result != nullptr, dealii::ExcNotImplemented());
      return result;
    }
  } // namespace

  unsigned int
  linearization_size(const ReferenceElement &reference,
                     const Rotation          rotation,
                     const Tangent           tangent)
  {
    const unsigned int n_points = reference.stiffness_rule.weights.size();
    if (rotation == Rotation::quadrature_points)
      return (tangent == Tangent::consistent ? 15 : 9) * n_points;
    return (rotation == Rotation::cell_centre ? 6 : 15) + 9 * n_points;
  }

  LinearizationSweep
  linearization_sweep(const unsigned int degree,
                      const Rotation     rotation,
                      const Tangent      tangent)
  {
    return choose<LinearizationSweep>(
      degree,
      rotation,
      tangent,
      [](const auto p, const auto t) -> LinearizationSweep {
        return linearize_at_points<decltype(p)::value, decltype(t)::value>;
      },
      [](const auto p, const auto r) -> LinearizationSweep {
        return linearize_by_cell<decltype(p)::value, decltype(r)::value>;
      });
  }

  TangentSweep
  tangent_sweep(const unsigned int degree,
                const Rotation     rotation,
                const Tangent      tangent)
  {
    return choose<TangentSweep>(
      degree,
      rotation,
      tangent,
      [](const auto p, const auto t) -> TangentSweep {
        return tangent_at_points<decltype(p)::value, decltype(t)::value>;
      },
      [](const auto p, const auto r) -> TangentSweep {
        return tangent_by_cell<decltype(p)::value, decltype(r)::value>;
      });
  }
} // namespace corotet
