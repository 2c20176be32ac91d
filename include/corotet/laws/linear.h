// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_laws_linear_h
#define corotet_laws_linear_h

#include <corotet/material/isotropic_law.h>
#include <corotet/material/law.h>
#include <corotet/material/material_law.h>

#include <memory>

namespace corotet
{
  /**
   * Linear elasticity, P = sigma(sym(grad u)) [seed, 2.1.2.1]: right for small
   * rotations only.
   */
  struct LinearElasticity
  {
    static constexpr bool is_linear = true;
    static constexpr int  n_stored  = 0;

    COROTET_ALWAYS_INLINE void
    stress(const LameLanes &lame, const Tensor2Lanes &H, Tensor2Lanes &P) const
    {
      isotropic_stress(lame.lambda, lame.mu, H, P);
    }

    COROTET_ALWAYS_INLINE Simd<double>
    energy_density(const LameLanes &lame, const Tensor2Lanes &H) const
    {
      return isotropic_energy(lame.lambda, lame.mu, H);
    }

    COROTET_ALWAYS_INLINE unsigned int
    linearize(const LameLanes &, const Tensor2Lanes &, NumberLanes<0> &) const
    {
      return 0;
    }

    COROTET_ALWAYS_INLINE void
    derivative(const LameLanes &lame,
               const NumberLanes<0> &,
               const Tensor2Lanes &dF,
               Tensor2Lanes       &dP) const
    {
      stress(lame, dF, dP);
    }

    COROTET_ALWAYS_INLINE void
    spatial_stress(const LameLanes    &lame,
                   const Tensor2Lanes &H,
                   Tensor2Lanes       &sigma) const
    {
      stress(lame, H, sigma);
    }
  };

  std::shared_ptr<const MaterialLaw>
  linear_law();
} // namespace corotet

#endif
