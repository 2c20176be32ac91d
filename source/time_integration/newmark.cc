// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/newmark.h>

namespace corotet
{
  void
  Newmark::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "Beta",
      beta,
      "Parameter beta of Newmark's method [-]. 0.25 with gamma = 0.5 is the "
      "trapezoidal rule.",
      dealii::Patterns::Double(1e-3, 1));
    prm.add_parameter("Gamma",
                      gamma,
                      "Parameter gamma of Newmark's method [-]. 0.5 gives "
                      "second order and no numerical damping; larger values "
                      "damp and give first order. Above 2 beta, long steps are "
                      "unstable.",
                      dealii::Patterns::Double(0.5, 1.5));
  }
} // namespace corotet
