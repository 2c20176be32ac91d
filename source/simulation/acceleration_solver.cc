// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/ghosted_copy.h>
#include <corotet/discretization/values_by_place.h>
#include <corotet/simulation/acceleration_solver.h>
#include <corotet/solvers/largest_eigenvalue.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  AccelerationSolver::AccelerationSolver(EquationOfMotion &equation)
    : equation(equation)
    , body(equation.body)
  {}

  const MassSolver &
  AccelerationSolver::mass_solver()
  {
    if (!the_mass_solver)
      the_mass_solver = std::make_unique<const MassSolver>(body.discretization,
                                                           body.mass,
                                                           body.motion);
    return *the_mass_solver;
  }

  void
  AccelerationSolver::release()
  {
    the_mass_solver.reset();
    damping_operator.reset();
    damping_factor = std::numeric_limits<double>::quiet_NaN();
    surface.reset();
    for (Vector *vector : {&residual, &acceleration, &ghosted})
      Vector().swap(*vector);
  }

  EquationOfMotion::Forces &
  AccelerationSolver::solve_lumped(State       &state,
                                   const double time,
                                   const double velocity_factor,
                                   const double c)
  {
    EquationOfMotion::Forces &forces =
      equation.evaluate_forces(state, time, 1.);
    ScopedTimer          timer(equation.wall_times.solve);
    const unsigned char *is_prescribed = body.motion.is_prescribed().data();
    const double        *m             = body.mass.diagonal().begin();
    const double        *external      = forces.external.begin();
    const double        *internal      = forces.internal.begin();
    const double        *elastic =
      equation.terms.has_elastic() ? forces.elastic.begin() : nullptr;
    double *damping =
      forces.damping.size() > 0 ? forces.damping.begin() : nullptr;
    double            *inertia = forces.inertia.begin();
    double            *a       = state.a.begin();
    double            *v       = state.v.begin();
    const unsigned int n       = state.a.locally_owned_size();
    for (unsigned int i = 0; i < n; ++i)
      if (is_prescribed[i])
        {
          inertia[i] = m[i] * a[i];
          if (damping != nullptr)
            damping[i] += c * inertia[i];
        }
      else
        {
          const double e = elastic != nullptr ? elastic[i] : 0.;
          const double d = damping != nullptr ? damping[i] : 0.;
          inertia[i]     = (external[i] - internal[i] - d - e) / (1 + c);
          a[i]           = inertia[i] / m[i];
          v[i] += velocity_factor * a[i];
          if (damping != nullptr)
            damping[i] += c * inertia[i];
        }
    return forces;
  }

  unsigned int
  AccelerationSolver::solve_lumped_with_surface_damping(
    State       &state,
    const double time,
    const double velocity_factor,
    const double c)
  {
    EquationOfMotion::Forces &forces =
      solve_lumped(state, time, velocity_factor, c);
    ScopedTimer                    timer(equation.wall_times.solve);
    const SurfaceOperator<double> &C = surface_damping(time, velocity_factor);
    const auto                     for_each_entry = [&](const auto &function) {
      for (const unsigned int node : C.owned_nodes())
        for (unsigned int i = 3 * node; i < 3 * node + 3; ++i)
          function(i, body.motion.is_prescribed()[i] != 0);
    };
    // Where C does not act, the accelerations are right.
    for_each_entry([&](const unsigned int i, const bool is_prescribed) {
      residual.local_element(i) = 0;
      ghosted.local_element(i)  = is_prescribed ? state.a.local_element(i) : 0.;
    });
    ghosted.update_ghost_values();
    C.add(residual, ghosted, -1.);
    for_each_entry([&](const unsigned int i, const bool is_prescribed) {
      residual.local_element(i) =
        is_prescribed ?
          0. :
          residual.local_element(i) + (1 + c) * forces.inertia.local_element(i);
    });
    const unsigned int n_iterations =
      mass_solver().solve(acceleration, residual, 1 + c, C);

    const Vector &m = body.mass.diagonal();
    for_each_entry([&](const unsigned int i, const bool is_prescribed) {
      double &a = state.a.local_element(i);
      if (!is_prescribed)
        {
          const double change = acceleration.local_element(i) - a;
          a += change;
          state.v.local_element(i) += velocity_factor * change;
          forces.inertia.local_element(i) += m.local_element(i) * change;
          forces.damping.local_element(i) += c * m.local_element(i) * change;
        }
      ghosted.local_element(i) = a;
    });
    ghosted.update_ghost_values();
    C.add(forces.damping, ghosted);
    return n_iterations;
  }

  StageReport
  AccelerationSolver::solve_acceleration(State       &state,
                                         const double time,
                                         const double velocity_factor)
  {
    if (velocity_factor == 0 || !equation.terms.depends_on_velocity())
      return solve(state, time, velocity_factor);
    // Forces need the velocities of one moment at all unknowns: prescribed ones
    // come with the next velocity, free ones with that before it.
    add_to_supports(state.v, -velocity_factor, state.a);
    const StageReport report = solve(state, time, velocity_factor);
    add_to_supports(state.v, velocity_factor, state.a);
    return report;
  }

  void
  AccelerationSolver::add_to_supports(Vector       &v,
                                      const double  factor,
                                      const Vector &a) const
  {
    const std::vector<unsigned char> &is_prescribed =
      body.motion.is_prescribed();
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      if (is_prescribed[i] != 0)
        v.local_element(i) += factor * a.local_element(i);
  }

  StageReport
  AccelerationSolver::solve(State       &state,
                            const double time,
                            const double velocity_factor)
  {
    // Damping by mass and on the surface depends on the next velocity, too, and
    // so on the acceleration.
    const ForceTerms &terms = equation.terms;
    const double      c     = velocity_factor * terms.damping_shares().mass;
    const bool        has_surface_damping =
      velocity_factor != 0 && terms.has_surface_damping();
    if (has_surface_damping || !body.mass.is_lumped())
      if (residual.size() == 0)
        for (Vector *vector : {&residual, &acceleration, &ghosted})
          body.discretization.initialize_vector(*vector);
    StageReport report;
    if (body.mass.is_lumped())
      {
        if (has_surface_damping)
          report.linear_iterations =
            solve_lumped_with_surface_damping(state, time, velocity_factor, c);
        else
          solve_lumped(state, time, velocity_factor, c);
        return report;
      }
    // The free accelerations follow from the prescribed ones: M_ff a_f = r_f.
    for (unsigned int i = 0; i < state.a.locally_owned_size(); ++i)
      if (!body.motion.is_prescribed()[i])
        state.a.local_element(i) = 0;
    EquationOfMotion::Forces &forces = equation.evaluate(state, time, 1.);
    Vector                   &r      = residual;
    Vector                   &a      = acceleration;
    equation.residual(r);

    ScopedTimer                    timer(equation.wall_times.solve);
    const SurfaceOperator<double> *C =
      has_surface_damping ? &surface_damping(time, velocity_factor) : nullptr;
    // The damping due to the prescribed accelerations.
    if (c > 0)
      r.add(-c, forces.inertia);
    if (C != nullptr)
      {
        a = 0;
        copy_with_ghosts(ghosted, state.a);
        C->add(a, ghosted);
        r -= a;
      }
    body.motion.set_zero(r);
    if (C != nullptr)
      report.linear_iterations = mass_solver().solve(a, r, 1 + c, *C);
    else
      {
        report.linear_iterations = mass_solver().solve(a, r);
        a *= 1 / (1 + c);
      }
    state.a += a;
    state.v.add(velocity_factor, a);
    equation.evaluate_inertia(state.a);
    if (c > 0)
      forces.damping.add(c, forces.inertia);
    if (C != nullptr)
      {
        copy_with_ghosts(ghosted, state.a);
        C->add(forces.damping, ghosted);
      }
    return report;
  }

  const SurfaceOperator<double> &
  AccelerationSolver::surface_damping(const double time, const double factor)
  {
    if (!damping_operator)
      {
        surface =
          std::make_unique<SurfaceMatrix>(body.discretization, body.reference);
        damping_operator =
          std::make_unique<SurfaceOperator<double>>(body.discretization);
      }
    if (factor != damping_factor ||
        (time != damping_time &&
         equation.terms.surface_matrix_depends_on_time()) ||
        equation.terms.surface_matrix_depends_on_motion())
      {
        equation.terms.surface_matrix(*surface,
                                      equation.motion(time),
                                      0.,
                                      factor);
        damping_operator->set(*surface);
        damping_time   = time;
        damping_factor = factor;
      }
    return *damping_operator;
  }

  bool
  AccelerationSolver::can_step_many() const
  {
    return body.mass.is_lumped() &&
           body.elasticity.vertex_dilatation() == nullptr &&
           !equation.terms.has_damping() && !equation.terms.has_elastic() &&
           equation.has_constant_loads() && body.motion.is_at_rest();
  }

  bool
  AccelerationSolver::step_many(State             &state,
                                const double       dt,
                                const unsigned int n)
  {
    if (!can_step_many())
      return false;
    ScopedTimer timer(equation.wall_times.assembly);
    for (unsigned int i = 0; i < n; ++i)
      body.elasticity.explicit_step(state.u,
                                    state.v,
                                    equation.last_forces().external,
                                    mass_solver().inverse_diagonal_vector(),
                                    dt);
    return true;
  }

  AccelerationSolver::LargestFrequencies
  AccelerationSolver::largest_frequencies(const State &state, const double time)
  {
    equation.set_state(state);
    const Discretization &discretization = body.discretization;
    Elasticity           &elasticity     = body.elasticity;
    const auto springs = equation.terms.stiffest_springs(body.reference, time);
    SurfaceOperator<double> surface_stiffness(discretization);
    if (springs)
      surface_stiffness.set(*springs);
    // The exact tangent is used where it is symmetric, as tension stiffens.
    Tangent tangent = elasticity.is_symmetric(Tangent::consistent) ?
                        Tangent::consistent :
                        Tangent::frozen_rotation;
    if (!elasticity.is_by_cell(tangent))
      elasticity.linearize(equation.displacement(), tangent);
    if (ghosted.size() == 0)
      discretization.initialize_vector(ghosted);
    bool                  is_supported = springs != nullptr;
    const SymmetricPencil pencil{
      [&](Vector &f, const Vector &v) {
        copy_with_ghosts(ghosted, v);
        elasticity.apply_stiffness(f, ghosted, tangent);
        if (is_supported)
          surface_stiffness.add(f, ghosted);
        body.motion.set_zero(f);
      },
      [&](Vector &f, const Vector &v) { mass_solver().vmult(f, v); },
      [&](Vector &v, const Vector &f) { mass_solver().solve(v, f); }};
    // Each unknown has an equal share of the start vector in the inner product
    // of M. Otherwise light nodes had next to none, and their modes, which may
    // be the fastest, came out last.
    Vector start(state.u);
    fill_by_place(start, discretization);
    const Vector &inverse_mass = mass_solver().inverse_diagonal_vector();
    for (unsigned int i = 0; i < start.locally_owned_size(); ++i)
      start.local_element(i) *= std::sqrt(inverse_mass.local_element(i));
    body.motion.set_zero(start);
    constexpr double tolerance = 2e-3;
    Vector           vector    = start;
    const double all = std::sqrt(largest_eigenvalue(pencil, vector, tolerance));
    if (equation.terms.damping_shares().stiffness == 0 ||
        (!springs && elasticity.is_by_cell(tangent)))
      return {all, all};
    // Damping is proportional to the stiffness with frozen rotations, even if
    // the exact tangent is softer, and not to that of springs.
    tangent      = Tangent::frozen_rotation;
    is_supported = false;
    if (!elasticity.is_by_cell(tangent))
      elasticity.linearize(equation.displacement(), tangent);
    return {all, std::sqrt(largest_eigenvalue(pencil, start, tolerance))};
  }
} // namespace corotet
