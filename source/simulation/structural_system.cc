// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/ghosted_copy.h>
#include <corotet/simulation/structural_system.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  namespace
  {
    // The time step; if the run chooses it, the time that a wave takes through
    // the smallest cell. Zero in statics.
    double
    time_scale(const SimulationParameters &parameters,
               const Discretization       &discretization)
    {
      if (!parameters.time_integrator.selected().is_dynamic())
        return 0;
      if (parameters.time_step > 0)
        return parameters.time_step;
      const auto materials =
        parameters.material.materials(discretization.mesh().regions());
      double shortest = std::numeric_limits<double>::max();
      for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
        {
          const auto              &geometry = discretization.geometry(c);
          const IsotropicMaterial &material = materials.at(geometry.region);
          const double             speed =
            std::sqrt((material.lambda + 2 * material.mu) / material.density);
          shortest = std::min(shortest, std::cbrt(6 * geometry.volume) / speed);
        }
      return dealii::Utilities::MPI::min(shortest,
                                         discretization.communicator());
    }
  } // namespace

  StructuralSystem::StructuralSystem(const Discretization &discretization,
                                     SimulationParameters &parameters,
                                     const TableFunctions &tables,
                                     WallTimes            &wall_times,
                                     Log                  &log)
    : discretization(discretization)
    , parameters(parameters)
    , tables(tables)
    , wall_times(wall_times)
    , log(log)
    , reference(discretization.element())
    , problem(parameters)
    , conditions(problem.boundary_conditions(
                   discretization.mesh().boundaries()),
                 discretization.mesh().boundaries(),
                 tables)
    , mass_matrix(discretization,
                  reference,
                  densities(parameters.material.materials(
                    discretization.mesh().regions())),
                  mass_type(parameters.mass_type))
    , elastic(discretization,
              reference,
              parameters.material.materials(discretization.mesh().regions()),
              parameters.material.law())
    , terms(parameters.forces.make({discretization,
                                    reference,
                                    mass_matrix,
                                    elastic,
                                    conditions,
                                    tables,
                                    log,
                                    parameters.start_time}))
    , motion(discretization,
             reference,
             conditions,
             time_scale(parameters, discretization))
    , mass_solver(discretization, mass_matrix, motion)
    , wanted_tangent(parameters.newton.tangent == "consistent" ?
                       Tangent::consistent :
                       Tangent::frozen_rotation)
    , tangent(wanted_tangent)
  {
    problem.add_to(terms,
                   discretization,
                   reference,
                   parameters.material.materials(
                     discretization.mesh().regions()));
    if (TangentOperator::is_needed(elastic, terms, tangent))
      parameters.linear_solver.check_fit(
        TangentOperator::is_symmetric(elastic, terms, tangent));
    for (Vector *vector : {&forces.external,
                           &forces.internal,
                           &forces.damping,
                           &forces.inertia,
                           &u_ghosted,
                           &v_ghosted,
                           &a_ghosted,
                           &positions})
      discretization.initialize_vector(*vector);
    if (terms.has_elastic())
      discretization.initialize_vector(forces.elastic);
    if (terms.has_surface_matrix())
      surface = std::make_unique<SurfaceMatrix>(discretization, reference);

    // Three unknowns of each node have its mass.
    mass_diagonal_sum =
      mass_matrix.diagonal().mean_value() * mass_matrix.diagonal().size() / 3;
  }

  StructuralSystem::~StructuralSystem()
  {
    // The parameters' solver may live longer than the matrix that it knows.
    parameters.linear_solver.clear();
  }

  void
  StructuralSystem::initialize(State &state) const
  {
    for (Vector *vector : {&state.u, &state.v, &state.a})
      discretization.initialize_vector(*vector);
    const Expression u0(problem.initial_displacement(),
                        3,
                        "Initial conditions/Displacement",
                        tables);
    const Expression v0(problem.initial_velocity(),
                        3,
                        "Initial conditions/Velocity",
                        tables);
    for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
      {
        const dealii::Point<3> x = discretization.node_position(n);
        const auto             u = u0.vector_value(x, parameters.start_time);
        const auto             v = v0.vector_value(x, parameters.start_time);
        for (unsigned int a = 0; a < 3; ++a)
          {
            state.u.local_element(3 * n + a) = u[a];
            state.v.local_element(3 * n + a) = v[a];
          }
      }
  }

  void
  StructuralSystem::prescribe(State       &state,
                              const double time,
                              const double load_factor)
  {
    motion.apply(time, load_factor, state.u, state.v, state.a);
  }

  void
  StructuralSystem::set_state(const State &state)
  {
    ScopedTimer timer(wall_times.assembly);
    copy_with_ghosts(u_ghosted, state.u);
    copy_with_ghosts(v_ghosted, state.v);
    elastic.update_rotations(u_ghosted);
  }

  void
  StructuralSystem::evaluate_forces(const State &state,
                                    const double time,
                                    const double load_factor)
  {
    ScopedTimer timer(wall_times.assembly);
    forces_time = time;
    copy_with_ghosts(u_ghosted, state.u);
    if (terms.depends_on_velocity())
      copy_with_ghosts(v_ghosted, state.v);
    elastic.update_rotations_and_force(forces.internal, u_ghosted);

    if (load_factor != known_load_factor ||
        (time != known_time && !terms.is_constant()) || terms.follows_motion())
      {
        terms.external_force(forces.external, last_motion(), load_factor);
        known_load_factor = load_factor;
        known_time        = time;
      }

    if (terms.has_elastic())
      terms.elastic_force(forces.elastic, last_motion());

    // Without damping it is zero for good.
    if (terms.has_damping())
      terms.damping_force(forces.damping, last_motion());
  }

  const StructuralSystem::Forces &
  StructuralSystem::evaluate(const State &state,
                             const double time,
                             const double load_factor)
  {
    evaluate_forces(state, time, load_factor);
    ScopedTimer timer(wall_times.assembly);
    copy_with_ghosts(a_ghosted, state.a);
    mass_matrix.apply(forces.inertia, a_ghosted);
    return forces;
  }

  std::string
  StructuralSystem::why_not_finite() const
  {
    const ElasticState state = elastic.state(u_ghosted);
    if (std::isfinite(state.energy))
      return "";
    return fmt::format(
      ": cells are flat or inside out (smallest det F {:.3g}), "
      "where the material has no stress",
      state.min_det_F);
  }

  void
  StructuralSystem::make_operators()
  {
    ScopedTimer timer(wall_times.assembly);
    effective_operator =
      std::make_unique<EffectiveOperator>(discretization,
                                          elastic,
                                          mass_matrix,
                                          motion.is_prescribed(),
                                          surface.get());
    if (TangentOperator::is_needed(elastic, terms, wanted_tangent))
      tangent_operator =
        std::make_unique<TangentOperator>(*effective_operator, elastic, terms);
  }

  StageReport
  StructuralSystem::solve_stage(State &state, const Stage &stage)
  {
    if (!effective_operator)
      make_operators();
    this->stage        = stage;
    stage_state        = &state;
    const bool statics = stage.acceleration_factor == 0;
    // Where forces vanish, those that there were before are what counts.
    stage_scale = solved_scale;
    NewtonReport report;
    try
      {
        parameters.newton.solve(*this, state.u, report);
      }
    catch (const ComputationError &)
      {
        log.line(fmt::format("t = {:.6g}: {}", stage.time, report.text()));
        if (report.iterations == 0 && !std::isfinite(norm(forces.internal)))
          throw ComputationError(
            "the forces are not finite where Newton's method starts" +
            why_not_finite());
        throw;
      }
    solved_scale = force_scale;
    if (parameters.newton.linearly_implicit)
      // Newton's method ends before it looks at the forces again.
      evaluate(state, stage.time, stage.load_factor);
    if (statics || parameters.newton.always_log || report.line_searches > 0)
      log.line(fmt::format("t = {:.6g}: {}", stage.time, report.text()));
    report_round_off(report);
    return {report.iterations,
            report.linear_iterations,
            report.observed_order()};
  }
} // namespace corotet
