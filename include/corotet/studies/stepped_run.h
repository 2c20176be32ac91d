// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_stepped_run_h
#define corotet_studies_stepped_run_h

#include <corotet/base/vector.h>
#include <corotet/simulation/command_line.h>
#include <corotet/simulation/step_record.h>

#include <mpi.h>

#include <memory>

namespace corotet
{
  class Discretization;

  /**
   * A run of the program, step by step, for a program with a loop of its own,
   * which looks at the state, changes the input of its own force terms
   * (operators/force_term.h), and continues. Results go into the output
   * directory like those of the program.
   *
   * A load that the caller changes must declare that it depends on time. A
   * change between two steps is effective from the end of the next step on: for
   * the integrator the load goes there from its last value, as if it were given
   * by an expression that jumps inside of that step.
   *
   * There are no checkpoints, and signals do not end the run. Each run has an
   * output directory of its own; several runs may exist at once.
   *
   * All members are collective.
   */
  class SteppedRun
  {
  public:
    /**
     * Reads the parameter file, makes the initial state and its results. Of @p
     * command only the file, the overrides, the output directory and quiet are
     * used. Throws InputError, ComputationError and MachineError.
     */
    explicit SteppedRun(const CommandLine &command,
                        const MPI_Comm     comm = MPI_COMM_WORLD);
    ~SteppedRun();

    /// Whether the end time is reached, or the run has been ended by finish()
    /// or by a step that has failed.
    bool
    is_done() const;

    /**
     * Advances to the next step that is recorded (every step, unless
     * Output/Steps between rows says otherwise). Throws ComputationError; then
     * the run has ended and its results are complete. Must not be called once
     * is_done(): throws std::logic_error then.
     */
    void
    step();

    /// Completes the results. To be called after the last step, which may be
    /// before the end time; without effect if the run has ended.
    void
    finish();

    /// The time of the state [s].
    double
    time() const;

    /// The displacement [m], with ghost entries up to date: unknowns 3n, 3n+1,
    /// 3n+2 of local node n.
    const Vector &
    displacement() const;

    /// The velocity [m/s], in the same form.
    const Vector &
    velocity() const;

    /// The record of the last step, equal on all ranks: energies, momenta,
    /// reactions, iterations.
    const StepRecord &
    record() const;

    /// The nodes, their positions, and the cells.
    const Discretization &
    discretization() const;

  private:
    struct Parts;
    const std::unique_ptr<Parts> parts;
  };
} // namespace corotet

#endif
