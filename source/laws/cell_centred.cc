// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/laws/cell_centred.h>
#include <corotet/material/corotational.h>
#include <corotet/material/polar_decomposition.h>
#include <corotet/operators/point_operations.h>
#include <corotet/operators/rotated_frame.h>

namespace corotet
{
  namespace
  {
    using V = Simd<double>;

    // The energy with the rotations of cells that there are.
    template <typename CellKernel>
    struct CellState : PointOperation<CellKernel>
    {
      template <typename IsCurved>
      static COROTET_ALWAYS_INLINE void
      apply(const IsCurved     is_curved,
            ElasticData       &data,
            const unsigned int batch,
            const double      *displacement,
            double *)
      {
        Tensor2Lanes R;
        rotations_of(data, batch, R);
        const LameLanes moduli = lame(data.shapes[batch]);
        CellState::add_state(
          is_curved, data, batch, displacement, [&](const Tensor2Lanes &H) {
            Tensor2Lanes e;
            corotational_strain(R, H, e);
            return isotropic_energy(moduli.lambda, moduli.mu, e);
          });
      }
    };

    // Gradient of the energy with one rotation per cell. With A_q = R^T F_q,
    // dA_q = R^T dF_q - W(w) A_q, so to the force of frozen rotations comes
    // w . m with the moment m, the axial vector of sum_q w_q sigma_q A_q^T, and
    // G w = a(R^T dF) at the centre: a stress P = R W(G^{-1} m) there. It
    // neither reads nor changes the rotations of the cells.
    template <typename CellKernel>
    struct VariationalForce : PointOperation<CellKernel>
    {
      template <typename IsCurved>
      static COROTET_ALWAYS_INLINE void
      apply(const IsCurved     is_curved,
            ElasticData       &data,
            const unsigned int batch,
            const double      *displacement,
            double            *sums)
      {
        using Kernel                        = typename VariationalForce::Kernel;
        const CellShapes            &shapes = data.shapes[batch];
        typename Kernel::NodalValues u, f{};
        typename Kernel::Geometry    g;
        Kernel::load(data, batch, displacement, g, u);
        Tensor2Lanes R, F;
        Kernel::gradient(data.reference.centre, 0, g, u, F);
        add_identity(F);
        data.counts.add(polar_decomposition(F, R), shapes);
        const auto [lambda, mu] = lame(shapes);
        const V     volume      = lanes(shapes.volume);
        V           moment[3]{};
        const auto &rule =
          cell_rule(is_curved, data.reference, data.batches, batch);
        const auto stress =
          [&](const unsigned int q, Tensor2Lanes &F, Tensor2Lanes &P) {
            Tensor2Lanes A, sigma;
            add_identity(F);
            transposed_times(R, F, A);
            stress_of_stretch(lambda, mu, A, sigma);
            times(R, sigma, P);
            add_moment(weight_at(rule, q) * volume, sigma, A, moment);
          };
        Kernel::integrate(rule, g, volume, u, f, stress);
        V            S[6], G_inverse[6], n[3];
        Tensor2Lanes RW;
        stretch(R, F, S);
        inverse_spin_tensor(S, G_inverse);
        symmetric_times(G_inverse, moment, n);
        times_skew(R, n, RW);
        Kernel::add(data.reference.centre, 0, g, RW, f);
        scatter_add<Kernel::n_nodes>(f, data.batches.nodes(batch), sums);
      }
    };

    // G^{-1}, S if variational, B of each point, n if variational.
    template <bool variational>
    constexpr LinearizationSize linearization_size{variational ? 15u : 6u, 9u};

