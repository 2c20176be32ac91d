// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_law_at_points_h
#define corotet_material_law_at_points_h

#include <corotet/material/law.h>
#include <corotet/material/material_law.h>

#include <algorithm>

namespace corotet
{
  namespace internal
  {
    /// Loads @p tensors from @p first on into the lanes; other lanes become
    /// zero.
    inline void
    to_lanes(const std::span<const dealii::Tensor<2, 3>> tensors,
             const std::size_t                           first,
             Tensor2Lanes                               &result)
    {
      static_for<9>([&](auto ab) { result[ab / 3][ab % 3] = Simd<double>{}; });
      const std::size_t n =
        std::min<std::size_t>(n_lanes<double>, tensors.size() - first);
      for (std::size_t lane = 0; lane < n; ++lane)
        static_for<9>([&](auto ab) {
          result[ab / 3][ab % 3][lane] = tensors[first + lane][ab / 3][ab % 3];
        });
    }

    inline dealii::Tensor<2, 3>
    of_lane(const Tensor2Lanes &tensors, const unsigned int lane)
    {
      dealii::Tensor<2, 3> result;
      static_for<9>([&](auto ab) {
        result[ab / 3][ab % 3] = tensors[ab / 3][ab % 3][lane];
      });
      return result;
    }

    inline LameLanes
    lame_of(const IsotropicMaterial &material)
    {
      return {broadcast(material.lambda), broadcast(material.mu)};
    }

    /// Cauchy's stress P F^T / det F.
    COROTET_ALWAYS_INLINE void
    cauchy_stress(const Tensor2Lanes &H,
                  const Tensor2Lanes &P,
                  Tensor2Lanes       &sigma)
    {
      Tensor2Lanes F;
      static_for<9>([&](auto ab) {
        F[ab / 3][ab % 3] = H[ab / 3][ab % 3] + (ab / 3 == ab % 3 ? 1. : 0.);
      });
      Simd<double> det_F{};
      static_for<3>([&](auto a) {
        constexpr int b = (a + 1) % 3, c = (a + 2) % 3;
        det_F += F[0][a] * (F[1][b] * F[2][c] - F[1][c] * F[2][b]);
      });
      static_for<9>([&](auto ab) {
        constexpr int a = ab / 3, b = ab % 3;
        sigma[a][b] =
          (P[a][0] * F[b][0] + P[a][1] * F[b][1] + P[a][2] * F[b][2]) / det_F;
      });
    }
  } // namespace internal

  /**
   * The members of MaterialLaw for single points, by a Law.
   */
  template <Law L>
  class LawAtPoints : public MaterialLaw
  {
  public:
    explicit LawAtPoints(const L &law = {})
      : law(law)
    {}

    bool
    is_linear() const override
    {
      return is_linear_law<L>;
    }

    dealii::Tensor<2, 3>
    stress(const IsotropicMaterial    &material,
           const dealii::Tensor<2, 3> &H) const override
    {
      Tensor2Lanes H_lanes, P;
      internal::to_lanes({&H, 1}, 0, H_lanes);
      law.stress(internal::lame_of(material), H_lanes, P);
      return internal::of_lane(P, 0);
    }

    dealii::Tensor<2, 3>
    stress_derivative(const IsotropicMaterial    &material,
                      const dealii::Tensor<2, 3> &H,
                      const dealii::Tensor<2, 3> &dF) const override
    {
      const LameLanes          lame = internal::lame_of(material);
      Tensor2Lanes             H_lanes, dF_lanes, dP;
      NumberLanes<L::n_stored> stored;
      internal::to_lanes({&H, 1}, 0, H_lanes);
      internal::to_lanes({&dF, 1}, 0, dF_lanes);
      law.linearize(lame, H_lanes, stored);
      if constexpr (LawWithFrozenForm<L>)
        law.derivative(lame, 1., stored, dF_lanes, dP);
      else
        law.derivative(lame, stored, dF_lanes, dP);
      return internal::of_lane(dP, 0);
    }

    double
    energy_density(const IsotropicMaterial    &material,
                   const dealii::Tensor<2, 3> &H) const override
    {
      Tensor2Lanes H_lanes;
      internal::to_lanes({&H, 1}, 0, H_lanes);
      return law.energy_density(internal::lame_of(material), H_lanes)[0];
    }

    void
    spatial_stresses(const IsotropicMaterial &material,
                     const dealii::Tensor<2, 3> & /*centre*/,
                     const std::span<const dealii::Tensor<2, 3>> H,
                     dealii::SymmetricTensor<2, 3> *result) const override
    {
      const LameLanes lame = internal::lame_of(material);
      for (std::size_t first = 0; first < H.size(); first += n_lanes<double>)
        {
          Tensor2Lanes H_lanes, sigma;
          internal::to_lanes(H, first, H_lanes);
          if constexpr (requires { law.spatial_stress(lame, H_lanes, sigma); })
            law.spatial_stress(lame, H_lanes, sigma);
          else
            {
              Tensor2Lanes P;
              law.stress(lame, H_lanes, P);
              internal::cauchy_stress(H_lanes, P, sigma);
            }
          const std::size_t end =
            std::min<std::size_t>(first + n_lanes<double>, H.size());
          for (std::size_t q = first; q < end; ++q)
            result[q] = symmetrize(internal::of_lane(sigma, q - first));
        }
    }

  protected:
    const L law;
  };
} // namespace corotet

#endif
