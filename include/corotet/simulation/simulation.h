// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_simulation_h
#define corotet_simulation_simulation_h

#include <corotet/base/log.h>
#include <corotet/simulation/observer.h>
#include <corotet/simulation/structural_system.h>
#include <corotet/simulation/time_loop.h>

#include <chrono>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * A run from the mesh to the last step. The constructor makes and checks
   * everything that the parameters describe; run() computes.
   *
   * @p parameters, which have been read already, and @p log must outlive this
   * object; several objects may share them. Members are collective.
   */
  class Simulation
  {
  public:
    /// @p folder is that of the parameter file; relative names of mesh files
    /// begin there. Throws InputError.
    Simulation(const SimulationParameters &parameters,
               const std::string          &folder,
               const MPI_Comm              comm,
               Log                        &log);

    const Body &
    body() const
    {
      return the_body;
    }

    /// Displacement [m] and velocity [m/s] after the last step, with ghost
    /// entries.
    const Vector &
    displacement() const
    {
      return system.equation().displacement();
    }

    const Vector &
    velocity() const
    {
      return system.equation().velocity();
    }

    /// The obstacles that the body may touch.
    std::vector<std::shared_ptr<const Obstacle>>
    obstacles() const
    {
      return system.equation().terms.obstacle_shapes();
    }

    /// The boundaries on which springs and dashpots act.
    std::set<unsigned int>
    ground_boundaries() const
    {
      return system.equation().terms.ground_boundaries();
    }

    double
    start_time() const
    {
      return parameters.start_time;
    }

    double
    end_time() const
    {
      return parameters.end_time;
    }

    /// The number of steps that the run will have, as far as it is known at the
    /// start [-].
    double
    planned_steps() const
    {
      return stepper.planned_steps();
    }

    /**
     * Computes all steps and shows observers those that @p recording names. If
     * the computation fails, observers are told so before the ComputationError
     * goes on.
     */
    void
    run(const std::vector<std::unique_ptr<Observer>> &observers,
        const OutputTimes                            &recording = {});

    /// Throws InputError if a run with these times would have too many steps.
    void
    check(const OutputTimes &recording) const
    {
      stepper.check(recording);
    }

    /// Does what run() does step by step: start(), then step() until is_done()
    /// or as long as it is wanted, then finish(). The observers must live until
    /// then. After a ComputationError, which they are told of, nothing may
    /// follow.
    void
    start(const std::vector<std::unique_ptr<Observer>> &observers,
          const OutputTimes                            &recording = {});

    /**
     * In place of start(): goes on from the checkpoint in @p archive. The
     * parameters, but for those of time, solvers and output, must be those of
     * the run that wrote it. Throws InputError if the end time does not fit.
     */
    void
    resume(const std::vector<std::unique_ptr<Observer>> &observers,
           const OutputTimes                            &recording,
           Archive                                      &archive);

    /// Saves the state that resume() goes on from. May be called between the
    /// other members.
    void
    save_state(Archive &archive);

    /// Goes on to the next step that is to be recorded, or, if
    /// @p interruption says so, to an earlier state.
    void
    step(const Interruption &interruption = {});

    bool
    is_done() const
    {
      return stepper.is_done();
    }

    /// Tells the observers that the last step was the end of the run.
    void
    finish()
    {
      finish("done", "");
    }

    /// Tells the observers that the run ends before its end time; @p message
    /// says why.
    void
    stop(const std::string &message)
    {
      finish("stopped", message);
    }

    /// Number of the last step, recorded or not, and its time [s].
    unsigned int
    step_number() const
    {
      return stepper.step_number(last_record);
    }

    /// The number of parts of that step that are made, if others are not; else
    /// 0.
    unsigned int
    parts_made() const
    {
      return stepper.parts_made();
    }

    double
    time() const
    {
      return stepper.time();
    }

    /// The record of the last step that was recorded.
    const StepRecord &
    record() const
    {
      return last_record;
    }

    /// The state after the last step.
    const State &
    state() const
    {
      return stepper.state();
    }

  private:
    /// Warns of parts of the body that do not hang together.
    void
    look_for_parts();
    /// Throws InputError if supports leave the body a rigid motion, as parts
    /// without a support do.
    void
    check_supports();
    /// The springs of supports at the first time that is solved for; null if
    /// there are none. Throws InputError.
    std::unique_ptr<SurfaceMatrix>
    first_springs();
    /// Runs @p action. If that fails, observers are told so.
    void
    guarded(const std::function<void()> &action);
    void
    report_inversions();
    /// Shows the observers the last good state, as far as they have not seen
    /// it.
    void
    save();
    void
    finish(const std::string &status, const std::string &message);
    /// Errors of the last state, if the exact solution is known.
    std::optional<ErrorNorms>
    errors();
    /// The largest rotation difference in the last state [rad], if the law uses
    /// one rotation for each cell; logs it.
    std::optional<double>
    rotation_difference();
    /// Transfers everything but the state of the time loop.
    void
    transfer(Archive &archive);
    Snapshot
    snapshot(const bool last);
    /// The stress of the present displacement. It is made at the first call.
    StressField &
    present_stress();
    double
    seconds() const;

    const std::chrono::steady_clock::time_point started =
      std::chrono::steady_clock::now();

    const SimulationParameters &parameters;
    Log                        &log;
    WallTimes                   wall_times;
    Body                        the_body;
    StructuralSystem            system;
    TimeLoop                    stepper;
    StepRecord                  last_record;
    bool                        is_started = false;
    /// The wall time of the run before it was restarted [s].
    double earlier_seconds = 0;

    const std::vector<std::unique_ptr<Observer>> *observers = nullptr;

    std::unique_ptr<StressField> stress;
    bool                         stress_is_present = false;
    /// Whether a displacement of any record was not zero.
    bool has_moved = false;
    /// Numbers of cells in the last report of inversions.
    unsigned int reported_inverted   = 0;
    unsigned int reported_degenerate = 0;
    unsigned int reported_clamped    = 0;
  };
} // namespace corotet

#endif
