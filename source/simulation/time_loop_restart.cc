// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// How a time loop goes on from a checkpoint.

#include <corotet/base/exceptions.h>
#include <corotet/simulation/time_loop.h>

#include <fmt/format.h>

namespace corotet
{
  void
  TimeLoop::resume(const OutputTimes &wanted,
                   Archive           &archive,
                   const StepRecord  &record)
  {
    check(wanted);
    recording = wanted;
    integrator->reset();
    system.equation().evaluate(present,
                               parameters.start_time,
                               integrator->load_factor(0.));
    budget =
      std::make_unique<EnergyBudget>(system.equation(),
                                     present,
                                     parameters.start_time,
                                     integrator->is_staggered() ? 1. : 0.);
    double end_time = 0, time_step = 0;
    archive.transfer("end_time", end_time);
    archive.transfer("time_step", time_step);
    const unsigned int n_equal = n_steps;
    const double       planned = step_length;
    transfer(archive);
    largest_energy = energy_supply;
    if (!is_between_records)
      {
        keep_state();
        good_done = done;
      }
    // In statics a change of the time step does not matter.
    if (end_time == parameters.end_time &&
        (time_step == parameters.time_step || !integrator->is_dynamic()))
      return;
    if (end_time != parameters.end_time)
      {
        if (!integrator->is_dynamic())
          throw InputError("Time integration/End time",
                           fmt::format("--restart: found {}; allowed in "
                                       "statics, whose load steps are parts of "
                                       "the run: {}, as before",
                                       parameters.end_time,
                                       end_time));
        const double t =
          parameters.start_time + done * (end_time - parameters.start_time);
        if (!(parameters.end_time > t))
          throw InputError("Time integration/End time",
                           fmt::format("--restart: found {}; allowed: a time "
                                       "after that of the checkpoint, {}",
                                       parameters.end_time,
                                       t));
        const double factor = (end_time - parameters.start_time) /
                              (parameters.end_time - parameters.start_time);
        done *= factor;
        good_done *= factor;
        from *= factor;
        if (start_of_left_step)
          *start_of_left_step *= factor;
      }
    // The rest of a step that was begun is replaced by other steps; the first
    // of them gets its number.
    if (!parts_left.empty())
      {
        parts_left.clear();
        --unrecorded.step;
        start_of_left_step = from;
      }
    // A run whose steps are all done needs no new step length.
    if (is_done())
      return;
    if (n_equal > 0)
      begin_equal_steps(step_number(record));
    else if (n_steps > 0)
      {
        n_steps     = 0;
        step_length = planned;
      }
    else
      return;
    // The stable step of the body in its present state is compared.
    if (integrator->stability() != nullptr)
      check_stable_step();
  }

  void
  TimeLoop::save(Archive &archive)
  {
    double end_time = parameters.end_time, time_step = parameters.time_step;
    archive.transfer("end_time", end_time);
    archive.transfer("time_step", time_step);
    transfer(archive);
  }

  void
  TimeLoop::transfer_parts(Archive &archive)
  {
    std::vector<double>       ends;
    std::vector<unsigned int> halvings;
    for (const Part &part : parts_left)
      {
        ends.push_back(part.to);
        halvings.push_back(part.halvings_left);
      }
    std::vector<double> left;
    if (start_of_left_step)
      left.push_back(*start_of_left_step);
    archive.transfer("parts_left", ends);
    archive.transfer("halvings_left", halvings);
    archive.transfer("start_of_left_step", left);
    start_of_left_step.reset();
    if (!left.empty())
      start_of_left_step = left.front();
    parts_left.clear();
    for (std::size_t i = 0; i < ends.size(); ++i)
      parts_left.push_back({ends[i], halvings.at(i)});
  }

  void
  TimeLoop::transfer(Archive &archive)
  {
    archive.transfer("done", done);
    archive.transfer("n_steps", n_steps);
    archive.transfer("first_step", first_step);
    archive.transfer("first_done", first_done);
    archive.transfer("step_length", step_length);
    archive.transfer("energy_supply", energy_supply);
    archive.transfer("worst_balance", worst_balance);
    archive.transfer("amplification", amplification);
    archive.transfer("has_warned", has_warned);
    archive.within("state", [&] { present.transfer(archive); });
    if (adaptive)
      archive.within("adaptive_step", [&] { adaptive->transfer(archive); });
    archive.within("integrator", [&] { integrator->transfer(archive); });
    archive.within("budget", [&] { budget->transfer(archive); });
    archive.transfer("is_between_records", is_between_records);
    if (is_between_records)
      {
        archive.within("unrecorded", [&] { unrecorded.transfer(archive); });
        archive.transfer("good_done", good_done);
        archive.transfer("from", from);
        transfer_parts(archive);
        // Other methods keep a state at each step.
        if (integrator->is_explicit())
          archive.within("good_state", [&] { good_state.transfer(archive); });
      }
  }
} // namespace corotet
