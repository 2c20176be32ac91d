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

  // F^T F - I, and below det F - 1, from H: where H is small, F has not enough
  // digits for them.
  Tensor<2, 3>
  twice_strain(const Tensor<2, 3> &H)
  {
    return H + transpose(H) + transpose(H) * H;
  }

  double
  change_of_volume(const Tensor<2, 3> &H)
  {
    const double trace = dealii::trace(H);
    return trace + 0.5 * (trace * trace - dealii::trace(H * H)) +
           determinant(H);
  }
} // namespace

Tensor<2, 3>
QuadraticVolume::stress(const corotet::IsotropicMaterial &material,
                        const Tensor<2, 3>               &H) const
{
  const Tensor<2, 3> F = deformation_gradient(H), G = transpose(invert(F));
  const double       e = change_of_volume(H);
  // The law has no stress here, which numbers that are not finite tell.
  if (!(e > -1))
    return NAN * F;
  // The first term is mu (F - G) with F - G = G (F^T F - I).
  return material.mu * G * twice_strain(H) + material.lambda * e * (1 + e) * G;
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
  const double e = change_of_volume(H);
  if (!(e > -1))
    return INFINITY;
  return 0.5 * material.mu * (trace(twice_strain(H)) - 2 * std::log1p(e)) +
         0.5 * material.lambda * e * e;
}
