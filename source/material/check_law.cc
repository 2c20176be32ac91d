// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/material/point_law.h>

#include <fmt/format.h>

#include <cmath>

namespace corotet
{
  using dealii::Tensor;

  void
  check_at_rest(const PointLaw &law, const IsotropicMaterial &material)
  {
    // The tolerance allows for derivatives by finite differences.
    constexpr double   tolerance = 1e-6;
    const double       size      = material.lambda + 2 * material.mu;
    const Tensor<2, 3> rest;
    const double       stress = law.stress(material, rest).norm();
    // The negated comparison also finds stresses that are not finite.
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

  LawErrors
  law_errors(const PointLaw          &law,
             const IsotropicMaterial &material,
             const Tensor<2, 3>      &H)
  {
    // The step balances the error of central differences, which grows with its
    // square, and round-off, which is divided by it.
    constexpr double step = 1e-5;
    // Squared norms of the error of the stress, of its derivative by
    // differences, and of the error of the law's derivative.
    const Tensor<2, 3> P       = law.stress(material, H);
    double             stress  = 0;
    double             squares = 0, derivative = 0;
    for (unsigned int ab = 0; ab < 9; ++ab)
      {
        Tensor<2, 3> dF;
        dF[ab / 3][ab % 3] = 1;
        const auto at      = [&](const double sign) -> Tensor<2, 3> {
          return H + sign * step * dF;
        };
        const double dW = (law.energy_density(material, at(1)) -
                           law.energy_density(material, at(-1))) /
                          (2 * step);
        stress += std::pow(P[ab / 3][ab % 3] - dW, 2);
        const Tensor<2, 3> dP =
          (law.stress(material, at(1)) - law.stress(material, at(-1))) /
          (2 * step);
        derivative +=
          (law.stress_derivative(material, H, dF) - dP).norm_square();
        squares += dP.norm_square();
      }
    return {std::sqrt(stress) / P.norm(), std::sqrt(derivative / squares)};
  }
} // namespace corotet
