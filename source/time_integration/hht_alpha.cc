// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/hht_alpha.h>

namespace corotet
{
  void
  HHTAlpha::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Alpha",
                      alpha,
                      "Parameter alpha of the method [-]: the more negative, "
                      "the stronger the numerical damping of motion that is "
                      "too fast for the time step. 0 is the trapezoidal rule, "
                      "without damping.",
                      dealii::Patterns::Double(-1. / 3, 0));
  }
} // namespace corotet
