// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_simulation_modal_h
#define corotet_tests_simulation_modal_h

#include <corotet/simulation/modal_analysis.h>

#include <fmt/format.h>

#include <string>

#include "../body.h"

namespace corotet::tests
{
  /**
   * Parameters of the modes of a box with the material E = 1 Pa, rho = 1
   * kg/m^3.
   */
  inline std::string
  box_body(const std::string &size,
           const std::string &cells,
           const unsigned int degree,
           const double       poissons_ratio,
           const unsigned int n_modes)
  {
    return box_mesh(size, cells) + element_text(degree) +
           material_text(1, poissons_ratio, 1) +
           section("Modes", {{"Number", n_modes}});
  }

  /**
   * A modal analysis that has been computed.
   */
  struct Analysis
  {
    explicit Analysis(const std::string &text)
      : parameters(text)
      , log(MPI_COMM_WORLD, true)
      , analysis(parameters, "", MPI_COMM_WORLD, log)
    {
      analysis.compute();
    }

    const Mode &
    mode(const unsigned int number) const
    {
      return analysis.modes()[number - 1];
    }

    Parameters    parameters;
    Log           log;
    ModalAnalysis analysis;
  };
} // namespace corotet::tests

#endif