    template <typename CellKernel, bool variational>
    struct CellLinearization : PointOperation<CellKernel>
    {
      template <typename IsCurved>
      static COROTET_ALWAYS_INLINE void
      apply(const IsCurved     is_curved,
            ElasticData       &data,
            const unsigned int batch,
            const double      *displacement,
            double *)
      {
        using Kernel = typename CellLinearization::Kernel;
        const CellShapes            &shapes = data.shapes[batch];
        typename Kernel::NodalValues u;
        typename Kernel::Geometry    g;
        gather_differences<Kernel::n_nodes>(data.batches,
                                            batch,
                                            displacement,
                                            u);
        load_rotated(data, batch, g);
        const auto &rule =
          cell_rule(is_curved, data.reference, data.batches, batch);
        NumberWriter numbers{data.new_linearization +
                             linearization_start<IsCurved::value>(
                               data, linearization_size<variational>, batch)};
        const auto [lambda, mu] = lame(shapes);
        Tensor2Lanes R, B;
        V            S[6], G_inverse[6], moment[3]{};
        rotations_of(data, batch, R);
        Kernel::gradient(data.reference.centre, 0, g, u, B);
        add_transposed(R, B);
        symmetric_part(B, S);
        CellLinearization::count_clamped(inverse_spin_tensor(S, G_inverse),
                                         shapes,
                                         data);
        numbers.write(G_inverse);
        if constexpr (variational)
          numbers.write(S);
        for (unsigned int q = 0; q < n_points(rule); ++q)
          {
            Kernel::gradient(rule, q, g, u, B);
            add_transposed(R, B);
            numbers.write(B);
            if constexpr (variational)
              {
                Tensor2Lanes sigma;
                stress_of_stretch(lambda, mu, B, sigma);
                add_moment(weight_at(rule, q) * lanes(shapes.volume),
                           sigma,
                           B,
                           moment);
              }
          }
        if constexpr (variational)
          {
            V n[3];
            symmetric_times(G_inverse, moment, n);
            numbers.write(n);
          }
      }
    };

    // Derivative of the force of one rotation per cell. With H = dF R^T and the
    // change w of the rotation, G w = a(H) at the centre, the strain changes by
    // sym(H - W(w) B) and P R^T by sigma(H - W(w) B) + W(w) sigma.
    template <typename CellKernel, bool variational>
    struct CellTangent : PointOperation<CellKernel>
    {
      using Kernel = typename PointOperation<CellKernel>::Kernel;

      template <typename IsCurved>
      static COROTET_ALWAYS_INLINE void
      apply(const IsCurved     is_curved,
            ElasticData       &data,
            const unsigned int batch,
            const double      *source,
            double            *sums)
      {
        const CellShapes            &shapes = data.shapes[batch];
        typename Kernel::NodalValues u, f;
        typename Kernel::Geometry    g;
        CellTangent::template gather_with_matrices<IsCurved::value>(
          data, batch, source, 0., u, f);
        load_rotated(data, batch, g);
        const auto [lambda, mu] = lame(shapes);
        const V     volume      = lanes(shapes.volume);
        const auto &rule =
          cell_rule(is_curved, data.reference, data.batches, batch);
        NumberReader numbers{data.linearization +
                             linearization_start<IsCurved::value>(
                               data, linearization_size<variational>, batch)};
        Tensor2Lanes H;
        V            G_inverse[6], S[6], a[3], w[3], dm[3]{};
        numbers.read(G_inverse);
        if constexpr (variational)
          numbers.read(S);
        Kernel::gradient(data.reference.centre, 0, g, u, H);
        axial_vector(H, a);
        symmetric_times(G_inverse, a, w);
        const auto stress =
          [&](const unsigned int q, const Tensor2Lanes &H, Tensor2Lanes &P) {
            Tensor2Lanes B, e, WB, sigma, W_sigma;
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
                const V      weight = weight_at(rule, q) * volume;
                Tensor2Lanes d_sigma;
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
            V n[3];
            numbers.read(n);
            add_at_centre(data, g, G_inverse, S, H, w, n, dm, f);
          }
        scatter_add<Kernel::n_nodes>(f, data.batches.nodes(batch), sums);
      }

