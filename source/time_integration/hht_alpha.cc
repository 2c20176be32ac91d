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
                      "alpha [-]: the more negative, the more of the motion "
                      "that is too fast for the step is dissipated. 0 is the "
                      "trapezoidal rule.",
                      dealii::Patterns::Double(-1. / 3, 0));
  }
} // namespace corotet
