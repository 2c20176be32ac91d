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
   * What an observer sees of a finished step. References are valid during the
   * call only.
   */
  struct Snapshot
  {
    const Discretization &discretization;
    const StepRecord     &record;
    /// Unit m, ghost entries up to date.
    const Vector &displacement;
    /// Unit m/s, ghost entries up to date; zero if it is empty.
    const Vector &velocity;
    /// Computes the cell data of this state. Collective.
    std::function<CellResults()> cell_results;
    /// Whether no step follows (the run ends here).
    bool last;
    /// The stress of this state. Collective.
    std::function<StressField &()> stress;
    /// Of this rank, an entry for each unknown of PrescribedMotion::unknowns(),
    /// in their order.
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
    /// Of the body at rest [m^3].
    double mesh_volume = 0;
    /// In kg.
    double total_mass = 0;

    unsigned int steps    = 0;
    double       end_time = 0;
    /// How often a preconditioner was made.
    unsigned int preconditioner_builds = 0;
    /// Of the last displacement, where the exact one is known.
    std::optional<ErrorNorms> errors;
    /// Largest angle between rotations inside of cells and those of their
    /// centres [rad], of the last displacement, where only the latter are used.
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

    /// The initial state: step 0.
    virtual void
    start(const Snapshot & /*initial*/)
    {}

    /// What an observer needs to go on after a restart: goes into checkpoints.
    virtual void
    transfer(Archive & /*archive*/)
    {}

    /// In place of start() after a restart, when transfer() has read: what the
    /// run has written after the checkpoint does not count.
    virtual void
    resume(const Snapshot & /*state*/)
    {}

    /// After every step that is recorded (see OutputTimes).
    virtual void
    step(const Snapshot & /*state*/)
    {}

    /// After a failure: the state of the last step, which step() has shown
    /// already, is the last of the run.
    virtual void
    save(const Snapshot & /*state*/)
    {}

    /// At the end, also after a failure.
    virtual void
    finish(const RunSummary & /*summary*/)
    {}
  };
} // namespace corotet

#endif
