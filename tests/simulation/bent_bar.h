// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_simulation_bent_bar_h
#define corotet_tests_simulation_bent_bar_h

#include <string>

#include "../parameter_text.h"

namespace corotet::tests
{
  /// A bar of 1 x 0.1 x 0.1, clamped at one end, that is bent far by a traction
  /// in direction z at the other. With a low limit of iterations large steps
  /// fail and are made in parts.
  inline std::string
  bent_bar(const std::string &integration,
           const unsigned int max_iterations,
           const std::string &traction,
           const double       tolerance,
           const std::string &solver = "direct")
  {
    return box_mesh("1, 0.1, 0.1", "5, 1, 1") + element_text(2) +
           rotation_at("quadrature points") + material_text(1e6) +
           fixed("x-min") + tractions("x-max: 0; 0; " + traction) +
           section("Newton",
                   {{"Tangent", "consistent"},
                    {"Maximum iterations", max_iterations}}) +
           newton_tolerances(tolerance) + linear_solver(solver, 1e-10) +
           integration;
  }
} // namespace corotet::tests

#endif
