// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// What explicit steps ask of the system: accelerations and the largest
// frequency.

#include <corotet/base/ghosted_copy.h>
#include <corotet/simulation/structural_system.h>
#include <corotet/solvers/largest_eigenvalue.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace corotet
{
  void
  StructuralSystem::solve_lumped_acceleration(State       &state,
                                              const double time,
                                              const double velocity_factor,
                                              const double c)
  {
    evaluate_forces(state, time, 1.);
    ScopedTimer          timer(wall_times.solve);
    const unsigned char *is_prescribed = motion.is_prescribed().data();
    const double        *m             = mass_matrix.diagonal().begin();
    const double        *external      = forces.external.begin();
    const double        *internal      = forces.internal.begin();
    const double        *elastic =
      terms.has_elastic() ? forces.elastic.begin() : nullptr;
    double            *damping = forces.damping.begin();
    double            *inertia = forces.inertia.begin();
    double            *a       = state.a.begin();
    double            *v       = state.v.begin();
    const unsigned int n       = state.a.locally_owned_size();
    for (unsigned int i = 0; i < n; ++i)
      if (is_prescribed[i])
        inertia[i] = m[i] * a[i];
      else
        {
          const double e = elastic != nullptr ? elastic[i] : 0.;
          inertia[i] = (external[i] - internal[i] - damping[i] - e) / (1 + c);
          a[i]       = inertia[i] / m[i];
          v[i] += velocity_factor * a[i];
          damping[i] += c * inertia[i];
        }
  }

  StageReport
  StructuralSystem::solve_acceleration(State       &state,
                                       const double time,
                                       const double velocity_factor)
  {
    // Of damping by mass and on the surface, a part is in the velocity to come.
    const double c = velocity_factor * terms.damping_shares().mass;
    const bool   has_surface_damping =
      velocity_factor != 0 && terms.has_surface_damping();
    if (mass_matrix.is_lumped() && !has_surface_damping)
      {
        solve_lumped_acceleration(state, time, velocity_factor, c);
        return {};
      }

    StageReport report;
    if (free_residual.size() == 0)
      for (Vector *vector : {&free_residual, &free_acceleration})
        discretization.initialize_vector(*vector);
    // Free accelerations from those that are prescribed: M_ff a_f = r_f.
    for (unsigned int i = 0; i < state.a.locally_owned_size(); ++i)
      if (!motion.is_prescribed()[i])
        state.a.local_element(i) = 0;
    evaluate(state, time, 1.);
    Vector &r = free_residual;
    Vector &a = free_acceleration;
    r         = forces.external;
    r -= forces.internal;
    r -= forces.damping;
    r -= forces.inertia;
    subtract_elastic(r);
    motion.set_zero(r);

    ScopedTimer                    timer(wall_times.solve);
    const SurfaceOperator<double> *C =
      has_surface_damping ? &surface_damping(time, velocity_factor) : nullptr;
    if (C != nullptr)
      report.linear_iterations = mass_solver.solve(a, r, 1 + c, *C);
    else
      {
        report.linear_iterations = mass_solver.solve(a, r);
        a *= 1 / (1 + c);
      }
    state.a += a;
    state.v.add(velocity_factor, a);
    copy_with_ghosts(a_ghosted, state.a);
    mass_matrix.apply(forces.inertia, a_ghosted);
    if (c > 0)
      {
        copy_with_ghosts(a_ghosted, a);
        mass_matrix.apply(r, a_ghosted);
        forces.damping.add(c, r);
      }
    if (C != nullptr)
      {
        copy_with_ghosts(a_ghosted, a);
        C->add(forces.damping, a_ghosted);
      }
    return report;
  }

  const SurfaceOperator<double> &
  StructuralSystem::surface_damping(const double time, const double factor)
  {
    if (!damping_operator)
      damping_operator =
        std::make_unique<SurfaceOperator<double>>(discretization);
    if (factor != damping_factor ||
        (time != damping_time && terms.surface_matrix_depends_on_time()))
      {
        damping_operator->set(surface_matrix(time, 0., factor));
        damping_time   = time;
        damping_factor = factor;
      }
    return *damping_operator;
  }

  const SurfaceMatrix &
  StructuralSystem::surface_matrix(const double time,
                                   const double c_u,
                                   const double c_v)
  {
    // That of the stage is lost.
    surface_factor = std::numeric_limits<double>::quiet_NaN();
    terms.surface_matrix(*surface, time, c_u, c_v);
    return *surface;
  }

  bool
  StructuralSystem::can_step_many() const
  {
    return mass_matrix.is_lumped() && !terms.has_damping() &&
           !terms.has_elastic() && terms.is_constant() &&
           known_load_factor == 1 && motion.is_at_rest();
  }

  bool
  StructuralSystem::step_many(State             &state,
                              const double       dt,
                              const unsigned int n)
  {
    if (!can_step_many())
      return false;
    ScopedTimer timer(wall_times.assembly);
    for (unsigned int i = 0; i < n; ++i)
      elastic.explicit_step(state.u,
                            state.v,
                            forces.external,
                            mass_solver.inverse_diagonal_vector(),
                            dt);
    return true;
  }

  double
  StructuralSystem::largest_frequency(const State &state, const double time)
  {
    set_state(state);
    SurfaceOperator<double> springs(discretization);
    if (surface)
      springs.set(surface_matrix(time, 1., 0.));
    // The exact tangent where it is symmetric: tension stiffens.
    const Tangent tangent = elastic.is_symmetric(Tangent::consistent) ?
                              Tangent::consistent :
                              Tangent::frozen_rotation;
    if (!elastic.is_by_cell(tangent))
      elastic.linearize(u_ghosted, tangent);
    const SymmetricPencil pencil{
      [&](Vector &f, const Vector &v) {
        copy_with_ghosts(a_ghosted, v);
        elastic.apply_stiffness(f, a_ghosted, tangent);
        if (surface)
          springs.add(f, a_ghosted);
        motion.set_zero(f);
      },
      [&](Vector &f, const Vector &v) { mass_solver.vmult(f, v); },
      [&](Vector &v, const Vector &f) { mass_solver.solve(v, f); }};
    // A start without pattern, the same on any number of ranks.
    Vector       start(state.u);
    const double length = discretization.node_positions().linfty_norm();
    for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
      for (unsigned int a = 0; a < 3; ++a)
        {
          const dealii::Point<3> x = discretization.node_position(n) / length;
          const double           s =
            std::sin(12.9898 * x[0] + 78.233 * x[1] + 37.719 * x[2] + a) *
            43758.5453;
          start.local_element(3 * n + a) = s - std::floor(s) - 0.5;
        }
    motion.set_zero(start);
    return std::sqrt(largest_eigenvalue(pencil, start, 2e-3));
  }

  double
  StructuralSystem::root_mean_square(const Vector &field) const
  {
    double sum = 0;
    for (unsigned int i = 0; i < field.locally_owned_size(); ++i)
      sum += mass_matrix.diagonal().local_element(i) * field.local_element(i) *
             field.local_element(i);
    return std::sqrt(
      dealii::Utilities::MPI::sum(sum, discretization.communicator()) /
      mass_diagonal_sum);
  }
} // namespace corotet
