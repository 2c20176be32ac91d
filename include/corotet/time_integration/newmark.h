// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_newmark_h
#define corotet_time_integration_newmark_h

#include <corotet/time_integration/newmark_family.h>

namespace corotet
{
  /**
   * Newmark's method (A method of computation for structural dynamics, 1959).
   * With gamma = 1/2 second order, else first; unconditionally stable for
   * 2 beta >= gamma >= 1/2 on linear problems. beta = 1/4, gamma = 1/2, the
   * trapezoidal rule, keeps the energy of linear problems.
   */
  class Newmark : public NewmarkFamily
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    double beta  = 0.25;
    double gamma = 0.5;

  private:
    Coefficients
    coefficients() const override
    {
      return {beta, gamma, 0., 0.};
    }
  };
} // namespace corotet

#endif
