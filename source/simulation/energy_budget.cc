// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/ghosted_copy.h>
#include <corotet/base/joint_reduction.h>
#include <corotet/base/vector_at.h>
#include <corotet/operators/surface.h>
#include <corotet/simulation/energy_budget.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>

namespace corotet
{
  using dealii::Tensor;

  namespace
  {
    // Fills in what the record says of the shapes of cells.
    void
    describe_cells(StepRecord &record, const ElasticState &state)
    {
      record.min_det_F        = state.min_det_F;
      record.inverted_cells   = state.inverted_cells;
      record.degenerate_cells = state.degenerate_cells;
      record.robust_rotations = state.robust_rotations;
    }
  } // namespace

  EnergyBudget::EnergyBudget(EquationOfMotion &equation,
                             const State      &initial_state,
                             const double      time,
                             const double      staggered_step)
    : equation(equation)
    , body(equation.body)
    , force_terms(equation.terms)
    , is_staggered(staggered_step > 0)
    , has_obstacles(!force_terms.obstacles().empty())
    , dt(staggered_step)
  {
    const std::size_t n_prescribed = body.motion.unknowns().size();
    body.discretization.initialize_vector(last.external);
    if (force_terms.has_damping())
      body.discretization.initialize_vector(last.damping);
    if (force_terms.has_friction() && !force_terms.has_only_friction())
      {
        for (Vector *vector : {&friction, &last.friction, &velocity})
          body.discretization.initialize_vector(*vector);
        find_friction(initial_state);
      }
    body.discretization.initialize_vector(last.displacement);
    last.carried.resize(n_prescribed);
    last.velocity.resize(n_prescribed);
    support_force_list.resize(n_prescribed);
    support_forces_before.resize(n_prescribed);
    if (equation.is_dynamic)
      body.discretization.initialize_vector(momentum);
    end_step(initial_state);
    initial_changing_energy =
      force_terms.changing_energy(equation.motion(time));
    record(initial, initial_state, time);
    initial_energy         = initial.kinetic_energy + initial.elastic_energy;
    initial.energy_balance = 0;
    if (!equation.is_dynamic && initial.max_displacement > 0)
      begin_unloaded(initial_state);
  }

  void
  EnergyBudget::begin_unloaded(const State &guess)
  {
    const double time = equation.last_time(),
                 load = equation.last_load_factor();

    State at_rest = guess;
    at_rest.u     = 0;
    equation.evaluate(at_rest, time, load);
    end_step(at_rest);
    const Motion motion     = equation.motion(time);
    initial_energy          = force_terms.energy(motion);
    initial_changing_energy = force_terms.changing_energy(motion);
    // A step that fails is tried again from the guess.
    last.displacement = guess.u;
    equation.evaluate(guess, time, load);
    is_unloaded = true;
    // The balance begins with the guess's energy, for which no work was done.
    find_balance(initial, equation.motion(time));
  }

  double
  EnergyBudget::carried(const unsigned int i) const
  {
    const EquationOfMotion::Forces &terms = equation.last_forces();
    return (equation.is_dynamic ? terms.inertia.local_element(i) : 0.) +
           (terms.damping.size() > 0 ? terms.damping.local_element(i) : 0.);
  }

  double
  EnergyBudget::external(const unsigned int i) const
  {
    const EquationOfMotion::Forces &terms = equation.last_forces();
    if (body.motion.is_prescribed()[i] == 0)
      return terms.external.local_element(i);
    return terms.internal.local_element(i) +
           (terms.elastic.size() > 0 ? terms.elastic.local_element(i) : 0.);
  }

  void
  EnergyBudget::find_friction(const State &state)
  {
    // As record() does it for other forces.
    const Motion motion = equation.last_motion();
    if (is_staggered)
      copy_with_ghosts(velocity, state.v);
    force_terms.friction_force(
      friction, {motion.time, motion.u, is_staggered ? velocity : motion.v});
  }

  void
  EnergyBudget::end_step(const State &state)
  {
    last.time = equation.last_time();
    for (unsigned int i = 0; i < state.u.locally_owned_size(); ++i)
      last.external.local_element(i) = external(i);
    last.displacement = state.u;
    is_unloaded       = false;
    if (force_terms.has_damping())
      last.damping = equation.last_forces().damping;
    if (friction.size() > 0)
      last.friction = friction;
    const auto &prescribed = body.motion.unknowns();
    for (std::size_t k = 0; k < prescribed.size(); ++k)
      {
        last.carried[k] = carried(prescribed[k]);
        if (equation.is_dynamic)
          last.velocity[k] = state.v.local_element(prescribed[k]);
      }
  }

