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
                    "Derivative of the corotational forces: 'consistent' is "
                    "exact and converges quadratically; 'frozen rotation' "
                    "leaves out that of the rotations, is always positive "
                    "and converges linearly, if at all.");
    prm.add_parameter("Residual tolerance",
                      residual_tolerance,
                      "Residual at which iterations stop, relative to the "
                      "largest of the internal, external, inertia and damping "
                      "forces [-].",
                      dealii::Patterns::Double(1e-15, 0.1));
    prm.add_parameter("Increment tolerance",
                      increment_tolerance,
                      "Estimated error of the displacement at which iterations "
                      "stop, relative to the displacement [-].",
                      dealii::Patterns::Double(1e-15, 0.1));
    prm.add_parameter("Maximum iterations",
                      max_iterations,
                      "A step that needs more has failed [-].",
                      dealii::Patterns::Integer(1));
    prm.add_parameter("Linearly implicit",
                      linearly_implicit,
                      "Whether one iteration is all: steps of a fixed price "
                      "that cannot fail, with an error that shrinks with the "
                      "time step; as interactive codes do. With the tangent "
                      "'frozen rotation' it brings back bodies whose cells are "
                      "collapsed or inside out, where rotations jump. For "
                      "dynamics only.");
    prm.add_parameter("Log every solve",
                      always_log,
                      "Whether the log shows the convergence history of every "
                      "solve. If not, it shows those of load steps and those "
                      "that needed a line search or failed.");
  }
} // namespace corotet
