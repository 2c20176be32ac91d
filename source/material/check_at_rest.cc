// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/material/point_law.h>

#include <fmt/format.h>

#include <algorithm>

namespace corotet
{
  using dealii::Tensor;

  void
  check_at_rest(const PointLaw &law, const IsotropicMaterial &material)
  {
    // Of derivatives by finite differences, too.
    constexpr double   tolerance = 1e-6;
    const double       size      = material.lambda + 2 * material.mu;
    const Tensor<2, 3> rest;
    const double       stress = law.stress(material, rest).norm();
    // Not less than that, rather than more: it may not be finite.
    if (!(stress <= tolerance * size))
      throw InputError("Material/Type",
                       fmt::format("the law has a stress of {:.3g} Pa at rest; "
                                   "allowed is none",
                                   stress));
    double difference = 0;
    for (unsigned int ab = 0; ab < 9; ++ab)
      {
        Tensor<2, 3> dF, expected;
        dF[ab / 3][ab % 3] = 1;
        for (unsigned int d = 0; d < 3; ++d)
          expected[d][d] = material.lambda * trace(dF);
        expected += material.mu * (dF + transpose(dF));
        const double found =
          (law.stress_derivative(material, rest, dF) - expected).norm();
        if (!(found <= difference))
          difference = found;
      }
    if (!(difference <= tolerance * size))
      throw InputError("Material/Type",
                       fmt::format("the law is not linear elasticity at rest, "
                                   "with Young's modulus and Poisson's ratio: "
                                   "its stiffness differs by {:.3g} of that; "
                                   "allowed is nothing",
                                   difference / size));
  }
} // namespace corotet
