// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_observer_h
#define corotet_simulation_observer_h

#include <corotet/base/timing.h>
#include <corotet/discretization/discretization.h>
#include <corotet/operators/elasticity.h>
#include <corotet/operators/error_norms.h>
#include <corotet/operators/stress_field.h>
#include <corotet/simulation/step_record.h>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The data of a finished step for observers. References are valid during the
   * call only.
   */
  struct Snapshot
  {
    const Discretization &discretization;
    const StepRecord     &record;
    /// Displacement [m], ghost entries up to date.
    const Vector &displacement;
    /// Velocity [m/s], ghost entries up to date; empty if it is zero.
    const Vector &velocity;
    /// Computes the cell data of this state. Collective.
    std::function<CellResults()> cell_results;
    /// Whether no step follows (the run ends here).
    bool last;
    /// The stress of this state. Collective.
    std::function<StressField &()> stress;
    /// The support forces of this rank, an entry for each unknown of
    /// PrescribedMotion::unknowns(), in their order.
    std::span<const SupportForce> support_forces;
  };

  /**
   * How a run ended.
   */
  struct RunSummary
  {
    /// "done", "failed" if the computation failed, or "stopped" by a signal or
    /// the limit of wall time.
    std::string status;
    /// Why it failed or stopped; empty if it is done.
    std::string message;

    unsigned int ranks    = 1;
    unsigned int degree   = 0;
    std::size_t  cells    = 0;
    std::size_t  nodes    = 0;
    std::size_t  unknowns = 0;
    /// Volume of the body at rest [m^3].
    double mesh_volume = 0;
    /// Mass [kg].
    double total_mass = 0;

    unsigned int steps    = 0;
    double       end_time = 0;
    /// How often a preconditioner was made.
    unsigned int preconditioner_builds = 0;
    /// Error norms of the last displacement, where the exact one is known.
    std::optional<ErrorNorms> errors;
    /// Largest angle [rad], for the last displacement, between rotations inside
    /// of cells and those at their centres, where only the latter are used.
    std::optional<double> largest_rotation_difference;

    WallTimes wall_times;
    double    total_wall_time = 0;
  };

  /**
   * Watches a run without changing it. All calls are collective: they throw on
   * all ranks or on none (see base/mpi.h).
   */
  class Observer
  {
  public:
    virtual ~Observer() = default;

    /// Called with the initial state: step 0.
    virtual void
    start(const Snapshot & /*initial*/)
    {}

    /// Transfers what an observer needs to go on after a restart: called for
    /// checkpoints.
    virtual void
    transfer(Archive & /*archive*/)
    {}

    /// Called in place of start() after a restart, when transfer() has read:
    /// what the run has written after the checkpoint does not count.
    virtual void
    resume(const Snapshot & /*state*/)
    {}

    /// Called after every step that is recorded (see OutputTimes).
    virtual void
    step(const Snapshot & /*state*/)
    {}

    /// Called after a failure with the state of the last step, which step() has
    /// shown already; it is the last one of the run.
    virtual void
    save(const Snapshot & /*state*/)
    {}

    /// Called at the end, also after a failure.
    virtual void
    finish(const RunSummary & /*summary*/)
    {}
  };
} // namespace corotet

#endif
