// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/time_integration/central_difference.h>

#include <cmath>

namespace corotet
{
  void
  CentralDifference::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Safety factor",
                      control.safety_factor,
                      "Ratio of the time step to the stable step if 'Time "
                      "step' is 0 [-].",
                      dealii::Patterns::Double(0.01, 1));
    prm.add_parameter(
      "Steps between estimates",
      control.steps_between_estimates,
      "Number of steps from one estimate of the stable step to the next [-]; "
      "the first is made at the start. It takes the largest eigenvalue of M^-1 "
      "K in the state of that moment. Smaller values follow bodies that "
      "quickly become stiffer.",
      dealii::Patterns::Integer(1));
    prm.add_parameter("Refuse unstable steps",
                      control.refuse,
                      "Whether a 'Time step' above the stable step ends the "
                      "run with an error. If not, there is only a warning, and "
                      "the run ends when the motion has grown beyond all "
                      "bounds.");
  }

  StageReport
  CentralDifference::step(SecondOrderSystem &system,
                          const TimeStep    &step,
                          State             &state)
  {
    state.v.add(0.5 * step.dt, state.a);
    state.u.add(step.dt, state.v);
    system.prescribe(state, step.end, 1.);
    return system.solve_acceleration(state, step.end, 0.5 * step.dt);
  }

  StageReport
  CentralDifference::steps(SecondOrderSystem &system,
                           const TimeStep    &first,
                           const unsigned int n,
                           State             &state)
  {
    // Steps that are made together need one more evaluation of the forces.
    if (n > 2)
      {
        state.v.add(-0.5 * first.dt, state.a);
        if (system.step_many(state, first.dt, n))
          return system.solve_acceleration(state,
                                           first.time + n * first.dt,
                                           0.5 * first.dt);
        state.v.add(0.5 * first.dt, state.a);
      }
    return TimeIntegrator::steps(system, first, n, state);
  }

  double
  CentralDifference::stable_step(const double omega, const double alpha_K) const
  {
    // The amplification matrix of the mode has an eigenvalue -1 where (omega
    // dt)^2 + 2 alpha_K omega^2 dt = 4. The root (sqrt(c^2 + 4) - c) / omega is
    // written without its cancellation for large c.
    const double c = alpha_K * omega;
    return 4 / (omega * (std::hypot(c, 2.) + c));
  }
} // namespace corotet
