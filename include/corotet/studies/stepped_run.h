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
   * A run of the program, step by step, for a program with a loop of its own:
   * it looks at the state, changes what its own force terms depend on
   * (operators/force_term.h), and goes on. Results go into the output directory
   * as those of the program do.
   *
   * A load that the caller changes says that it depends on time. What is
   * changed between two steps holds from the end of the next one on: for the
   * integrator the load goes there from its last value as if it were given as
   * an expression that jumps inside of that step.
   *
   * There are no checkpoints, and signals do not end it. Each run has an output
   * directory of its own; several may go on at once.
   *
   * All members are collective.
   */
  class SteppedRun
  {
  public:
    /**
     * Reads the parameter file, makes the initial state and its results. Of @p
     * command the file, the overrides, the output directory and quiet count,
     * not the rest. Throws InputError, ComputationError and MachineError.
     */
    explicit SteppedRun(const CommandLine &command,
                        const MPI_Comm     comm = MPI_COMM_WORLD);
    ~SteppedRun();

    /// Whether the end time is reached, or the run is over: by finish(), or by
    /// a step that has failed.
    bool
    is_done() const;

    /**
     * Goes on to the next step that is recorded (every one, unless
     * Output/Steps between rows says otherwise). Throws ComputationError; then
     * the run is over and its results are complete. To be called before
     * is_done() only: throws std::logic_error after it.
     */
    void
    step();

    /// Completes the results. After the last step, which need not be that of
    /// the end time; without effect if the run is over.
    void
    finish();

    /// Of the state [s].
    double
    time() const;

    /// In m, ghost entries up to date: unknowns 3n, 3n+1, 3n+2 of local node n.
    const Vector &
    displacement() const;

    /// In m/s, likewise.
    const Vector &
    velocity() const;

    /// The budget of the last step, equal on all ranks: energies, momenta,
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
