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

    /// Sizes the vectors of @p state, of which statics only need the
    /// displacement, and sets the initial displacement and velocity. Throws
    /// InputError if these, or loads, are not finite. Collective.
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

    /**
     * Sets a of @p state to an acceleration that a step of @p dt [s] from
     * @p time [s] resolves. That of the equation there, M a = g - C v - f(u),
     * lasts for a small part of the step only if the forces do not balance and
     * damping stops motion at once, as that by stiffness does with the shortest
     * waves of a mesh; what implicit methods make of it, some factor times
     * dt^2 a, may be any multiple of the true displacement dt C^{-1} (g -
     * f(u)). Here the equation holds for the state that a leads to if it lasts
     * for the step, but for what an acceleration a_* leads to that is found so
     * with a_* = 0,
     *
     *   M a + C (v + dt (a - a_*)) + f(u + dt^2 / 2 (a - a_*)) = g.
     *
     * a_* differs from the acceleration at that time by O(dt), a by O(dt^2); of
     * motion that is damped within the step both have its mean. Throws
     * ComputationError; then @p state is as it was.
     */
    StageReport
    solve_mean_acceleration(State &state, const double time, const double dt);

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
