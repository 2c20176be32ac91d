// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/laws/saint_venant_kirchhoff.h>
#include <corotet/operators/law_sweeps.h>

namespace corotet
{
  namespace
  {
    struct SaintVenantKirchhoff
    {
      // The numbers stored are H.
      static constexpr int n_stored = 9;

      COROTET_ALWAYS_INLINE void
      stress(const LameLanes    &lame,
             const Tensor2Lanes &H,
             Tensor2Lanes       &P) const
      {
        Tensor2Lanes S;
        second_stress(lame, H, S);
        times_F(H, S, P);
      }

      COROTET_ALWAYS_INLINE Simd<double>
      energy_density(const LameLanes &lame, const Tensor2Lanes &H) const
      {
        Tensor2Lanes E;
        strain(H, E);
        return isotropic_energy(lame.lambda, lame.mu, E);
      }

      COROTET_ALWAYS_INLINE unsigned int
      linearize(const LameLanes &,
                const Tensor2Lanes    &H,
                NumberLanes<n_stored> &stored) const
      {
        static_for<9>([&](auto i) { stored[i] = H[i / 3][i % 3]; });
        return 0;
      }

      // dP = dF S + F dS with dE = sym(F^T dF).
      COROTET_ALWAYS_INLINE void
      derivative(const LameLanes             &lame,
                 const NumberLanes<n_stored> &stored,
                 const Tensor2Lanes          &dF,
                 Tensor2Lanes                &dP) const
      {
        Tensor2Lanes H, S, A, dS, dF_S;
        static_for<9>([&](auto i) { H[i / 3][i % 3] = stored[i]; });
        second_stress(lame, H, S);
        transposed_times(H, dF, A);
        static_for<9>([&](auto i) { A[i / 3][i % 3] += dF[i / 3][i % 3]; });
        isotropic_stress(lame.lambda, lame.mu, A, dS);
        times_F(H, dS, dP);
        times(dF, S, dF_S);
        static_for<9>([&](auto i) { dP[i / 3][i % 3] += dF_S[i / 3][i % 3]; });
      }

    private:
      // E and H^T H / 2 + H have the same symmetric part.
      static COROTET_ALWAYS_INLINE void
      strain(const Tensor2Lanes &H, Tensor2Lanes &E)
      {
        transposed_times(H, H, E);
        static_for<9>([&](auto i) {
          E[i / 3][i % 3] = 0.5 * E[i / 3][i % 3] + H[i / 3][i % 3];
        });
      }

      static COROTET_ALWAYS_INLINE void
      second_stress(const LameLanes    &lame,
                    const Tensor2Lanes &H,
                    Tensor2Lanes       &S)
      {
        Tensor2Lanes E;
        strain(H, E);
        isotropic_stress(lame.lambda, lame.mu, E, S);
      }

      // FX = F X.
      static COROTET_ALWAYS_INLINE void
      times_F(const Tensor2Lanes &H, const Tensor2Lanes &X, Tensor2Lanes &FX)
      {
        times(H, X, FX);
        static_for<9>([&](auto i) { FX[i / 3][i % 3] += X[i / 3][i % 3]; });
      }
    };
  } // namespace

  std::shared_ptr<const MaterialLaw>
  saint_venant_kirchhoff_law()
  {
    return std::make_shared<MaterialLawOf<SaintVenantKirchhoff>>();
  }
} // namespace corotet
