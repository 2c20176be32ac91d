// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_budget_h
#define corotet_simulation_budget_h

#include <corotet/simulation/observer.h>
#include <corotet/simulation/structural_system.h>

namespace corotet
{
  /**
   * Energies, works and momenta, step by step.
   *
   * Works are sums of the mean of the forces at both ends of a step times the
   * displacement in it: second order, and what makes the balance of the
   * trapezoidal rule zero for linear problems. Supports work through their
   * reactions M a + C v + f_int - f_ext.
   *
   * @p system must outlive this object. Members are collective.
   */
  class Budget
  {
  public:
    Budget(StructuralSystem     &system,
           const Discretization &discretization,
           const State          &initial_state,
           const double          time,
           const double          load_factor);

    /**
     * Accounts for the step that led to @p state at @p time. Throws
     * ComputationError, and accounts for nothing, if there the forces are not
     * finite. The fields of the
     * record that only the driver knows (step, dt, iterations, wall time) are
     * left as they are.
     */
    void
    update(StepRecord  &record,
           const State &state,
           const double time,
           const double load_factor);

    /// The record of the initial state.
    const StepRecord &
    initial_record() const
    {
      return initial;
    }

  private:
    void
    evaluate(StepRecord  &record,
             const State &state,
             const double time,
             const double load_factor);

    StructuralSystem     &system;
    const Discretization &discretization;
    /// Per owned node, local numbers: forces of loads and supports together,
    /// damping forces and displacement, now and at the last call.
    Vector     force;
    Vector     damping;
    Vector     displacement;
    Vector     last_force;
    Vector     last_damping;
    Vector     last_displacement;
    Vector     momentum;
    double     work        = 0;
    double     dissipation = 0;
    StepRecord initial;
  };
} // namespace corotet

#endif
