// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_generalized_alpha_h
#define corotet_time_integration_generalized_alpha_h

#include <corotet/time_integration/newmark_family.h>

namespace corotet
{
  /**
   * Generalized-alpha method (Chung and Hulbert, A time integration algorithm
   * for structural dynamics with improved numerical dissipation, 1993), with
   * all forces taken at the intermediate displacement. Second order;
   * unconditionally stable for linear problems. The spectral radius at
   * infinity [-], in [0, 1], sets the dissipation of motion that the step does
   * not resolve; 1 dissipates nothing. Assumes a consistent initial
   * acceleration.
   */
  class GeneralizedAlpha : public NewmarkFamily
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    double spectral_radius = 0.8;

  private:
    Coefficients
    coefficients() const override;
  };
} // namespace corotet

#endif
