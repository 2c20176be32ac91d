// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_structural_system_h
#define corotet_simulation_structural_system_h

#include <corotet/simulation/acceleration_solver.h>
#include <corotet/simulation/equation_of_motion.h>
#include <corotet/simulation/implicit_solver.h>

namespace corotet
{
  /**
   * A body and what acts on it as time integrators see them: its equation of
   * motion, and the two ways to solve it.
   *
   * Everything but the matrix is made by the constructor, which so checks all
   * input. The arguments must outlive this object. Members are collective.
   */
  class StructuralSystem : public SecondOrderSystem
  {
  public:
    /// Throws InputError.
    StructuralSystem(Body                       &body,
                     const SimulationParameters &parameters,
                     WallTimes                  &wall_times,
                     Log                        &log);

    /// Sizes the vectors of @p state and gives it the initial displacement and
    /// velocity. Throws InputError if these, or loads, are not finite.
    /// Collective.
    void
    initialize(State &state) const;

    void
    prescribe(State       &state,
              const double time,
              const double load_factor) override;

    /**
     * The first iteration of Newton's method in a load step, with the supports'
     * motion in its increment, from the equilibrium before: the body follows
     * them as its tangent there says. (Supports that move alone would crush the
     * cells at them, and may leave the body in another equilibrium.) Nothing
     * but prescribe() if they do not move or the material is linear.
     */
    StageReport
    move_supports(State       &state,
                  const double time,
                  const double load_factor) override;

    StageReport
    solve_stage(State &state, const Stage &stage) override;

    StageReport
    solve_acceleration(State       &state,
                       const double time,
                       const double velocity_factor = 0) override;

    bool
    step_many(State &state, const double dt, const unsigned int n) override;

    EquationOfMotion &
    equation()
    {
      return equation_of_motion;
    }

    const EquationOfMotion &
    equation() const
    {
      return equation_of_motion;
    }

    ImplicitSolver &
    implicit_solver()
    {
      return implicit;
    }

    AccelerationSolver &
    acceleration_solver()
    {
      return accelerations;
    }

  private:
    const SimulationParameters &parameters;
    EquationOfMotion            equation_of_motion;
    ImplicitSolver              implicit;
    AccelerationSolver          accelerations;
  };
} // namespace corotet

#endif
