// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_p_multigrid_parameters_h
#define corotet_solvers_p_multigrid_parameters_h

#include <corotet/solvers/coarse_solver.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace corotet
{
  /**
   * The parameters of PMultigrid, which may be shared with other
   * preconditioners.
   */
  struct PMultigridParameters
  {
    /// @p further are solvers of degree 1 beside the own ones; their parameters
    /// are declared elsewhere.
    explicit PMultigridParameters(const CoarseSolvers &further = {})
      : further(further)
    {}

    void
    declare_parameters(dealii::ParameterHandler &prm);

    CoarseSolvers further;
    unsigned int  smoother_degree  = 4;
    double        smoothing_range  = 20;
    std::string   coarse_type      = "automatic";
    std::string   vertex_rotations = "automatic";
    unsigned int  direct_limit     = 15000;
  };
} // namespace corotet

#endif
