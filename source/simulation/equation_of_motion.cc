// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/ghosted_copy.h>
#include <corotet/base/not_finite.h>
#include <corotet/simulation/equation_of_motion.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace corotet
{
  namespace
  {
    ForceTerms
    make_terms(Body &body, const SimulationParameters &parameters, Log &log)
    {
      // Values that were noted as not finite before do not belong to this
      // equation.
      take_not_finite(body.discretization.communicator());
      ForceTerms terms =
        parameters.forces.make(body.force_context(log, parameters.start_time));
      if (!parameters.time_integrator.selected().is_dynamic())
        terms.leave_out_damping();
      return terms;
    }
  } // namespace

  EquationOfMotion::EquationOfMotion(Body                       &body,
                                     const SimulationParameters &parameters,
                                     WallTimes                  &wall_times,
                                     Log                        &log)
    : body(body)
    , wall_times(wall_times)
    , is_dynamic(parameters.time_integrator.selected().is_dynamic())
    , terms(make_terms(body, parameters, log))
  {
    body.problem.add_to(
      terms, body.discretization, body.reference, body.materials, body.law);
    for (Vector *vector : {&forces.external, &forces.internal, &u})
      body.discretization.initialize_vector(*vector);
    if (is_dynamic)
      for (Vector *vector : {&forces.inertia, &a})
        body.discretization.initialize_vector(*vector);
    if (is_dynamic || terms.depends_on_velocity() || terms.follows_motion() ||
        terms.has_elastic())
      body.discretization.initialize_vector(v);
    if (terms.has_damping() || terms.damping_shares().mass != 0)
      body.discretization.initialize_vector(forces.damping);
    if (terms.has_elastic())
      body.discretization.initialize_vector(forces.elastic);
  }

  void
  EquationOfMotion::set_state(const State &state)
  {
    ScopedTimer timer(wall_times.assembly);
    copy_with_ghosts(u, state.u);
    if (is_dynamic)
      copy_with_ghosts(v, state.v);
    body.elasticity.update_rotations(u);
  }

  EquationOfMotion::Forces &
  EquationOfMotion::evaluate_forces(const State &state,
                                    const double time,
                                    const double load_factor)
  {
    ScopedTimer timer(wall_times.assembly);
    this->time = time;
    copy_with_ghosts(u, state.u);
    if (is_dynamic && terms.depends_on_velocity())
      copy_with_ghosts(v, state.v);
    body.elasticity.update_rotations_and_force(forces.internal, u);

    if (load_factor != known_load_factor ||
        (time != known_time && !terms.is_constant()) || terms.follows_motion())
      {
        // If a term throws, the forces belong to no time.
        known_time = std::numeric_limits<double>::quiet_NaN();
        terms.external_force(forces.external, last_motion(), load_factor);
        known_load_factor = load_factor;
        known_time        = time;
      }

    if (terms.has_elastic())
      terms.elastic_force(forces.elastic, last_motion());

    if (terms.has_damping())
      terms.damping_force(forces.damping, last_motion());
    return forces;
  }

  EquationOfMotion::Forces &
  EquationOfMotion::evaluate(const State &state,
                             const double time,
                             const double load_factor)
  {
    evaluate_forces(state, time, load_factor);
    ScopedTimer timer(wall_times.assembly);
    if (is_dynamic)
      evaluate_inertia(state.a);
    return forces;
  }

  void
  EquationOfMotion::evaluate_inertia(const Vector &acceleration)
  {
    copy_with_ghosts(a, acceleration);
    body.mass.apply(forces.inertia, a);
  }

  void
  EquationOfMotion::residual(Vector &r) const
  {
    r = forces.external;
    r -= forces.internal;
    if (forces.damping.size() > 0)
      r -= forces.damping;
    if (is_dynamic)
      r -= forces.inertia;
    if (terms.has_elastic())
      r -= forces.elastic;
    body.motion.set_zero(r);
  }

  std::string
  EquationOfMotion::why_not_finite() const
  {
    const auto found = take_not_finite(body.discretization.communicator());
    if (found)
      return ": " + found->entry + ": " + found->message;
    const ElasticState state = body.elasticity.state(u);
    if (std::isfinite(state.energy) || body.law->is_linear())
      return "";
    if (state.min_det_F > 0)
      return ": the energy of the deformation is not finite; are steps too "
             "long?";
    return fmt::format(
      ": cells are flat or inside out (smallest det F {:.3g}), "
      "where the material has no stress",
      state.min_det_F);
  }
} // namespace corotet
