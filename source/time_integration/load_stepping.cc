// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/load_stepping.h>

namespace corotet
{
  void
  LoadStepping::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Load steps",
                      load_steps,
                      "Number of equal load steps from the start time to the "
                      "end time [-]; 'Time step' is not used. A step that "
                      "fails is made in halves.",
                      dealii::Patterns::Integer(1));
    prm.add_parameter("Proportional loading",
                      proportional,
                      "Whether all loads and prescribed displacements are also "
                      "multiplied by a load factor, which grows evenly from 0 "
                      "at the start to 1 at the end. If not, only their "
                      "dependence on t changes them.");
  }

  StageReport
  LoadStepping::step(SecondOrderSystem &system,
                     const TimeStep    &step,
                     State             &state)
  {
    const double time          = step.end;
    const double factor        = load_factor(step.done);
    state.v                    = 0;
    state.a                    = 0;
    const StageReport supports = system.move_supports(state, time, factor);
    StageReport report = system.solve_stage(state, {time, 0., 0., factor});
    report.newton_iterations += supports.newton_iterations;
    report.linear_iterations += supports.linear_iterations;
    return report;
  }
} // namespace corotet
