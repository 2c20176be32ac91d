// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/expression.h>
#include <corotet/base/not_finite.h>
#include <corotet/simulation/structural_system.h>

namespace corotet
{
  StructuralSystem::StructuralSystem(Body                       &body,
                                     const SimulationParameters &parameters,
                                     WallTimes                  &wall_times,
                                     Log                        &log)
    : parameters(parameters)
    , equation_of_motion(body, parameters, wall_times, log)
    , implicit(equation_of_motion,
               parameters.newton,
               parameters.linear_solver,
               log)
    , accelerations(equation_of_motion)
  {}

  void
  StructuralSystem::initialize(State &state) const
  {
    const Body &body       = equation_of_motion.body;
    const bool  is_dynamic = equation_of_motion.is_dynamic;
    body.discretization.initialize_vector(state.u);
    if (is_dynamic)
      for (Vector *vector : {&state.v, &state.a})
        body.discretization.initialize_vector(*vector);
    // The expressions of the parameters, or those made from the exact solution.
    const auto expression = [&](const std::string &name,
                                const std::string &text,
                                const std::string &given) {
      return Expression(text,
                        3,
                        text == given ? "Initial conditions/" + name :
                                        "Exact solution/Displacement",
                        body.tables);
    };
    const Expression u0           = expression("Displacement",
                                     body.problem.initial_displacement(),
                                     parameters.initial_displacement);
    const Expression v0           = expression("Velocity",
                                     body.problem.initial_velocity(),
                                     parameters.initial_velocity);
    const auto       check_finite = [&] {
      if (const auto found =
            take_not_finite(body.discretization.communicator()))
        throw InputError(found->entry, found->message);
    };
    // Values of constant loads have been computed by now and are checked first.
    check_finite();
    const auto fill = [&](Vector &vector, const Expression &value) {
      if (value.is_zero())
        return;
      for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
        {
          const auto x =
            value.vector_value(body.discretization.node_position(n),
                               parameters.start_time);
          for (unsigned int a = 0; a < 3; ++a)
            vector.local_element(3 * n + a) = x[a];
        }
    };
    fill(state.u, u0);
    if (is_dynamic)
      fill(state.v, v0);
    check_finite();
  }

  void
  StructuralSystem::prescribe(State       &state,
                              const double time,
                              const double load_factor)
  {
    equation_of_motion.body.motion.apply(
      time, load_factor, state.u, state.v, state.a);
  }

  StageReport
  StructuralSystem::move_supports(State       &state,
                                  const double time,
                                  const double load_factor)
  {
    return implicit.move_supports(state, time, load_factor);
  }

  StageReport
  StructuralSystem::solve_stage(State &state, const Stage &stage)
  {
    return implicit.solve_stage(state, stage);
  }

  StageReport
  StructuralSystem::solve_acceleration(State       &state,
                                       const double time,
                                       const double velocity_factor)
  {
    return accelerations.solve_acceleration(state, time, velocity_factor);
  }

  StageReport
  StructuralSystem::solve_mean_acceleration(State       &state,
                                            const double time,
                                            const double dt)
  {
    StageReport total;
    State       moved = state;
    moved.a           = 0;
    for (unsigned int i = 0; i < 2; ++i)
      {
        moved.u = state.u;
        moved.v = state.v;
        prescribe(moved, time, 1.);
        const StageReport report =
          solve_stage(moved, {time, 2 / dt, 2 / (dt * dt)});
        total.newton_iterations += report.newton_iterations;
        total.linear_iterations += report.linear_iterations;
      }
    state.a = moved.a;
    return total;
  }

  bool
  StructuralSystem::step_many(State             &state,
                              const double       dt,
                              const unsigned int n)
  {
    return accelerations.step_many(state, dt, n);
  }
} // namespace corotet
