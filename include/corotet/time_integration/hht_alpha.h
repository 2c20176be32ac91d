// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_hht_alpha_h
#define corotet_time_integration_hht_alpha_h

#include <corotet/time_integration/newmark_family.h>

namespace corotet
{
  /**
   * HHT-alpha method (Hilber, Hughes and Taylor, Improved numerical dissipation
   * for time integration algorithms in structural dynamics, 1977), with all
   * forces but inertia taken at the intermediate displacement. Second order;
   * unconditionally stable for linear problems. alpha [-], in [-1/3, 0], sets
   * the dissipation of motion that the step does not resolve; 0 is the
   * trapezoidal rule.
   */
  class HHTAlpha : public NewmarkFamily
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    double alpha = -0.1;

  private:
    Coefficients
    coefficients() const override
    {
      return {0.25 * (1 - alpha) * (1 - alpha), 0.5 - alpha, 0., -alpha};
    }
  };
} // namespace corotet

#endif
