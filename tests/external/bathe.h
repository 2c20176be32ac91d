// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef bathe_h
#define bathe_h

#include <corotet/time_integration/time_integrator.h>

/**
 * The composite method of Bathe and Baig (On a composite implicit time
 * integration procedure for nonlinear dynamics, Computers & Structures 83,
 * 2005): the trapezoidal rule to the middle of the step, then the backward
 * formula over start, middle and end. Second order; damps high frequencies
 * strongly, low ones hardly.
 */
class Bathe : public corotet::TimeIntegrator
{
public:
  void
  reset() override;

  corotet::StageReport
  step(corotet::SecondOrderSystem &system,
       const corotet::TimeStep    &step,
       corotet::State             &state) override;

  unsigned int
  order() const override
  {
    return 2;
  }

  bool
  balances_at_end() const override
  {
    return true;
  }

private:
  corotet::State middle;
  corotet::State end;
};

#endif
