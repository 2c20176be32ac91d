// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_rayleigh_damping_h
#define corotet_simulation_rayleigh_damping_h

#include <deal.II/base/parameter_handler.h>

#include <vector>

namespace corotet
{
  /// Rayleigh damping C = alpha_M M + alpha_K K: alpha_M [1/s], alpha_K [s].
  struct RayleighDamping
  {
    double mass      = 0;
    double stiffness = 0;
  };

  /**
   * The parameters of section Damping: the coefficients, or the damping ratios
   * zeta = alpha_M / (2 omega) + alpha_K omega / 2 [-] at two frequencies
   * omega / (2 pi) [Hz], which determine them.
   */
  struct DampingParameters
  {
    void
    declare_parameters(dealii::ParameterHandler &prm);

    /// Throws InputError if coefficients and ratios are both given, or if the
    /// ratios need a negative coefficient, which would be an excitation.
    RayleighDamping
    coefficients() const;

    RayleighDamping     given;
    std::vector<double> frequencies;
    std::vector<double> ratios;
  };
} // namespace corotet

#endif
