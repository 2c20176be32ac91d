// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef quadratic_volume_h
#define quadratic_volume_h

#include <corotet/material/point_law.h>

/**
 * A hyperelastic law with the energy
 *
 *   W = mu / 2 (F : F - 3) - mu ln J + lambda / 2 (J - 1)^2,  J = det F,
 *
 * so P = mu (F - F^-T) + lambda (J - 1) J F^-T. It has no stress where J <= 0.
 */
class QuadraticVolume : public corotet::PointLaw
{
public:
  dealii::Tensor<2, 3>
  stress(const corotet::IsotropicMaterial &material,
         const dealii::Tensor<2, 3>       &H) const override;

  dealii::Tensor<2, 3>
  stress_derivative(const corotet::IsotropicMaterial &material,
                    const dealii::Tensor<2, 3>       &H,
                    const dealii::Tensor<2, 3>       &dF) const override;

  double
  energy_density(const corotet::IsotropicMaterial &material,
                 const dealii::Tensor<2, 3>       &H) const override;
};

#endif
