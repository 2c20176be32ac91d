// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_time_loop_h
#define corotet_simulation_time_loop_h

#include <corotet/base/log.h>
#include <corotet/simulation/adaptive_step.h>
#include <corotet/simulation/energy_budget.h>
#include <corotet/simulation/size_of_motion.h>
#include <corotet/simulation/structural_system.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace corotet
{
  /**
   * Which steps are shown to observers, beside the last one.
   */
  struct OutputTimes
  {
    /// The number of steps from one that is shown to the next one.
    unsigned int steps_between_rows = 1;
    /// Steps that reach a multiple of this time [s] are shown, too, if it is
    /// not zero. Where the run chooses the length of its steps they end there
    /// exactly.
    double time_between_results = 0;
  };

  /**
   * Questions whether a run is to do something else than steps. One that is
   * empty says no.
   */
  struct Interruption
  {
    /// Asked after steps, and after the parts of one that is made in parts. It
    /// says the same on all ranks.
    std::function<bool()> after_step;
    /// Asked while systems are solved: if a rank says yes, the step or the part
    /// that is being made is given up.
    std::function<bool()> within_step;
  };

  /**
   * Moves the body from step to step, from the start time to the end time:
   * in equal steps, by their error, or by stability, as the parameters say.
   * Steps that fail are made in halves.
   *
   * The arguments of the constructor must outlive this object. Members are
   * collective.
   */
  class TimeLoop
  {
  public:
    /// Throws InputError.
    TimeLoop(const SimulationParameters &parameters,
             StructuralSystem           &system,
             Log                        &log);

    /// Throws InputError if these times make too many steps, as start() and
    /// resume() do.
    void
    check(const OutputTimes &wanted) const;

    /// Makes the initial state complete. Returns its record.
    const StepRecord &
    start(const OutputTimes &wanted);

    /**
     * In place of start(): takes all that the steps to come depend on from
     * @p archive. The end time and the time step may differ from those of the
     * run that wrote it: equal steps begin anew then. @p record is that of the
     * last recorded step. Throws InputError if the end time does not fit.
     */
    void
    resume(const OutputTimes &wanted,
           Archive           &archive,
           const StepRecord  &record);

    /// Saves what resume() takes.
    void
    save(Archive &archive);

    /**
     * Goes on to the next step that is to be recorded, or to an earlier state
     * if @p interruption, which is asked after each step (or after some, if
     * they are made together), says so; then it returns false. @p record, that
     * of the last one, becomes its record, but for the wall time. Throws
     * ComputationError; then record, state and time are the last good ones, and
     * has_new_record() says whether @p record has changed.
     */
    bool
    next(StepRecord &record, const Interruption &interruption = {});

    bool
    is_done() const
    {
      return done == 1;
    }

    /// Whether a call of next() that threw has left a record of a later state
    /// than the one it got.
    bool
    has_new_record() const
    {
      return is_new;
    }

    /// Whether that is the record of a part of a step that then failed.
    bool
    has_partial_step() const
    {
      return is_partial;
    }

    /// A step that has failed, and the time at its start [s]; step 0: none.
    struct Failure
    {
      unsigned int step;
      double       time;
    };

    /// The last failure of explicit steps, which return to an earlier state.
    Failure
    last_failure() const
    {
      return failure;
    }

    /// What supports did in the last step that has a record.
    const std::vector<SupportForce> &
    support_forces() const
    {
      return budget->support_forces();
    }

    /// The number of the last step; @p record is that of the last recorded one.
    unsigned int
    step_number(const StepRecord &record) const
    {
      return is_between_records ? unrecorded.step : record.step;
    }

    /// Parts of that step that are made, if others are not; else 0.
    unsigned int
    parts_made() const
    {
      return parts_left.empty() ? 0 : unrecorded.parts;
    }

    /// The end of the first step [s].
    double
    first_time() const
    {
      return time(end_of_step(1));
    }

    /// The number of steps that the run will have, as far as it is known at the
    /// start [-].
    double
    planned_steps() const
    {
      return n_planned;
    }

    /// The time of the present state [s].
    double
    time() const
    {
      return time(done);
    }

    const State &
    state() const
    {
      return present;
    }

  private:
    void
    transfer(Archive &archive);
    void
    transfer_parts(Archive &archive);
    /// Divides the rest of the run, from step @p step on, into equal steps.
    /// Throws InputError.
    void
    begin_equal_steps(const unsigned int step);
    /// These throw InputError.
    void
    check_parameters() const;
    void
    choose_step();
    AccelerationSolver::LargestFrequencies
    largest_frequencies();
    /// Estimates the stable step, and takes it or compares the given one with
    /// it. Throws ComputationError.
    void
    follow_stable_step();
    /// The same, but throws InputError.
    void
    check_stable_step();
    /// Whether the stable step is to be estimated again after step @p step.
    bool
    is_stable_step_due(const unsigned int step) const
    {
      const StabilityControl *control = integrator->stability();
      return control != nullptr && step % control->steps_between_estimates == 0;
    }
    /// Warns, once, if a run of @p n steps [-] of length @p dt [s] takes very
    /// long. The first call is that at the start.
    void
    warn_of_steps(const double n, const double dt);

    /// Time when the given part of the run, in [0, 1], is done. It is not a sum
    /// of steps, so no round-off accumulates. Decimal numbers are met exactly,
    /// so that a formula that changes at one of them does so in the same step
    /// whatever the end time is.
    double
    time(const double part) const;
    /// Duration of the given part of the run, a step or a halved one [s].
    double
    duration(const double part) const;
    /// Part of the run that is done after step @p step, @p ahead steps from
    /// now.
    double
    end_of_step(const unsigned int step, const unsigned int ahead = 1) const;
    /// Whether the step from part @p from to @p to of the run is to be
    /// recorded.
    bool
    is_recorded(const unsigned int step,
                const double       from,
                const double       to) const;

    /// @p record becomes that of a step of which no part is done.
    void
    begin_step(StepRecord &record);
    /// Logs remarks on a finished step.
    void
    report(const StepRecord &record) const;
    /// Warns if much energy was gained or lost up to @p record, unless the
    /// motion is unstable, which is an error.
    void
    warn_of_balance(const StepRecord &record) const;
    /// Makes the step of @p record, or what is left of it. Returns false if
    /// @p is_interrupted, which is asked after each part, ends that.
    bool
    advance(StepRecord &record, const std::function<bool()> &is_interrupted);
    /// Makes the next part of the step; if that fails, it is two parts from
    /// then on, each with one halving less.
    void
    make_part(StepRecord &record);
    /// Whether the load step that ended with @p error, at the present state,
    /// would meet the same matrix, which could not be solved with, if it were
    /// shorter: that of a linear problem, or of the state at its start. (The
    /// mass of dynamics, springs that depend on time and derivatives of loads
    /// make the matrix of a shorter step another one.)
    bool
    meets_same_matrix(const ComputationError &error) const;
    void
    announce_half(const double to, const ComputationError &error) const;
    /// Makes a step as long as its error allows.
    void
    advance_adaptively(StepRecord &record);
    /// SizeOfMotion of the present displacement.
    double
    size_of_motion();
    /// Solves for the acceleration that the run starts from: that at the start;
    /// with stiff damping the mean one of the first step, or of a part of it
    /// where that fails. Methods that keep energy always start from the former:
    /// the trapezoidal rule makes no displacement of what lasts for a short
    /// time, and its budget closes only if the equation holds at the start; the
    /// midpoint rule has no acceleration at the start. Throws ComputationError.
    StageReport
    solve_first_acceleration();
    bool
    starts_from_mean_acceleration() const
    {
      return !integrator->keeps_energy() &&
             system.equation().terms.has_stiff_damping();
    }
    /// Makes the budget of the state at the start.
    void
    begin_budget();
    /// The same for explicit methods: the change of the velocity in the first
    /// half step, divided by its length @p half [s].
    StageReport
    solve_first_half_step(const double half);
    /// Makes several steps.
    void
    advance_explicitly(StepRecord &record);

    /// These make the present state the good one, or restore it from that. The
    /// displacement of implicit methods is in the budget already.
    void
    keep_state();
    void
    restore_state();
    /// Solves for the part (from, to] in @p n steps, without accounting for it.
    void
    integrate(const double       from,
              const double       to,
              StepRecord        &record,
              const unsigned int n = 1);
    /// Adds the work of what integrate() has done to the budget.
    void
    account(const double       from,
            const double       to,
            StepRecord        &record,
            const unsigned int n = 1);
    /// Accounts for what integrate() has done and fills in the record of the
    /// present state, at which the next step begins. If that throws a
    /// ComputationError, all is as before but the state itself.
    void
    finish_step(const double from, const double to, StepRecord &record);
    /// Fills in the record of the present state.
    void
    complete(StepRecord &record);
    /// Throws ComputationError if energy has come out of nothing.
    void
    check_growth(const StepRecord &record);

    /// The largest number that the counter of steps holds.
    static constexpr unsigned int largest_number_of_steps = 4000000000;

    const SimulationParameters           &parameters;
    StructuralSystem                     &system;
    Body                                 &body;
    Log                                  &log;
    const std::unique_ptr<TimeIntegrator> integrator;
    OutputTimes                           recording;
    State                                 present;
    std::unique_ptr<EnergyBudget>         budget;
    /// Parts of the run, in [0, 1], at the present state and at the start of
    /// the last step.
    double done = 0;
    double from = 0;

    /// The state to return to when a step fails: the state before it, whose
    /// displacement the budget has; or with explicit methods, whose steps are
    /// many and cheap, that of the last record.
    State  good_state;
    double good_done = 0;

    /// Whether the motion has grown beyond bounds, which shorter steps cannot
    /// repair.
    bool is_unstable = false;

    /// Number of equal steps; 0 if the run chooses their length. They begin
    /// with step first_step, when the part first_done of the run is done: at
    /// the start, or where a run was restarted with other steps.
    unsigned int n_steps    = 0;
    unsigned int first_step = 0;
    double       first_done = 0;
    /// Length of the equal steps, or the stable one [s].
    double step_length = 0;
    /// Null if the length of steps does not follow their error.
    std::unique_ptr<AdaptiveStep>       adaptive;
    std::unique_ptr<const SizeOfMotion> the_size_of_motion;
    Vector                              acceleration_change;

    /// The record of the last step, if it was not to be recorded and next() was
    /// interrupted.
    StepRecord unrecorded;
    bool       is_between_records = false;

    /// A part of a step, with its end as a part of the run.
    struct Part
    {
      double       to;
      unsigned int halvings_left;
    };
    /// Parts that are left of a step that was begun, the next one last.
    std::vector<Part> parts_left;
    /// Start of the step that a restart with other steps replaces, as a part of
    /// the run.
    std::optional<double> start_of_left_step;

    bool is_new     = false;
    bool is_partial = false;
    /// See last_failure().
    Failure failure    = {0, 0.};
    bool    has_warned = false;
    double  n_planned  = 0;
    /// Largest energy that went into the body, at least its round-off [J].
    double energy_supply = 0;
    /// The energy balance that was farthest from zero so far [J], in explicit
    /// steps without moving supports.
    double worst_balance = 0;
    /// The largest ratio of the energy of the fastest mode in an explicit run
    /// to the energy put into it [-].
    double amplification = 1;
    /// Largest energy so far [J]; after a restart at least the supply.
    double largest_energy = 0;
  };
} // namespace corotet

#endif
