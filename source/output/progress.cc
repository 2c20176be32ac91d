// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/output/progress.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  namespace
  {
    // The text of a time: "0:01:15" for 75 s.
    std::string
    clock_text(const double seconds)
    {
      // Longer times, some 30 years, need no number, which might overflow.
      const long long s = std::llround(std::min(seconds, 1e9));
      return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
    }
  } // namespace

  std::string
  progress_text(const StepRecord &record,
                const double      start_time,
                const double      end_time,
                const double      seconds_left)
  {
    // Rounded down, as 100 % means the end; the factor keeps a share of 0.29
    // from becoming 28 % by round-off.
    const double share    = end_time > start_time ? (record.time - start_time) /
                                                   (end_time - start_time) :
                                                    1.;
    const double per_cent = std::floor(100 * share * (1 + 1e-9));
    // The text must be short, as the progress line has to fit into a terminal's
    // line.
    std::string text =
      fmt::format("step {}, time {:.4g} of {:.4g} s ({:.0f} %), Newton {}, "
                  "linear {}",
                  record.step,
                  record.time,
                  end_time,
                  per_cent,
                  record.newton_iterations,
                  record.linear_iterations);
    if (seconds_left >= 0)
      text += fmt::format(", {} left", clock_text(seconds_left));
    return text;
  }

  Progress::Progress(const double run_start, const double end_time, Log &log)
    : run_start(run_start)
    , end_time(end_time)
    , log(log)
  {}

  void
  Progress::start(const Snapshot &initial)
  {
    begin        = Clock::now();
    start_time   = initial.record.time;
    line_written = begin;
    line_time    = start_time;
  }

  void
  Progress::step(const Snapshot &state)
  {
    const double            time          = state.record.time;
    const Clock::time_point now           = Clock::now();
    const auto              seconds_since = [&](const Clock::time_point t) {
      return std::chrono::duration<double>(now - t).count();
    };
    double seconds_left = -1;
    if (!state.last && time > start_time)
      seconds_left =
        seconds_since(begin) * (end_time - time) / (time - start_time);
    const std::string text =
      progress_text(state.record, run_start, end_time, seconds_left);

    const double silence = seconds_since(line_written);
    const bool   due =
      silence >= 60 ||
      (silence >= 2 && time - line_time >= 0.01 * (end_time - start_time));
    if (first_step || state.last || due)
      {
        log.line(text);
        first_step   = false;
        line_written = now;
        line_time    = time;
      }
    else
      log.progress(text,
                   end_time > run_start ?
                     (time - run_start) / (end_time - run_start) :
                     -1);
  }
} // namespace corotet
