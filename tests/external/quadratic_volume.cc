// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "quadratic_volume.h"

#include <cmath>

using dealii::Tensor;

namespace
{
  Tensor<2, 3>
  deformation_gradient(Tensor<2, 3> H)
  {
    for (unsigned int a = 0; a < 3; ++a)
      H[a][a] += 1;
    return H;
  }
} // namespace

Tensor<2, 3>
QuadraticVolume::stress(const corotet::IsotropicMaterial &material,
                        const Tensor<2, 3>               &H) const
{
  const Tensor<2, 3> F = deformation_gradient(H), G = transpose(invert(F));
  const double       J = determinant(F);
  // Numbers that are not finite say that there is no stress.
  if (!(J > 0))
    return NAN * F;
  return material.mu * (F - G) + material.lambda * (J - 1) * J * G;
}

// dG = -G dF^T G, dJ = J G : dF.
Tensor<2, 3>
QuadraticVolume::stress_derivative(const corotet::IsotropicMaterial &material,
                                   const Tensor<2, 3>               &H,
                                   const Tensor<2, 3>               &dF) const
{
  const Tensor<2, 3> F = deformation_gradient(H), G = transpose(invert(F));
  const double J = determinant(F), pressure = material.lambda * (J - 1) * J;
  return material.mu * dF + (material.mu - pressure) * (G * transpose(dF) * G) +
         material.lambda * (2 * J - 1) * J * scalar_product(G, dF) * G;
}

double
QuadraticVolume::energy_density(const corotet::IsotropicMaterial &material,
                                const Tensor<2, 3>               &H) const
{
  const Tensor<2, 3> F = deformation_gradient(H);
  const double       J = determinant(F);
  if (!(J > 0))
    return INFINITY;
  return 0.5 * material.mu * (scalar_product(F, F) - 3 - 2 * std::log(J)) +
         0.5 * material.lambda * (J - 1) * (J - 1);
}
