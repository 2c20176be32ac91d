// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_laws_cell_centred_tangent_h
#define corotet_source_laws_cell_centred_tangent_h

#include <corotet/operators/factored_tangent.h>
#include <corotet/operators/point_operations.h>
#include <corotet/operators/rotated_frame.h>

/**
 * The exact tangent of the force with one rotation per cell; if variational, of
 * the force that is the gradient of the energy.
 */
namespace corotet
{
  namespace cell_centred
  {
    using V = Simd<double>;

    // Whether straight cells need no quadrature points: see FactoredTangent.
    template <typename CellKernel, bool variational>
    constexpr bool is_factored =
      !variational && degree_of_factored_kernel<CellKernel> > 0;

    // The numbers kept. Straight cells without points: G^{-1} and
    // FactoredTangent's B, both in its units. Other cells: G^{-1}, S and n if
    // variational, and B of each point.
    template <typename CellKernel, bool variational>
    constexpr LinearizationSize linearization_size{
      is_factored<CellKernel, variational> || variational ? 15u : 6u,
      9u,
      is_factored<CellKernel, variational>};

    template <typename CellKernel>
    using Factored = FactoredTangent<degree_of_factored_kernel<CellKernel>>;

    // The size of a cell: sqrt(mu volume) times gradient_scale.
    template <typename CellKernel>
    COROTET_ALWAYS_INLINE V
    size_of(const CellConstants &constants)
    {
      return lanes(constants.scale) * Factored<CellKernel>::gradient_scale;
    }

    template <bool variational>
    struct Linearization
    {
      template <typename Points>
      static COROTET_ALWAYS_INLINE void
      apply(Points &points, const double *displacement, double *)
      {
        using CellKernel = typename Points::Cell;
        constexpr bool is_factored_here =
          is_factored<CellKernel, variational> && !Points::is_curved_batch;
        typename Points::NodalValues u;
        gather_differences<Points::n_nodes>(points.data.batches,
                                            points.batch,
                                            displacement,
                                            u);
        load_rotated(points.data, points.batch, points.g);
        NumberWriter numbers =
          points.writer(linearization_size<CellKernel, variational>);
        Tensor2Lanes R, B;
        V            S[6], G_inverse[6];
        rotations_of(points.data, points.batch, R);
        points.gradient_at_centre(u, B);
        add_transposed(R, B);
        symmetric_part(B, S);
        points.count_clamped(inverse_spin_tensor(S, G_inverse));
        if constexpr (is_factored_here)
          {
            const V size = size_of<CellKernel>(points.constants);
            // Lanes without a cell have zeros throughout.
            const V factor = 1. / (size > 0. ? size : broadcast(1.));
            static_for<6>([&](auto s) { G_inverse[s] *= factor; });
            numbers.write(G_inverse);
            static_for<9>([&](auto ab) {
              constexpr int a = ab / 3, b = ab % 3;
              if constexpr (Factored<CellKernel>::keeps_B)
                B[a][b] *= size;
              else
                B[a][b] = size * R[b][a];
            });
            numbers.write(B);
          }
        else
          {
            numbers.write(G_inverse);
            if constexpr (variational)
              numbers.write(S);
            write_points(points, u, R, G_inverse, numbers);
          }
      }

    private:
      template <typename Points>
      static COROTET_ALWAYS_INLINE void
      write_points(const Points                       &points,
                   const typename Points::NodalValues &u,
                   const Tensor2Lanes                 &R,
                   const V (&G_inverse)[6],
                   NumberWriter &numbers)
      {
        const auto [lambda, mu] = points.lame();
        V          moment[3]{};
        const auto linearize = [&](const unsigned int q, Tensor2Lanes &B) {
          add_transposed(R, B);
          numbers.write(B);
          if constexpr (variational)
            {
              Tensor2Lanes sigma;
              stress_of_stretch(lambda, mu, B, sigma);
              add_moment(points.weight(q), sigma, B, moment);
            }
        };
        points.for_each_point(u, linearize);
        if constexpr (variational)
          {
            V n[3];
            symmetric_times(G_inverse, moment, n);
            numbers.write(n);
          }
      }
    };

