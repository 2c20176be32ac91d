// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/operators/surface.h>
#include <corotet/simulation/budget.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace corotet
{
  using dealii::Tensor;

  Budget::Budget(StructuralSystem     &system,
                 const Discretization &discretization,
                 const State          &initial_state,
                 const double          time,
                 const double          load_factor)
    : system(system)
    , discretization(discretization)
  {
    for (Vector *vector : {&force,
                           &damping,
                           &displacement,
                           &last_force,
                           &last_damping,
                           &last_displacement,
                           &momentum})
      discretization.initialize_vector(*vector);
    evaluate(initial, initial_state, time, load_factor);
    initial.time = time;
  }

  void
  Budget::evaluate(StepRecord  &record,
                   const State &state,
                   const double time,
                   const double load_factor)
  {
    const StructuralSystem::Forces &forces =
      system.evaluate(state, time, load_factor);
    const MPI_Comm comm = discretization.communicator();
    displacement        = state.u;
    damping             = forces.damping;
    force               = forces.external;

    Tensor<1, 3> reaction;
    for (const unsigned int i : system.prescribed_motion().unknowns())
      {
        const double r =
          forces.inertia.local_element(i) + forces.damping.local_element(i) +
          forces.internal.local_element(i) - forces.external.local_element(i);
        force.local_element(i) += r;
        reaction[i % 3] += r;
      }
    record.reaction = dealii::Utilities::MPI::sum(reaction, comm);

    system.mass().apply(momentum, system.velocity());
    record.kinetic_energy = 0.5 * (momentum * state.v);
    Tensor<1, 3> linear, angular, moment;
    double       largest_square = 0;
    for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
      {
        Tensor<1, 3> p, u, f;
        for (unsigned int a = 0; a < 3; ++a)
          {
            p[a] = momentum.local_element(3 * n + a);
            f[a] = forces.internal.local_element(3 * n + a);
            u[a] = state.u.local_element(3 * n + a);
          }
        linear += p;
        angular += cross_product_3d(discretization.node_position(n) + u, p);
        moment += cross_product_3d(discretization.node_position(n) + u, f);
        largest_square = std::max(largest_square, u.norm_square());
      }
    record.momentum         = dealii::Utilities::MPI::sum(linear, comm);
    record.angular_momentum = dealii::Utilities::MPI::sum(angular, comm);
    record.internal_moment  = dealii::Utilities::MPI::sum(moment, comm);
    record.max_displacement =
      std::sqrt(dealii::Utilities::MPI::max(largest_square, comm));

    const ElasticState elastic =
      system.elasticity().state(system.displacement());
    record.elastic_energy   = elastic.energy;
    record.min_det_F        = elastic.min_det_F;
    record.inverted_cells   = elastic.inverted_cells;
    record.degenerate_cells = elastic.degenerate_cells;
    record.robust_rotations = elastic.robust_rotations;
    record.volume           = displaced_volume(discretization,
                                     system.reference_element(),
                                     system.displacement());
  }

  void
  Budget::update(StepRecord  &record,
                 const State &state,
                 const double time,
                 const double load_factor)
  {
    last_force.swap(force);
    last_damping.swap(damping);
    last_displacement.swap(displacement);
    evaluate(record, state, time, load_factor);
    if (!std::isfinite(norm(force) + norm(damping) + record.elastic_energy +
                       record.kinetic_energy))
      {
        // As if this call had not been.
        last_force.swap(force);
        last_damping.swap(damping);
        last_displacement.swap(displacement);
        throw ComputationError(
          "the forces at the end of the step are not finite");
      }

    // Mean forces times the displacement of the step.
    last_force.sadd(0.5, 0.5, force);
    last_damping.sadd(0.5, 0.5, damping);
    last_displacement.sadd(-1., displacement);
    work += last_force * last_displacement;
    dissipation += last_damping * last_displacement;

    record.time              = time;
    record.external_work     = work;
    record.dissipated_energy = dissipation;
    record.energy_balance    = record.kinetic_energy + record.elastic_energy +
                            dissipation - work - initial.kinetic_energy -
                            initial.elastic_energy;
  }
} // namespace corotet
