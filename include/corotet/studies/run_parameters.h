// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_run_parameters_h
#define corotet_studies_run_parameters_h

#include <corotet/output/checkpoints.h>
#include <corotet/output/output_parameters.h>
#include <corotet/simulation/simulation_parameters.h>
#include <corotet/studies/study_parameters.h>
#include <corotet/studies/verification.h>

namespace corotet
{
  /**
   * All parameters that a parameter file may have. Must not be moved after
   * declare_parameters().
   */
  struct RunParameters
  {
    void
    declare_parameters(dealii::ParameterHandler &prm)
    {
      simulation.declare_parameters(prm);
      prm.enter_subsection("Convergence study");
      study.declare_parameters(prm);
      prm.leave_subsection();
      prm.enter_subsection("Output");
      output.declare_parameters(prm);
      prm.leave_subsection();
      prm.enter_subsection("Checkpoint");
      checkpoint.declare_parameters(prm);
      prm.leave_subsection();
      prm.enter_subsection("Verification");
      verification.declare_parameters(prm);
      prm.leave_subsection();
    }

    SimulationParameters simulation;
    StudyParameters      study;
    OutputParameters     output;
    CheckpointParameters checkpoint;
    Verification         verification;
  };
} // namespace corotet

#endif
