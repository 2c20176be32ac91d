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
    struct CellState
    {
      template <typename Points>
      static COROTET_ALWAYS_INLINE void
      apply(Points &points, const double *displacement, double *)
      {
        Tensor2Lanes R;
        rotations_of(points.data, points.batch, R);
        const auto [lambda, mu] = points.lame();
        points.add_state(displacement, [&](const Tensor2Lanes &H) {
          Tensor2Lanes e;
          corotational_strain(R, H, e);
          return isotropic_energy(lambda, mu, e);
        });
      }
    };

    // Gradient of the energy with one rotation per cell. With A_q = R^T F_q,
    // dA_q = R^T dF_q - W(w) A_q, so to the force of frozen rotations comes
    // w . m with the moment m, the axial vector of sum_q w_q sigma_q A_q^T, and
    // G w = a(R^T dF) at the centre: a stress P = R W(G^{-1} m) there. It
    // neither reads nor changes the rotations of the cells.
    struct VariationalForce
    {
      template <typename Points>
      static COROTET_ALWAYS_INLINE void
      apply(Points &points, const double *displacement, double *sums)
      {
        typename Points::NodalValues u, f{};
        Tensor2Lanes                 R, F;
        points.load(displacement, u);
        points.gradient_at_centre(u, F);
        add_identity(F);
        points.data.counts.add(polar_decomposition(F, R), points.constants);
        const auto [lambda, mu] = points.lame();
        V          moment[3]{};
        const auto stress =
          [&](const unsigned int q, Tensor2Lanes &F, Tensor2Lanes &P) {
            Tensor2Lanes A, sigma;
            add_identity(F);
            transposed_times(R, F, A);
            stress_of_stretch(lambda, mu, A, sigma);
            times(R, sigma, P);
            add_moment(points.weight(q), sigma, A, moment);
          };
        points.integrate(u, f, stress);
        V            S[6], G_inverse[6], n[3];
        Tensor2Lanes RW;
        stretch(R, F, S);
        inverse_spin_tensor(S, G_inverse);
        symmetric_times(G_inverse, moment, n);
        times_skew(R, n, RW);
        points.add_at_centre(RW, f);
        points.add_to(sums, f);
      }
    };

    // G^{-1}, S if variational, B of each point, n if variational.
    template <bool variational>
    constexpr LinearizationSize linearization_size{variational ? 15u : 6u, 9u};

    template <bool variational>
    struct CellLinearization
    {
      template <typename Points>
      static COROTET_ALWAYS_INLINE void
      apply(Points &points, const double *displacement, double *)
      {
        typename Points::NodalValues u;
        gather_differences<Points::n_nodes>(points.data.batches,
                                            points.batch,
                                            displacement,
                                            u);
        load_rotated(points.data, points.batch, points.g);
        NumberWriter numbers = points.writer(linearization_size<variational>);
        const auto [lambda, mu] = points.lame();
        Tensor2Lanes R, B;
        V            S[6], G_inverse[6], moment[3]{};
        rotations_of(points.data, points.batch, R);
        points.gradient_at_centre(u, B);
        add_transposed(R, B);
        symmetric_part(B, S);
        points.count_clamped(inverse_spin_tensor(S, G_inverse));
        numbers.write(G_inverse);
        if constexpr (variational)
          numbers.write(S);
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

    // Derivative of the force of one rotation per cell. With H = dF R^T and the
    // change w of the rotation, G w = a(H) at the centre, the strain changes by
    // sym(H - W(w) B) and P R^T by sigma(H - W(w) B) + W(w) sigma.
    template <bool variational>
    struct CellTangent
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
        NumberReader numbers = points.reader(linearization_size<variational>);
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
            // Of the part with frozen rotations a multiple is wanted.
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
      // In the variational force, the stress W(n) at the centre, G n = m,
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
        result.state = point_sweep<CellState>(element);
        if constexpr (variational)
          result.force = point_sweep<VariationalForce>(element);
        else
          {
            result.force         = rotation_and_force_sweep(element);
            result.force_scale   = stiffness_scale(element);
            result.force_rotates = true;
          }
        result.consistent = {linearization_size<variational>,
                             point_sweep<CellLinearization<variational>>(
                               element),
                             point_sweep<CellTangent<variational>>(element)};
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