    // The tangent by quadrature points. With H = dF R^T and the change w of the
    // rotation, G w = a(H) at the centre, the strain changes by sym(H - W(w) B)
    // and P R^T by sigma(H - W(w) B) + W(w) sigma.
    template <bool variational>
    struct PointTangent
    {
      template <typename Points>
      static COROTET_ALWAYS_INLINE void
      apply(Points &points, const double *source, double *sums)
      {
        typename Points::NodalValues u, f;
        points.gather_with_matrices(source, 0., u, f);
        load_rotated(points.data, points.batch, points.g);
        const auto [lambda, mu]    = points.lame();
        const double frozen_factor = points.data.frozen_factor;
        NumberReader numbers =
          points.reader(linearization_size<typename Points::Cell, variational>);
        Tensor2Lanes H;
        V            G_inverse[6], S[6], a[3], w[3], dm[3]{};
        numbers.read(G_inverse);
        if constexpr (variational)
          numbers.read(S);
        points.gradient_at_centre(u, H);
        axial_vector(H, a);
        symmetric_times(G_inverse, a, w);
        const auto stress =
          [&](const unsigned int q, const Tensor2Lanes &H, Tensor2Lanes &P) {
            Tensor2Lanes B, e, WB, sigma, W_sigma;
            numbers.read(B);
            stress_of_stretch(lambda, mu, B, sigma);
            skew_times(w, sigma, W_sigma);
            skew_times(w, B, WB);
            // The part with frozen rotations is multiplied by frozen_factor.
            static_for<9>([&](auto ab) {
              constexpr int a = ab / 3, b = ab % 3;
              e[a][b]  = H[a][b] - WB[a][b];
              WB[a][b] = frozen_factor * H[a][b] - WB[a][b];
            });
            isotropic_stress(lambda, mu, WB, P);
            if constexpr (variational)
              {
                const V      weight = points.weight(q);
                Tensor2Lanes d_sigma;
                isotropic_stress(lambda, mu, e, d_sigma);
                add_moment(weight, d_sigma, B, dm);
                add_moment(weight, sigma, e, dm);
              }
            static_for<9>(
              [&](auto ab) { P[ab / 3][ab % 3] += W_sigma[ab / 3][ab % 3]; });
          };
        points.integrate(u, f, stress);
        if constexpr (variational)
          {
            V n[3];
            numbers.read(n);
            add_at_centre(points, G_inverse, S, H, w, n, dm, f);
          }
        points.add_to(sums, f);
      }

    private:
      // In the variational force the stress W(n) at the centre, G n = m,
      // changes by W(w) W(n) + W(dn), where G dn = dm - dG n.
      template <typename Points>
      static COROTET_ALWAYS_INLINE void
      add_at_centre(const Points &points,
                    const V (&G_inverse)[6],
                    const V (&S)[6],
                    const Tensor2Lanes &H,
                    const V (&w)[3],
                    const V (&n)[3],
                    V (&dm)[3],
                    typename Points::NodalValues &f)
      {
        V            dS[6], dG[6], dG_n[3], dn[3];
        Tensor2Lanes WS, S_full, Wn{}, P;
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
        points.add_at_centre(P, f);
      }
    };

    // The tangent of straight cells works without quadrature points, that of
    // curved cells with them.
    template <typename CellKernel>
    struct MixedTangent : PointOperation<PointTangent<false>, CellKernel>
    {
      using PointOperation<PointTangent<false>, CellKernel>::apply;

      static COROTET_ALWAYS_INLINE void
      fetch(const ElasticData &data, const unsigned int batch)
      {
        fetch_object(data.coefficients + batch);
      }

      static COROTET_ALWAYS_INLINE void
      apply(const std::false_type,
            ElasticData       &data,
            const unsigned int batch,
            const double      *source,
            double            *sums)
      {
        const PointBatch<CellKernel, false> points(data, batch);
        if (data.masses != nullptr)
          apply_straight<true>(points, source, sums);
        else
          apply_straight<false>(points, source, sums);
      }

    private:
      template <bool with_mass, typename Points>
      static COROTET_ALWAYS_INLINE void
      apply_straight(const Points &points, const double *source, double *sums)
      {
        using Tangent                        = Factored<CellKernel>;
        const ElasticData      &data         = points.data;
        const auto             &coefficients = data.coefficients[points.batch];
        typename Tangent::Cells cells;
        static_for<9>([&](auto i) {
          cells.gradients[i] = lanes(coefficients.gradients[i]);
        });
        cells.lame_ratio = lanes(coefficients.lame_ratio);
        cells.size       = size_of<CellKernel>(points.constants);
        NumberReader numbers =
          points.reader(linearization_size<CellKernel, false>);
        numbers.read(cells.G_inverse);
        numbers.read(cells.B);
        if constexpr (with_mass)
          cells.masses = data.mass_factor * Tangent::mass_scale *
                         lanes(data.masses[points.batch].mass);
        typename Points::NodalValues u, v, f;
        if constexpr (!Tangent::keeps_B)
          gather_differences<Points::n_nodes>(data.batches,
                                              points.batch,
                                              data.linearized_displacement,
                                              u);
        gather_batch<Points::n_nodes>(data.batches, points.batch, source, v);
        Tangent::template apply<with_mass>(cells, data.frozen_factor, u, v, f);
        static_for<3 * Points::n_nodes>(
          [&](auto ia) { f[ia / 3][ia % 3] *= Tangent::scale; });
        points.add_to(sums, f);
      }
    };

    template <bool variational>
    TangentSweeps
    tangent_sweeps(const Element element)
    {
      TangentSweeps result;
      with_kernel<double>(
        element,
        [&]<typename CellKernel>(const std::type_identity<CellKernel>) {
          result.size      = linearization_size<CellKernel, variational>;
          result.linearize = BatchSweep<
            PointOperation<Linearization<variational>, CellKernel>>::run;
          if constexpr (is_factored<CellKernel, variational>)
            {
              result.apply = BatchSweep<MixedTangent<CellKernel>>::run;
              result.needs_displacement = !Factored<CellKernel>::keeps_B;
            }
          else
            result.apply = BatchSweep<
              PointOperation<PointTangent<variational>, CellKernel>>::run;
        });
      return result;
    }
  } // namespace cell_centred
} // namespace corotet

#endif
