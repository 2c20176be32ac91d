// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/ghosted_copy.h>
#include <corotet/simulation/structural_system.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  namespace
  {
    std::map<unsigned int, double>
    densities(const std::map<unsigned int, IsotropicMaterial> &materials)
    {
      std::map<unsigned int, double> result;
      for (const auto &[region, material] : materials)
        result[region] = material.density;
      return result;
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
              parameters.material.rotation_placement())
    , loads(discretization,
            reference,
            mass_matrix,
            conditions,
            parameters.loads,
            parameters.material.rotation_placement() != Rotation::none,
            log,
            tables)
    , motion(discretization,
             reference,
             conditions,
             std::max(parameters.time_step,
                      1e-4 * (parameters.end_time - parameters.start_time)))
    , mass_solver(discretization, mass_matrix, motion)
    , damping(parameters.damping.coefficients())
    , wanted_tangent(parameters.newton.tangent == "consistent" ?
                       Tangent::consistent :
                       Tangent::frozen_rotation)
    , tangent(wanted_tangent)
  {
    problem.add_to(loads,
                   discretization.mesh().boundaries(),
                   parameters.material.materials(
                     discretization.mesh().regions()));
    if (!elastic.is_by_cell(tangent))
      parameters.linear_solver.check_fit(
        TangentOperator::is_symmetric(elastic, loads, tangent));
    if (!parameters.damping.frequencies.empty())
      log.line(fmt::format("Damping: alpha_M = {:.6g} 1/s, alpha_K = {:.6g} s",
                           damping.mass,
                           damping.stiffness));
    for (Vector *vector : {&forces.external,
                           &forces.internal,
                           &forces.damping,
                           &forces.inertia,
                           &u_ghosted,
                           &v_ghosted,
                           &a_ghosted,
                           &free_residual,
                           &free_acceleration,
                           &positions})
      discretization.initialize_vector(*vector);

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
  StructuralSystem::apply_stiffness(Vector       &f,
                                    const Vector &v,
                                    const Tangent tangent)
  {
    if (elastic.is_by_cell(tangent))
      elastic.apply_tangent(f, v);
    else
      elastic.apply_linearization(f, v, 1., 0., nullptr, nullptr);
  }

  void
  StructuralSystem::evaluate_forces(const State &state,
                                    const double time,
                                    const double load_factor)
  {
    ScopedTimer timer(wall_times.assembly);
    forces_time = time;
    copy_with_ghosts(u_ghosted, state.u);
    elastic.update_rotations_and_force(forces.internal, u_ghosted);

    if (load_factor != known_load_factor ||
        (time != known_time && !loads.is_constant()) ||
        loads.has_follower_pressure())
      {
        loads.force(forces.external, time, u_ghosted);
        forces.external *= load_factor;
        known_load_factor = load_factor;
        known_time        = time;
      }

    // Without damping it is zero for good.
    if (!has_damping())
      return;
    copy_with_ghosts(v_ghosted, state.v);
    if (damping.stiffness > 0)
      {
        // C turns with the rotations that the material has.
        if (!elastic.is_by_cell(Tangent::frozen_rotation))
          elastic.linearize(u_ghosted, Tangent::frozen_rotation);
        apply_stiffness(forces.damping, v_ghosted, Tangent::frozen_rotation);
        forces.damping *= damping.stiffness;
      }
    else
      forces.damping = 0;
    if (damping.mass > 0)
      {
        mass_matrix.apply(forces.inertia, v_ghosted);
        forces.damping.add(damping.mass, forces.inertia);
      }
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

  void
  StructuralSystem::make_operators()
  {
    ScopedTimer timer(wall_times.assembly);
    effective_operator = std::make_unique<EffectiveOperator>(
      discretization, elastic, mass_matrix, motion.is_prescribed());
    if (!elastic.is_by_cell(wanted_tangent))
      tangent_operator =
        std::make_unique<TangentOperator>(*effective_operator, elastic, loads);
  }

  StageReport
  StructuralSystem::solve_stage(State &state, const Stage &stage)
  {
    if (!effective_operator)
      make_operators();
    this->stage          = stage;
    stage_state          = &state;
    const bool   statics = stage.acceleration_factor == 0;
    NewtonReport report;
    try
      {
        parameters.newton.solve(*this, state.u, report);
      }
    catch (const ComputationError &)
      {
        log.line(fmt::format("t = {:.6g}: {}", stage.time, report.text()));
        throw;
      }
    if (parameters.newton.linearly_implicit)
      // Newton's method ends before it looks at the forces again.
      evaluate(state, stage.time, stage.load_factor);
    if (statics || parameters.newton.always_log || report.line_searches > 0)
      log.line(fmt::format("t = {:.6g}: {}", stage.time, report.text()));
    return {report.iterations,
            report.linear_iterations,
            report.observed_order()};
  }

  NewtonProblem::Norm
  StructuralSystem::residual(Vector &r)
  {
    evaluate(*stage_state, stage.time, stage.load_factor);
    r = forces.external;
    r -= forces.internal;
    r -= forces.damping;
    r -= forces.inertia;
    motion.set_zero(r);
    return {norm(r),
            std::max({norm(forces.external),
                      norm(forces.internal),
                      norm(forces.damping),
                      norm(forces.inertia)}),
            elastic.round_off()};
  }

  unsigned int
  StructuralSystem::solve_linearized(Vector &dx, const Vector &r)
  {
    const double c_K = 1 + stage.velocity_factor * damping.stiffness;
    const double c_M =
      stage.acceleration_factor + stage.velocity_factor * damping.mass;
    if (elastic.rotation_placement() != Rotation::none || c_K != operator_c_K ||
        c_M != operator_c_M)
      {
        ScopedTimer timer(wall_times.assembly);
        effective_operator->update(c_K, c_M);
        operator_c_K = c_K;
        operator_c_M = c_M;
      }
    const TangentOperator *J = nullptr;
    if (!elastic.is_by_cell(tangent))
      {
        ScopedTimer timer(wall_times.assembly);
        clamped_cells = std::max(clamped_cells,
                                 tangent_operator->update(u_ghosted,
                                                          tangent,
                                                          stage.time,
                                                          stage.load_factor));
        J             = tangent_operator.get();
      }
    ScopedTimer timer(wall_times.solve);
    positions.copy_locally_owned_data_from(discretization.node_positions());
    positions += stage_state->u;
    try
      {
        const unsigned int n_iterations = parameters.linear_solver.solve(
          *effective_operator, dx, r, positions, J);
        advise_direct_solver(n_iterations);
        return n_iterations;
      }
    catch (const ComputationError &)
      {
        advise_direct_solver(std::numeric_limits<unsigned int>::max());
        throw;
      }
  }

  void
  StructuralSystem::advise_direct_solver(const unsigned int n_iterations)
  {
    // Measured on plates of one layer of cells (doc/algorithms.md): up to this
    // size a factorisation takes as long as this many iterations, or less.
    constexpr unsigned int small      = 50000;
    constexpr unsigned int worthwhile = 1000;
    const auto             n_unknowns = 3 * discretization.n_global_nodes();
    if (n_iterations <= 100 || slow_iterations > worthwhile ||
        n_unknowns > small || parameters.linear_solver.type() != "p-multigrid")
      return;
    slow_iterations += std::min(n_iterations, worthwhile + 1);
    if (slow_iterations > worthwhile)
      log.line(fmt::format("p-multigrid converges slowly on this body, as on "
                           "thin ones: with {} unknowns, 'Linear solver/Type = "
                           "direct' may be faster",
                           n_unknowns));
  }

  NewtonProblem::Norm
  StructuralSystem::add(const double factor, const Vector &dx)
  {
    stage_state->u.add(factor, dx);
    stage_state->v.add(factor * stage.velocity_factor, dx);
    stage_state->a.add(factor * stage.acceleration_factor, dx);
    return {std::abs(factor) * norm(dx), norm(stage_state->u)};
  }

  void
  StructuralSystem::keep()
  {
    kept = *stage_state;
  }

  void
  StructuralSystem::restore()
  {
    *stage_state = kept;
  }

  bool
  StructuralSystem::has_energy() const
  {
    // Damping by a stiffness that turns with the body is not a gradient.
    return elastic.is_symmetric(Tangent::consistent) &&
           !loads.has_follower_pressure() &&
           (damping.stiffness == 0 ||
            elastic.rotation_placement() == Rotation::none);
  }

  bool
  StructuralSystem::use_definite_tangent(const bool use)
  {
    tangent = use ? Tangent::frozen_rotation : wanted_tangent;
    return wanted_tangent != Tangent::frozen_rotation &&
           elastic.rotation_placement() != Rotation::none;
  }
} // namespace corotet
