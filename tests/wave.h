// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_wave_h
#define corotet_tests_wave_h

#include <deal.II/base/function.h>
#include <deal.II/base/symmetric_tensor.h>

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "parameter_text.h"

namespace corotet::tests
{
  /**
   * A solution of linear elasticity: u = A sin(k . x + 1/2), a plane wave:
   * smooth and without any symmetry. Then
   * -div sigma = ((lambda + mu) (A . k) k + mu |k|^2 A) sin(k . x + 1/2) and
   * sigma = (lambda (A . k) I + mu (A k^T + k A^T)) cos(k . x + 1/2).
   */
  class Wave : public dealii::Function<3>
  {
  public:
    Wave()
      : dealii::Function<3>(3)
    {}

    double
    value(const dealii::Point<3> &x,
          const unsigned int      component) const override
    {
      return A[component] * std::sin(k * x + 0.5);
    }

    dealii::Tensor<1, 3>
    gradient(const dealii::Point<3> &x,
             const unsigned int      component) const override
    {
      return k * (A[component] * std::cos(k * x + 0.5));
    }

    dealii::SymmetricTensor<2, 3>
    stress(const dealii::Point<3> &x) const
    {
      const dealii::Tensor<2, 3> Ak = outer_product(A, k);
      return std::cos(k * x + 0.5) *
             (2 * mu * symmetrize(Ak) +
              lambda * (A * k) * dealii::unit_symmetric_tensor<3>());
    }

    /// The parameters of a static problem on the unit cube: displacement on
    /// three sides, traction on the others.
    std::string
    parameters(const unsigned int degree) const
    {
      const dealii::Tensor<1, 3> b =
        (lambda + mu) * (A * k) * k + mu * (k * k) * A;
      std::string prescribed, pulled;
      for (unsigned int a = 0; a < 3; ++a)
        {
          dealii::Tensor<1, 3> n;
          n[a] = 1;
          const std::string traction =
            components(lambda * (A * k) * n + mu * (k[a] * A + A[a] * k),
                       "cos");
          const std::string separator = a > 0 ? ", " : "";
          prescribed += fmt::format("{}{}-min: {}",
                                    separator,
                                    "xyz"[a],
                                    components(A, "sin"));
          pulled += fmt::format("{}{}-max: {}", separator, "xyz"[a], traction);
        }
      return element_text(degree) + material_type("linear") +
             material_text(E, nu) + displacements(prescribed) +
             tractions(pulled) +
             section("Loads", {{"Body force", components(b, "sin")}}) +
             linear_solver("direct", 1e-12);
    }

    const double               E = 10, nu = 0.3;
    const double               lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
    const double               mu     = E / (2 * (1 + nu));
    const dealii::Tensor<1, 3> A{{0.1, -0.05, 0.08}}, k{{0.9, 0.6, -1.2}};

  private:
    std::string
    components(const dealii::Tensor<1, 3> &factor,
               const std::string          &function) const
    {
      std::string text;
      for (unsigned int a = 0; a < 3; ++a)
        text += fmt::format("{}{:.17g}*{}({:.17g}*x+{:.17g}*y+{:.17g}*z+0.5)",
                            a > 0 ? "; " : "",
                            factor[a],
                            function,
                            k[0],
                            k[1],
                            k[2]);
      return text;
    }
  };
} // namespace corotet::tests

#endif