  void
  EnergyBudget::transfer_forces(Archive &archive, StepForces &forces) const
  {
    archive.transfer("time", forces.time);
    archive.transfer("external", forces.external);
    if (force_terms.has_damping())
      archive.transfer("damping", forces.damping);
    if (friction.size() > 0)
      archive.transfer("friction", forces.friction);
    archive.transfer("displacement", forces.displacement);
    // The values of prescribed unknowns are stored among all unknowns, as their
    // order depends on the partition.
    const auto transfer_prescribed = [&](const std::string   &name,
                                         std::vector<double> &values) {
      const auto &prescribed = body.motion.unknowns();
      Vector      spread;
      body.discretization.initialize_vector(spread);
      for (std::size_t k = 0; k < prescribed.size(); ++k)
        spread.local_element(prescribed[k]) = values[k];
      archive.transfer(name, spread);
      for (std::size_t k = 0; k < prescribed.size(); ++k)
        values[k] = spread.local_element(prescribed[k]);
    };
    transfer_prescribed("carried", forces.carried);
    transfer_prescribed("velocity", forces.velocity);
  }

  void
  EnergyBudget::transfer(Archive &archive)
  {
    archive.transfer("dt", dt);
    archive.transfer("work", work);
    archive.transfer("dissipation", dissipation);
    if (force_terms.has_friction())
      archive.transfer("friction_work", friction_work);
    archive.transfer("initial_changing_energy", initial_changing_energy);
    archive.transfer("initial_energy", initial_energy);
    archive.transfer("is_unloaded", is_unloaded);
    archive.within("initial", [&] { initial.transfer(archive); });
    archive.within("last", [&] { transfer_forces(archive, last); });
    // The forces of supports are not stored; they are those of the next record.
    if (archive.is_reading())
      for (SupportForce &support : support_force_list)
        support.force = std::numeric_limits<double>::quiet_NaN();
  }

  void
  EnergyBudget::add_work(const State &state, const double time, const double dt)
  {
    // Forces at the middle of the step: c is the share of the present ones, 1 -
    // c that of the last ones.
    const double c =
      (time - 0.5 * dt - last.time) / (equation.last_time() - last.time);
    const Vector &damping        = equation.last_forces().damping;
    const auto    middle_damping = [&](const unsigned int i) {
      return c * damping.local_element(i) +
             (1 - c) * last.damping.local_element(i);
    };
    const auto du = [&](const unsigned int i) {
      return state.u.local_element(i) -
             (is_unloaded ? 0. : last.displacement.local_element(i));
    };
    // Asked once, as it loops over all terms.
    const bool         has_damping = force_terms.has_damping();
    Tensor<1, 3>       sums;
    const unsigned int n = state.u.locally_owned_size();
    for (unsigned int i = 0; i < n; ++i)
      sums[0] +=
        (c * external(i) + (1 - c) * last.external.local_element(i)) * du(i);
    if (has_damping)
      for (unsigned int i = 0; i < n; ++i)
        sums[1] += middle_damping(i) * du(i);
    if (friction.size() > 0)
      {
        find_friction(state);
        for (unsigned int i = 0; i < n; ++i)
          sums[2] += (c * friction.local_element(i) +
                      (1 - c) * last.friction.local_element(i)) *
                     du(i);
      }
    // Prescribed unknowns move with their own velocity.
    const std::size_t n_moving =
      equation.is_dynamic ? body.motion.unknowns().size() : 0;
    for (std::size_t k = 0; k < n_moving; ++k)
      {
        const unsigned int i = body.motion.unknowns()[k];
        const double       dv =
          0.5 * dt * (state.v.local_element(i) + last.velocity[k]);
        sums[0] += (c * carried(i) + (1 - c) * last.carried[k]) * dv;
        if (has_damping)
          sums[1] += middle_damping(i) * (dv - du(i));
      }
    if (force_terms.has_only_friction())
      sums[2] = sums[1];
    sums =
      dealii::Utilities::MPI::sum(sums, body.discretization.communicator());
    if (!std::isfinite(sums[0] + sums[1]))
      throw ComputationError(
        "the forces at the end of the step are not finite" +
        equation.why_not_finite());

    before = {{this->dt, work, dissipation, friction_work}};
    work += sums[0];
    dissipation += sums[1];
    friction_work += sums[2];
    this->dt = dt;
  }

