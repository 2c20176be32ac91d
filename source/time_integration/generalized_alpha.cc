// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/generalized_alpha.h>

namespace corotet
{
  void
  GeneralizedAlpha::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Spectral radius",
                      spectral_radius,
                      "Spectral radius at infinity, rho_infinity [-]: the "
                      "factor by which each step multiplies motion that is far "
                      "too fast for it. 1: no numerical damping; smaller "
                      "values damp more.",
                      dealii::Patterns::Double(0, 1));
  }

  GeneralizedAlpha::Coefficients
  GeneralizedAlpha::coefficients() const
  {
    const double rho     = spectral_radius;
    const double alpha_m = (2 * rho - 1) / (rho + 1);
    const double alpha_f = rho / (rho + 1);
    const double gamma   = 0.5 - alpha_m + alpha_f;
    const double beta =
      0.25 * (1 - alpha_m + alpha_f) * (1 - alpha_m + alpha_f);
    return {beta, gamma, alpha_m, alpha_f};
  }
} // namespace corotet
