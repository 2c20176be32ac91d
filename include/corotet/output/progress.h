// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_progress_h
#define corotet_output_progress_h

#include <corotet/base/log.h>
#include <corotet/simulation/observer.h>

#include <chrono>
#include <string>

namespace corotet
{
  /**
   * The text of a Progress about a step: step, time, completed share of the run
   * from @p start_time to @p end_time, rounded down, time left, Newton and
   * linear iterations. @p seconds_left is left out if it is negative.
   */
  std::string
  progress_text(const StepRecord &record,
                const double      start_time,
                const double      end_time,
                const double      seconds_left);

  /**
   * Shows the progress of a run. Every step replaces the progress line of a
   * terminal.
   *
   * Permanent lines (on the terminal, in a file or pipe, and in log.txt) are
   * written for the first and the last step, and between them at most every 2
   * seconds, when another per cent of the run is done or a minute has passed.
   * So a long run leaves some hundred lines, however many steps it has.
   */
  class Progress : public Observer
  {
  public:
    /// Shows a run from @p run_start to @p end_time [s]. @p log must outlive
    /// this object.
    Progress(const double run_start, const double end_time, Log &log);

    void
    start(const Snapshot &initial) override;

    void
    resume(const Snapshot &state) override
    {
      start(state);
    }

    void
    step(const Snapshot &state) override;

  private:
    using Clock = std::chrono::steady_clock;

    double run_start;
    double end_time;
    Log   &log;

    /// The start of this part of the run, perhaps at a checkpoint, and the
    /// simulated time [s] there.
    Clock::time_point begin;
    double            start_time = 0;

    /// The wall time when the last permanent line was written, and its
    /// simulated time [s].
    Clock::time_point line_written;
    double            line_time  = 0;
    bool              first_step = true;
  };
} // namespace corotet

#endif
