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
                      "Number of steps of the Chebyshev smoother on each "
                      "degree, before and after the correction from the degree "
                      "below [-].",
                      dealii::Patterns::Integer(1, 20));
    prm.add_parameter("Smoothing range",
                      smoothing_range,
                      "Ratio of the largest to the smallest eigenvalue that "
                      "the smoother damps [-].",
                      dealii::Patterns::Double(1.1, 1e4));
    std::string names = "automatic|direct|aggregation";
    for (const auto &candidate : further)
      names += "|" + candidate.name;
    prm.add_parameter("Coarse solver",
                      coarse_type,
                      "Solver of degree 1, the lowest level: 'direct', a "
                      "sparse factorisation; 'aggregation', one cycle of "
                      "smoothed aggregation; 'amg', one cycle of Trilinos ML, "
                      "with the parameters of 'Linear solver/amg' (where "
                      "Trilinos has it); 'automatic', 'direct' up to 'Direct "
                      "limit' unknowns, 'aggregation' beyond.",
                      dealii::Patterns::Selection(names));
    prm.add_parameter("Vertex rotations",
                      vertex_rotations,
                      "Whether degree 1, the lowest level of elements of "
                      "degree 2 and 3, also has the rotations of the vertices "
                      "as unknowns, so that it can bend: thin cells then need "
                      "a fraction of the iterations, but the level has twice "
                      "as many unknowns. 'automatic': yes, if more than a "
                      "tenth of the cells are flat or stretched by a factor "
                      "above 4, on bodies of few layers of cells (more than "
                      "one face of the surface for every four cells), and on "
                      "other bodies of up to 'Direct limit' unknowns of degree "
                      "1 if the mean factor of their cells is above 15. No "
                      "effect with 'Coarse solver = amg', which has none.",
                      dealii::Patterns::Selection("automatic|true|false"));
    prm.add_parameter("Direct limit",
                      direct_limit,
                      "Number of unknowns of degree 1 up to which 'Coarse "
                      "solver = automatic' takes 'direct' [-]. Bodies of few "
                      "layers of cells with rotations of the vertices may have "
                      "up to 8 times as many, if their factorisation takes no "
                      "more operations than that of a cube with this number.",
                      dealii::Patterns::Integer(0));
  }
} // namespace corotet
