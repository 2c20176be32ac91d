// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/material/isotropic.h>
#include <corotet/material/isotropic_law.h>

#include <algorithm>

namespace corotet
{
  unsigned int
  index_of(const IsotropicMaterial        &material,
           std::vector<IsotropicMaterial> &known)
  {
    const auto found =
      std::find_if(known.begin(), known.end(), [&](const auto &other) {
        return other.lambda == material.lambda && other.mu == material.mu;
      });
    const unsigned int index = found - known.begin();
    if (found == known.end())
      known.push_back(material);
    return index;
  }

  dealii::SymmetricTensor<2, 3>
  stress(const IsotropicMaterial             &material,
         const dealii::SymmetricTensor<2, 3> &strain)
  {
    dealii::SymmetricTensor<2, 3> sigma;
    isotropic_stress(material.lambda, material.mu, strain, sigma);
    return sigma;
  }

  double
  energy_density(const IsotropicMaterial             &material,
                 const dealii::SymmetricTensor<2, 3> &strain)
  {
    return isotropic_energy(material.lambda, material.mu, strain);
  }
} // namespace corotet
