// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/differentiation.h>
#include <corotet/base/text.h>
#include <corotet/material/exact_solution.h>
#include <corotet/material/polar_decomposition.h>

#include <cmath>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    const std::string entry = "Exact solution/Displacement";

    // Derivative of the stress P(F) of the corotational law in the direction
    // dF, with the derivative of the rotation: from R^T dF = W S + dS with skew
    // W = R^T dR and symmetric dS.
    Tensor<2, 3>
    stress_derivative(const IsotropicMaterial &material,
                      const Tensor<2, 3>      &R,
                      const Tensor<2, 3>      &S,
                      const Tensor<2, 3>      &dF)
    {
      const Tensor<2, 3> A = transpose(R) * dF;
      Tensor<2, 3>       M = -1. * S;
      for (unsigned int a = 0; a < 3; ++a)
        M[a][a] += trace(S);
      const Tensor<1, 3> w =
        invert(M) *
        Tensor<1, 3>({A[2][1] - A[1][2], A[0][2] - A[2][0], A[1][0] - A[0][1]});
      Tensor<2, 3> W;
      W[2][1]             = w[0];
      W[1][2]             = -w[0];
      W[0][2]             = w[1];
      W[2][0]             = -w[1];
      W[1][0]             = w[2];
      W[0][1]             = -w[2];
      Tensor<2, 3> strain = S;
      for (unsigned int a = 0; a < 3; ++a)
        strain[a][a] -= 1;
      return R * (W * Tensor<2, 3>(stress(material, symmetrize(strain))) +
                  Tensor<2, 3>(stress(material, symmetrize(A - W * S))));
    }
  } // namespace

  void
  ExactSolutionParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Displacement",
                      displacement,
                      "The body's exact displacement [m]: 'x; y; z', "
                      "expressions in x, y, z, t that can be differentiated; "
                      "then summary.json has the errors at the end of the run. "
                      "Empty: not known.");
    prm.add_parameter("Manufacture",
                      manufacture,
                      "Whether body force, tractions, prescribed displacements "
                      "and the initial state are made such that this is the "
                      "solution. If not, those of this file must be.");
    prm.add_parameter("Displacement boundary",
                      displacement_boundary,
                      "Boundaries where the displacement is prescribed if data "
                      "are made: 'name, name', 'all' or 'none'. The others get "
                      "tractions.");
  }

  ExactSolution::ExactSolution(const std::string &text)
    : text(text)
    , u(text, 3, entry)
    , acceleration(derivatives(text, {{"t", "t"}}))
    , first(derivatives(text, {{"x"}, {"y"}, {"z"}}))
    , second(derivatives(text,
                         {{"x", "x"},
                          {"y", "y"},
                          {"z", "z"},
                          {"y", "z"},
                          {"x", "z"},
                          {"x", "y"}}))
  {}

  Expression
  ExactSolution::derivatives(
    const std::string                           &text,
    const std::vector<std::vector<std::string>> &variables)
  {
    std::vector<std::string> formulas;
    for (const auto &list : variables)
      for (const std::string &component : split_outside_brackets(text, ';'))
        formulas.push_back(differentiate(component, list, entry));
    return Expression(join(formulas, "; "), formulas.size(), entry);
  }

  std::string
  ExactSolution::velocity_text() const
  {
    std::vector<std::string> formulas;
    for (const std::string &component : split_outside_brackets(text, ';'))
      formulas.push_back(differentiate(component, {"t"}, entry));
    return join(formulas, "; ");
  }

  Tensor<2, 3>
  ExactSolution::gradient(const Point<3> &x, const double t) const
  {
    Tensor<2, 3> result;
    for (unsigned int b = 0; b < 3; ++b)
      for (unsigned int a = 0; a < 3; ++a)
        result[a][b] = first.value(x, t, 3 * b + a);
    return result;
  }

  Tensor<2, 3>
  ExactSolution::stress(const IsotropicMaterial &material,
                        const bool               is_linear,
                        const Point<3>          &x,
                        const double             t) const
  {
    const Tensor<2, 3> grad_u = gradient(x, t);
    Tensor<2, 3>       R;
    for (unsigned int a = 0; a < 3; ++a)
      R[a][a] = 1;
    if (!is_linear)
      R = polar_decomposition(R + grad_u).rotation;
    return corotational_stress(material, grad_u, R);
  }

  Tensor<1, 3>
  ExactSolution::body_force(const IsotropicMaterial &material,
                            const bool               is_linear,
                            const bool               with_inertia,
                            const Point<3>          &x,
                            const double             t) const
  {
    Tensor<1, 3> b;
    if (with_inertia)
      b = material.density * acceleration.vector_value(x, t);

    Tensor<2, 3> R, S;
    for (unsigned int a = 0; a < 3; ++a)
      R[a][a] = S[a][a] = 1;
    if (!is_linear)
      {
        const Tensor<2, 3> F = R + gradient(x, t);
        R                    = polar_decomposition(F).rotation;
        S                    = transpose(R) * F;
      }
    // Of the pair of directions (c, d), c <= d or not.
    const auto pair = [](const unsigned int c, const unsigned int d) {
      return c == d ? c : 6 - c - d;
    };
    std::array<Tensor<1, 3>, 6> derivative;
    for (unsigned int p = 0; p < 6; ++p)
      for (unsigned int a = 0; a < 3; ++a)
        derivative[p][a] = second.value(x, t, 3 * p + a);
    for (unsigned int c = 0; c < 3; ++c)
      {
        Tensor<2, 3> dF;
        for (unsigned int d = 0; d < 3; ++d)
          for (unsigned int a = 0; a < 3; ++a)
            dF[a][d] = derivative[pair(c, d)][a];
        const Tensor<2, 3> dP = is_linear ?
                                  corotational_tangent(material, dF, R) :
                                  stress_derivative(material, R, S, dF);
        for (unsigned int a = 0; a < 3; ++a)
          b[a] -= dP[a][c];
      }
    return b;
  }
} // namespace corotet
