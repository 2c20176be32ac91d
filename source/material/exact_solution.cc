// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/differentiation.h>
#include <corotet/base/text.h>
#include <corotet/material/exact_solution.h>

#include <cmath>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    const std::string entry = "Exact solution/Displacement";
  } // namespace

  void
  ExactSolutionParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Displacement",
                      displacement,
                      "Exact displacement of the body, if it is known [m]: 'x; "
                      "y; z', expressions in x, y, z, t that can be "
                      "differentiated; then summary.json has the errors at the "
                      "end of the run. Empty: not known.");
    prm.add_parameter("Manufacture",
                      manufacture,
                      "Whether body force, tractions, prescribed displacements "
                      "and the initial state are derived from the exact "
                      "displacement, so that it is the solution. If not, the "
                      "loads, supports and initial state of this file are "
                      "used.");
    prm.add_parameter("Displacement boundary",
                      displacement_boundary,
                      "Boundaries where the exact displacement is prescribed "
                      "if 'Manufacture' is true: 'name, name', 'all' or "
                      "'none'. The others get the tractions of the exact "
                      "solution, as do faces without a name ('all' are those "
                      "that have names).");
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
                        const MaterialLaw       &law,
                        const Point<3>          &x,
                        const double             t) const
  {
    return law.stress(material, gradient(x, t));
  }

  Tensor<1, 3>
  ExactSolution::body_force(const IsotropicMaterial &material,
                            const MaterialLaw       &law,
                            const bool               with_inertia,
                            const Point<3>          &x,
                            const double             t) const
  {
    Tensor<1, 3> b;
    if (with_inertia)
      b = material.density * acceleration.vector_value(x, t);

    const Tensor<2, 3> H = gradient(x, t);
    // The index of the pair of directions (c, d), which may be in any order.
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
        const Tensor<2, 3> dP = law.stress_derivative(material, H, dF);
        for (unsigned int a = 0; a < 3; ++a)
          b[a] -= dP[a][c];
      }
    return b;
  }
} // namespace corotet
