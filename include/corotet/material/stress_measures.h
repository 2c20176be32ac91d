// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_stress_measures_h
#define corotet_material_stress_measures_h

#include <corotet/material/isotropic.h>

#include <array>

namespace corotet
{
  /**
   * The strain that a stress comes from, C^{-1} sigma [-]. Its product with the
   * stress is twice the elastic energy per volume.
   */
  inline dealii::SymmetricTensor<2, 3>
  strain_of_stress(const IsotropicMaterial             &material,
                   const dealii::SymmetricTensor<2, 3> &sigma)
  {
    const double                  lambda = material.lambda, mu = material.mu;
    dealii::SymmetricTensor<2, 3> strain = sigma / (2 * mu);
    const double p = lambda / (2 * mu * (3 * lambda + 2 * mu)) * trace(sigma);
    for (unsigned int a = 0; a < 3; ++a)
      strain[a][a] -= p;
    return strain;
  }

  /**
   * Principal values of a symmetric tensor, largest first; to round-off of its
   * norm, also where two of them are equal. Not finite if the tensor is not.
   */
  std::array<double, 3>
  principal_values(const dealii::SymmetricTensor<2, 3> &tensor);
} // namespace corotet

#endif