  void
  EnergyBudget::take_back()
  {
    dt            = before[0];
    work          = before[1];
    dissipation   = before[2];
    friction_work = before[3];
    support_force_list.swap(support_forces_before);
  }

  void
  EnergyBudget::find_kinetic_energy(StepRecord &record, const State &state)
  {
    record.kinetic_energy = 0;
    energy_of_supports    = 0;
    if (equation.is_dynamic)
      {
        body.mass.apply(momentum, equation.velocity());
        record.kinetic_energy = 0.5 * local_inner_product(momentum, state.v);
        for (const unsigned int i : body.motion.unknowns())
          energy_of_supports +=
            0.5 * momentum.local_element(i) * state.v.local_element(i);
      }
    if (is_staggered)
      record.kinetic_energy -=
        0.125 * dt * dt *
        local_inner_product(equation.last_forces().inertia, state.a);
  }

  void
  EnergyBudget::record_forces(StepRecord &record, const Motion &motion) const
  {
    if (has_obstacles)
      record.contact_forces = force_terms.contact_forces(motion);
    record.ground_forces = force_terms.ground_forces(motion);
  }

  void
  EnergyBudget::record(StepRecord  &record,
                       const State &state,
                       const double time)
  {
    const EquationOfMotion::Forces &terms       = equation.last_forces();
    const auto                      position_at = [&](const unsigned int n) {
      return body.discretization.node_position(n) +
             vector_at(equation.displacement(), n);
    };

    // Reactions and moments are those where the equation of motion holds.
    support_force_list.swap(support_forces_before);
    record.reaction = Tensor<1, 3>();
    for (std::size_t k = 0; k < support_force_list.size(); ++k)
      {
        const unsigned int i    = body.motion.unknowns()[k];
        auto &[force, position] = support_force_list[k];

        force = carried(i) + terms.internal.local_element(i) -
                terms.external.local_element(i);
        if (force_terms.has_elastic())
          force += terms.elastic.local_element(i);
        position = position_at(i / 3);
        record.reaction[i % 3] += force;
      }

    record.internal_moment = Tensor<1, 3>();
    for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
      record.internal_moment +=
        cross_product_3d(position_at(n), vector_at(terms.internal, n));

    // Explicit steps complete these with the velocity at the end of the step.
    if (!is_staggered)
      record_forces(record, equation.last_motion());

    // Energies and momenta are those at the end of the step.
    equation.set_state(state);
    if (is_staggered)
      record_forces(record, equation.motion(time));
    find_kinetic_energy(record, state);
    record.momentum = record.angular_momentum = Tensor<1, 3>();
    double largest_square                     = 0;
    for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
      {
        const Tensor<1, 3> u = vector_at(state.u, n);
        largest_square       = std::max(largest_square, u.norm_square());
        if (!equation.is_dynamic)
          continue;
        const Tensor<1, 3> p = vector_at(momentum, n);
        record.momentum += p;
        record.angular_momentum +=
          cross_product_3d(body.discretization.node_position(n) + u, p);
      }
    ElasticState elastic = body.elasticity.local_state(equation.displacement());
    record.volume        = local_displaced_volume(body.discretization,
                                           body.reference,
                                           equation.displacement());
    JointReduction reduction;
    for (Tensor<1, 3> *vector : {&record.reaction,
                                 &record.internal_moment,
                                 &record.momentum,
                                 &record.angular_momentum})
      reduction.sum(*vector);
    reduction.sum(record.kinetic_energy);
    reduction.sum(energy_of_supports);
    reduction.max(largest_square);
    elastic.reduce(reduction);
    reduction.sum(record.volume);
    reduction.run(body.discretization.communicator());

    record.max_displacement = std::sqrt(largest_square);
    const Motion motion     = equation.motion(time);
    record.elastic_energy   = elastic.energy + force_terms.energy(motion);
    if (!std::isfinite(record.elastic_energy + record.kinetic_energy))
      throw ComputationError("the energy is not finite" +
                             equation.why_not_finite());
    describe_cells(record, elastic);
    if (has_obstacles)
      record.contact_energy = force_terms.contact_energy(motion);
    record.friction_work = friction_work;

    find_balance(record, motion);
  }

  void
  EnergyBudget::find_balance(StepRecord &record, const Motion &motion) const
  {
    const double external_work =
      work + force_terms.changing_energy(motion) - initial_changing_energy;
    record.time              = motion.time;
    record.external_work     = external_work;
    record.dissipated_energy = dissipation;
    record.energy_balance    = record.kinetic_energy + record.elastic_energy +
                            dissipation - external_work - initial_energy;
  }
} // namespace corotet
