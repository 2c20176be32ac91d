// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/p_multigrid_parameters.h>

namespace corotet
{
  void
  PMultigridParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Smoother degree",
                      smoother_degree,
                      "Chebyshev steps before and after the coarser degree "
                      "[-].",
                      dealii::Patterns::Integer(1, 20));
    prm.add_parameter("Smoothing range",
                      smoothing_range,
                      "Largest over smallest eigenvalue that the smoother is "
                      "to damp [-].",
                      dealii::Patterns::Double(1.1, 1e4));
    std::string names = "automatic|direct|aggregation";
    for (const auto &candidate : further)
      names += "|" + candidate.name;
    prm.add_parameter("Coarse solver",
                      coarse_type,
                      "For degree 1: 'direct', a sparse factorisation; "
                      "'aggregation', one cycle of smoothed aggregation; "
                      "'amg', one cycle of Trilinos ML, with the "
                      "parameters of 'Linear solver/amg' (where Trilinos has "
                      "it); "
                      "'automatic', the direct one up to the limit below, then "
                      "aggregation.",
                      dealii::Patterns::Selection(names));
    prm.add_parameter("Vertex rotations",
                      vertex_rotations,
                      "Whether degree 1, as the lowest level, also has the "
                      "rotations of the vertices, with which it bends: thin "
                      "cells need a fraction of the iterations so, and the "
                      "level has twice as many unknowns. 'automatic': on "
                      "bodies of few layers of cells (more than one face of "
                      "the surface for every four cells) more than a tenth of "
                      "whose cells are flat or stretched by more than 4, and "
                      "on other bodies of up to 'Direct limit' unknowns of "
                      "degree 1 whose cells are so by more than 15 in the "
                      "mean. Not with 'Coarse solver = amg', which knows none.",
                      dealii::Patterns::Selection("automatic|true|false"));
    prm.add_parameter("Direct limit",
                      direct_limit,
                      "Unknowns of degree 1 up to which 'automatic' of 'Coarse "
                      "solver' means 'direct' [-]. Bodies of few layers of "
                      "cells with rotations of the vertices may have 8 times "
                      "as many, if factors take no more operations than those "
                      "of a cube of that limit.",
                      dealii::Patterns::Integer(0));
  }
} // namespace corotet
