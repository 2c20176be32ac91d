// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/laws/cell_centred.h>
#include <corotet/material/corotational.h>
#include <corotet/material/polar_decomposition.h>
#include <corotet/operators/point_operations.h>

#include "cell_centred_tangent.h"

namespace corotet
{
  namespace
  {
    using V = Simd<double>;

    // Computes the elastic state with the present rotations of the cells.
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

    // The force that is the gradient of the energy with one rotation per cell.
    // With A_q = R^T F_q, dA_q = R^T dF_q - W(w) A_q, so the variation of the
    // energy has, beside the force of frozen rotations, a term w . m with the
    // moment m, the axial vector of sum_q w_q sigma_q A_q^T, and G w = a(R^T
    // dF) at the centre: a stress P = R W(G^{-1} m) there. It neither reads nor
    // changes the rotations of the cells.
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

    // The law with one rotation per cell; at degree 1, where all points of a
    // cell are alike, the law at points does its work.
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
        result.consistent = cell_centred::tangent_sweeps<variational>(element);
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
