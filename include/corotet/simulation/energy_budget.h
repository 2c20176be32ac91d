// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_energy_budget_h
#define corotet_simulation_energy_budget_h

#include <corotet/simulation/equation_of_motion.h>
#include <corotet/simulation/observer.h>

namespace corotet
{
  /**
   * Energies, works and momenta, step by step, as the integrator sees them.
   *
   * The equation of motion holds at one time in each step: at its end, in its
   * middle, or wherever the integrator puts it. Forces are known at these
   * times. The work of a step is that of the forces at its middle, interpolated
   * linearly between the last two of these times: second order for every
   * integrator, and exactly the change of energy for those that keep it (linear
   * elasticity; implicit midpoint, trapezoidal rule, generalized-alpha with
   * spectral radius 1, central difference). The motion of what is prescribed
   * has velocities of its own: there, inertia and damping work along dt (v_0 +
   * v_1) / 2, elastic forces along u_1 - u_0.
   *
   * Supports act by their reactions M a + C v + f_int - f_ext.
   *
   * The energy of elastic force terms is elastic energy. The forces of those
   * that depend on time count among the loads, and the change of their energy
   * as work from outside: together that is the work of what changes them.
   *
   * @p equation must outlive this object. Members are collective.
   */
  class EnergyBudget
  {
  public:
    /// Begins the budget of @p equation, which must have been evaluated at @p
    /// initial_state: its forces are those at the start. @p staggered_step, if
    /// not zero, is the step [s] of an integrator that keeps the kinetic energy
    /// v_-1/2 . M v_1/2 / 2 = v . M v / 2 - dt^2 a . M a / 8 with the
    /// velocities half a step before and after.
    EnergyBudget(EquationOfMotion &equation,
                 const State      &initial_state,
                 const double      time,
                 const double      staggered_step = 0);

    /**
     * Accounts for the work of the step of length @p dt that led to @p state at
     * @p time, with the forces of the last evaluation: add_work() and
     * end_step().
     */
    void
    account(const State &state, const double time, const double dt)
    {
      add_work(state, time, dt);
      end_step(state);
    }

    /// Adds the work of that step. Throws ComputationError, and adds nothing,
    /// if it is not finite.
    void
    add_work(const State &state, const double time, const double dt);

    /// Takes the last calls of add_work() and record() back. Not after
    /// end_step().
    void
    take_back();

    /// Begins the next step at @p state, with the forces of the last
    /// evaluation.
    void
    end_step(const State &state);

    /// The displacement at the last call of end_step() [m], owned entries.
    const Vector &
    last_displacement() const
    {
      return last.displacement;
    }

    /**
     * Fills in the budget of the state whose work was added last. Throws
     * ComputationError if an energy is not finite. The fields of the record
     * that only the driver knows (step, dt, iterations, wall time) are left as
     * they are. The equation is left with the displacement and rotations of
     * @p state.
     */
    void
    record(StepRecord &record, const State &state, const double time);

    /// What the supports did in the last record(), at the time for which the
    /// equation of motion was solved: an entry for each unknown of
    /// PrescribedMotion::unknowns(), in their order. The forces are not numbers
    /// from transfer() until the next record().
    const std::vector<SupportForce> &
    support_forces() const
    {
      return support_force_list;
    }

    /// Kinetic energy of the prescribed unknowns in the state of the last
    /// record() [J]; no work supplies it where their velocity jumps.
    double
    kinetic_energy_of_supports() const
    {
      return energy_of_supports;
    }

    /// Transfers the data that the next steps continue from. A budget that
    /// reads may have been made with any state.
    void
    transfer(Archive &archive);

    /// The record of the initial state.
    const StepRecord &
    initial_record() const
    {
      return initial;
    }

  private:
    /// Forces at the time of a step for which the equation of motion holds;
    /// owned entries.
    struct StepForces
    {
      double time;
      /// Forces that work along the displacement: loads on free unknowns, and
      /// elastic forces on prescribed ones, with those of force terms.
      Vector external;
      /// Damping forces on all unknowns, and the part of friction; the latter
      /// is empty if there is none, or nothing else.
      Vector damping, friction;
      /// The displacement at the end of the step.
      Vector displacement;
      /// Inertia plus damping forces, and velocities at the end of the step, of
      /// the prescribed unknowns, in their order.
      std::vector<double> carried, velocity;
    };

    /// Begins the account in statics, where the initial state is a guess of the
    /// first one, with the body at rest and the forces that act there.
    void
    begin_unloaded(const State &guess);
    /// Forces of the last evaluation on an owned unknown: inertia plus damping,
    /// and those that work along the displacement.
    double
    carried(const unsigned int i) const;
    double
    external(const unsigned int i) const;
    /// Finds works and the balance, with the energies of the record.
    /// Collective.
    void
    find_balance(StepRecord &record, const Motion &motion) const;
    /// What obstacles, springs and dashpots do. Collective.
    void
    record_forces(StepRecord &record, const Motion &motion) const;
    /// Finds the friction of the last evaluation, in explicit steps with the
    /// velocity of @p state. Collective.
    void
    find_friction(const State &state);
    /// Finds the kinetic energies of this rank, and the momentum of each node.
    void
    find_kinetic_energy(StepRecord &record, const State &state);
    void
    transfer_forces(Archive &archive, StepForces &forces) const;

    EquationOfMotion &equation;
    const Body       &body;
    const ForceTerms &force_terms;
    const bool        is_staggered;
    const bool        has_obstacles;
    /// The length of the last step, and its forces.
    double     dt;
    StepForces last;
    /// M v; empty in statics.
    Vector momentum;
    double work = 0;
    /// Where the account begins, the kinetic and elastic energy, and that of
    /// elastic terms that depend on time [J].
    double initial_energy          = 0;
    double initial_changing_energy = 0;
    /// Whether the next step of the account begins at rest, with the forces
    /// that act there, instead of at the guess.
    bool   is_unloaded   = false;
    double dissipation   = 0;
    double friction_work = 0;
    /// Friction of the last evaluation; empty if there is none, or no other
    /// damping.
    Vector friction;
    /// Work space, of the same size.
    Vector     velocity;
    double     energy_of_supports = 0;
    StepRecord initial;
    /// What the supports did in the last record(), and in the one before.
    std::vector<SupportForce> support_force_list, support_forces_before;
    /// Values of dt, work, dissipation and work of friction before the last
    /// add_work().
    std::array<double, 4> before{};
  };
} // namespace corotet

#endif