    private:
      // In the variational force, the stress W(n) at the centre, G n = m,
      // changes by W(w) W(n) + W(dn), where G dn = dm - dG n.
      static COROTET_ALWAYS_INLINE void
      add_at_centre(const ElasticData               &data,
                    const typename Kernel::Geometry &g,
                    const V (&G_inverse)[6],
                    const V (&S)[6],
                    const Tensor2Lanes &H,
                    const V (&w)[3],
                    const V (&n)[3],
                    V (&dm)[3],
                    typename Kernel::NodalValues &f)
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
        Kernel::add(data.reference.centre, 0, g, P, f);
      }
    };

    // Where all points are alike, the law is that at points.
    template <bool variational>
    class CellCentred : public MaterialLaw
    {
    public:
      explicit CellCentred(const std::shared_ptr<const MaterialLaw> &at_points)
        : at_points(at_points)
      {}

      bool
      is_linear() const override
      {
        return false;
      }

      bool
      has_cell_rotation() const override
      {
        return true;
      }

      bool
      has_energy(const unsigned int degree) const override
      {
        return variational || degree == 1;
      }

      dealii::Tensor<2, 3>
      stress(const IsotropicMaterial    &material,
             const dealii::Tensor<2, 3> &H) const override
      {
        return at_points->stress(material, H);
      }

      dealii::Tensor<2, 3>
      stress_derivative(const IsotropicMaterial    &material,
                        const dealii::Tensor<2, 3> &H,
                        const dealii::Tensor<2, 3> &dF) const override
      {
        return at_points->stress_derivative(material, H, dF);
      }

      double
      energy_density(const IsotropicMaterial    &material,
                     const dealii::Tensor<2, 3> &H) const override
      {
        return at_points->energy_density(material, H);
      }

      void
      spatial_stresses(const IsotropicMaterial                    &material,
                       const dealii::Tensor<2, 3>                 &centre,
                       const std::span<const dealii::Tensor<2, 3>> H,
                       dealii::SymmetricTensor<2, 3> *sigma) const override
      {
        using dealii::Tensor;
        const Tensor<2, 3> R =
          polar_decomposition(centre +
                              Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()))
            .rotation;
        for (std::size_t q = 0; q < H.size(); ++q)
          sigma[q] =
            symmetrize(R *
                       Tensor<2, 3>(corotet::stress(
                         material, corotet::corotational_strain(H[q], R))) *
                       transpose(R));
      }

      ElasticSweeps
      sweeps(const Element element) const override
      {
        ElasticSweeps result;
        result.state = sweep_of_element<double>(
          element, []<typename Kernel>(const std::type_identity<Kernel>) {
            return BatchSweep<CellState<Kernel>>::run;
          });
        if constexpr (variational)
          result.force = sweep_of_element<double>(
            element, []<typename Kernel>(const std::type_identity<Kernel>) {
              return BatchSweep<VariationalForce<Kernel>>::run;
            });
        else
          {
            result.force         = rotation_and_force_sweep(element);
            result.force_scale   = stiffness_scale(element);
            result.force_rotates = true;
          }
        result.consistent = {
          linearization_size<variational>,
          sweep_of_element<double>(
            element,
            []<typename Kernel>(const std::type_identity<Kernel>) {
              return BatchSweep<CellLinearization<Kernel, variational>>::run;
            }),
          sweep_of_element<double>(
            element, []<typename Kernel>(const std::type_identity<Kernel>) {
              return BatchSweep<CellTangent<Kernel, variational>>::run;
            })};
        return result;
      }

    private:
      const std::shared_ptr<const MaterialLaw> at_points;
    };
  } // namespace

  std::shared_ptr<const MaterialLaw>
  cell_centred_law(const bool                                variational,
                   const std::shared_ptr<const MaterialLaw> &at_points)
  {
    if (variational)
      return std::make_shared<CellCentred<true>>(at_points);
    return std::make_shared<CellCentred<false>>(at_points);
  }
} // namespace corotet
