// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// What ImplicitSolver keeps in checkpoints.

#include <corotet/simulation/implicit_solver.h>

#include <algorithm>
#include <vector>

namespace corotet
{
  void
  ImplicitSolver::transfer(Archive &archive)
  {
    archive.transfer("solved_scale", solved_scale);
    archive.transfer("slow_iterations", slow_iterations);
    archive.transfer("hides_parts", hides_parts);
    std::vector<int> shown(shown_round_off.size());
    std::transform(shown_round_off.begin(),
                   shown_round_off.end(),
                   shown.begin(),
                   [](const auto kind) { return static_cast<int>(kind); });
    archive.transfer("shown_round_off", shown);
    shown_round_off.clear();
    for (const int kind : shown)
      shown_round_off.insert(static_cast<NewtonReport::RoundOff>(kind));

    archive.within("newton", [&] { newton.transfer(archive); });
    archive.within("linear_solver", [&] { linear_solver.transfer(archive); });
    if (!linear_solver.is_preconditioner_built())
      return;
    archive.within("preconditioner", [&] {
      archive.transfer("time", built_stage.time);
      archive.transfer("velocity_factor", built_stage.velocity_factor);
      archive.transfer("acceleration_factor", built_stage.acceleration_factor);
      archive.transfer("load_factor", built_stage.load_factor);
      archive.transfer("displacement", built_displacement);
      if (equation.terms.has_friction())
        archive.transfer("velocity", built_velocity);
      archive.transfer("with_tangent", built_with_tangent);
      int kind = static_cast<int>(built_tangent);
      archive.transfer("tangent", kind);
      built_tangent = static_cast<Tangent>(kind);
    });
    if (archive.is_reading())
      restore_preconditioner();
  }

  void
  ImplicitSolver::restore_preconditioner()
  {
    if (!effective_operator)
      make_operators();
    // The run may go on with another tangent, for which no operator is needed.
    built_with_tangent = built_with_tangent && tangent_operator != nullptr;
    State state;
    for (Vector *vector : {&state.u, &state.v})
      body.discretization.initialize_vector(*vector);
    // The displacement is empty where it does not matter.
    if (built_displacement.size() > 0)
      state.u = built_displacement;
    if (built_velocity.size() > 0)
      state.v = built_velocity;
    equation.set_state(state);
    stage = built_stage;
    update_effective_operator();
    state.u.update_ghost_values();
    if (built_with_tangent)
      tangent_operator->update_elasticity(state.u, built_tangent);
    linear_solver.build_again(*effective_operator,
                              built_with_tangent ? tangent_operator.get() :
                                                   nullptr,
                              state.u);
  }
} // namespace corotet
