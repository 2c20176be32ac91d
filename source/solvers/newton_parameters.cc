// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/newton.h>

namespace corotet
{
  void
  NewtonParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    add_enumeration(prm,
                    "Tangent",
                    tangent,
                    tangents,
                    "Derivative of the internal forces that Newton's method "
                    "takes: 'consistent' is exact and converges quadratically; "
                    "'frozen rotation' leaves out the derivative of the "
                    "rotations (for 'Saint Venant-Kirchhoff' and 'neo-Hookean' "
                    "it is the stiffness of linear elasticity, rotated with "
                    "each cell), is never indefinite and converges linearly, "
                    "if at all. Where the exact one leads nowhere, the program "
                    "takes the other by itself.");
    prm.add_parameter("Residual tolerance",
                      residual_tolerance,
                      "Largest residual at which Newton's method has "
                      "converged, relative to the largest of the internal, "
                      "external, inertia and damping forces [-]. 'Increment "
                      "tolerance' must be met, too.",
                      dealii::Patterns::Double(1e-15, 0.1));
    prm.add_parameter("Increment tolerance",
                      increment_tolerance,
                      "Largest estimated error of the displacement at which "
                      "Newton's method has converged, relative to the "
                      "displacement [-]. Linear problems need 'Residual "
                      "tolerance' only.",
                      dealii::Patterns::Double(1e-15, 0.1));
    prm.add_parameter("Maximum iterations",
                      max_iterations,
                      "Largest number of Newton iterations in a step [-]. A "
                      "step that needs more has failed, see 'Time "
                      "integration/Maximum halvings'.",
                      dealii::Patterns::Integer(1));
    prm.add_parameter("Linearly implicit",
                      linearly_implicit,
                      "Whether each time step makes a single Newton iteration: "
                      "steps have a fixed price and cannot fail to converge, "
                      "and their error shrinks with the time step. With the "
                      "tangent 'frozen rotation' this brings back bodies whose "
                      "cells are collapsed or inside out, where rotations "
                      "jump. For dynamics only.");
    prm.add_parameter("Log every solve",
                      always_log,
                      "Whether the log shows the convergence history of every "
                      "solve. If not, it shows those of load steps and those "
                      "that needed a line search or failed.");
  }
} // namespace corotet
