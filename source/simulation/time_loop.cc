// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/simulation/time_loop.h>

#include <deal.II/base/scope_exit.h>

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace corotet
{
  TimeLoop::TimeLoop(const SimulationParameters &parameters,
                     StructuralSystem           &system,
                     Log                        &log)
    : parameters(parameters)
    , system(system)
    , body(system.equation().body)
    , log(log)
    , integrator(parameters.time_integrator.make())
  {
    check_parameters();

    // Boundaries that contradict each other are found before the run starts.
    system.initialize(present);
    State moved = present;
    for (const double part : {0., 0.5, 1.})
      system.prescribe(moved, time(part), 1.);
    choose_step();
  }

  bool
  TimeLoop::is_recorded(const unsigned int step,
                        const double       from,
                        const double       to) const
  {
    const double interval = recording.time_between_results;
    const auto   results  = [&](const double part) {
      return std::floor(time(part) / interval + 1e-6);
    };
    return step % recording.steps_between_rows == 0 || to == 1 ||
           (interval > 0 && results(to) > results(from));
  }

  StageReport
  TimeLoop::solve_first_half_step(const double half)
  {
    // Damping is strong if it takes more than this part of a velocity in the
    // half step. The error of explicit damping is the square of this part, so a
    // hundredth.
    constexpr double  strong     = 0.1;
    const double      start_time = parameters.start_time;
    const StageReport report = system.solve_acceleration(present, start_time);
    if (!system.equation().terms.has_damping())
      return report;
    // The implicit acceleration has the damping of the velocity at the end of
    // the half step, as later steps do. If damping is weak, both accelerations
    // differ by its part of the velocity. If it is strong, the explicit one
    // would reverse the velocity and make it grow.
    const State exact = present;
    for (const unsigned int i : body.motion.unknowns())
      present.v.local_element(i) += half * present.a.local_element(i);
    const StageReport implicit =
      system.solve_acceleration(present, start_time, half);
    present.v         = exact.v;
    Vector difference = present.a;
    difference -= exact.a;
    if (body.root_mean_square(difference) >
        strong * body.root_mean_square(present.a))
      return implicit;
    return system.solve_acceleration(present, start_time);
  }

  StageReport
  TimeLoop::solve_first_acceleration()
  {
    const double start_time = parameters.start_time;
    double       dt         = duration(end_of_step(1));
    if (integrator->is_explicit())
      return solve_first_half_step(0.5 * dt);
    if (!starts_from_mean_acceleration())
      return system.solve_acceleration(present, start_time);

    for (unsigned int halvings = 0;; ++halvings, dt *= 0.5)
      try
        {
          return system.solve_mean_acceleration(present, start_time, dt);
        }
      catch (const ComputationError &)
        {
          if (halvings == parameters.max_halvings)
            return system.solve_acceleration(present, start_time);
        }
  }

  void
  TimeLoop::begin_budget()
  {
    // Explicit methods have evaluated their first forces already.
    if (!integrator->is_explicit())
      system.equation().evaluate(present,
                                 parameters.start_time,
                                 integrator->load_factor(0.));
    budget = std::make_unique<EnergyBudget>(system.equation(),
                                            present,
                                            parameters.start_time,
                                            integrator->is_staggered() ?
                                              duration(end_of_step(1)) :
                                              0.);
  }

  void
  TimeLoop::check(const OutputTimes &wanted) const
  {
    const double interval = wanted.time_between_results;
    const double duration = parameters.end_time - parameters.start_time;
    if (n_steps > 0 || interval == 0 ||
        duration / interval <= largest_number_of_steps)
      return;
    throw InputError(
      "Output/Time between results",
      fmt::format("found {}, which makes {:.4g} steps from t = {} to {}, as "
                  "steps end at its multiples; allowed: at most {} steps, so "
                  "at least {:.6g}",
                  interval,
                  duration / interval,
                  parameters.start_time,
                  parameters.end_time,
                  largest_number_of_steps,
                  duration / largest_number_of_steps));
  }

  const StepRecord &
  TimeLoop::start(const OutputTimes &wanted)
  {
    check(wanted);
    recording               = wanted;
    const double start_time = parameters.start_time;
    if (const double interval = recording.time_between_results;
        n_steps == 0 && interval > 0)
      {
        // Steps end at results, so they may be shorter and more than planned.
        const double duration = parameters.end_time - start_time;
        const double length   = adaptive ? adaptive->length() : step_length;
        if (interval < length)
          log.line(fmt::format("Steps of at most {:.6g} s, as they end at "
                               "multiples of 'Output/Time between results'",
                               interval));
        n_planned = 0;
        warn_of_steps(duration / length, length);
      }
    integrator->reset();
    if (integrator->is_dynamic())
      {
        system.prescribe(present, start_time, 1.);
        const StageReport report = solve_first_acceleration();
        if (integrator->is_explicit() && !body.mass.is_lumped())
          log.line(fmt::format("Consistent mass: {} iterations of conjugate "
                               "gradients a step",
                               report.linear_iterations));
        if (integrator->is_explicit() &&
            system.equation().terms.has_other_velocity_forces())
          log.warning("forces that depend on the velocity get that of half a "
                      "step before: the steps are of first order");
        if (!std::isfinite(body.root_mean_square(present.a)))
          throw ComputationError("the forces at the start are not finite" +
                                 system.equation().why_not_finite());
        if (!integrator->is_explicit())
          system.acceleration_solver().release();
      }
    begin_budget();
    const StepRecord &record = budget->initial_record();
    // Round-off makes strains of up to 1e-10 in a body without loads that turns
    // or has turned; with less energy than theirs nothing is told. The kinetic
    // energy between steps may be negative.
    constexpr double strain  = 1e-10;
    double           modulus = 0;
    for (const auto &[region, material] : body.materials)
      modulus = std::max(modulus, material.lambda + 2 * material.mu);
    energy_supply = std::max(record.kinetic_energy + record.elastic_energy,
                             modulus * record.volume * strain * strain);
    keep_state();
    return record;
  }

  void
  TimeLoop::begin_step(StepRecord &record)
  {
    ++record.step;
    record.dt                = 0;
    record.parts             = 0;
    record.newton_iterations = 0;
    record.linear_iterations = 0;
    from = std::exchange(start_of_left_step, {}).value_or(done);
  }

  void
  TimeLoop::report(const StepRecord &record) const
  {
    if (record.parts > 1)
      {
        log.line(
          fmt::format("step {}: made in {} parts", record.step, record.parts));
        log.count("step made in parts", "steps made in parts");
      }
    if (is_done())
      warn_of_balance(record);
    if (is_done() && adaptive)
      {
        log.line(fmt::format("Adaptive step: repeated steps: {}",
                             adaptive->n_rejected()));
        if (adaptive->n_too_inaccurate() > 0)
          log.warning(
            fmt::format("{} steps are less accurate than \"Adaptive "
                        "step/Target error\": none may be shorter than "
                        "\"Smallest step\"",
                        adaptive->n_too_inaccurate()));
      }
  }

  void
  TimeLoop::warn_of_balance(const StepRecord &record) const
  {
    // In statics the balance is the error of the work between load steps.
    // Methods other than explicit ones may lose energy, and gain some for a
    // while.
    constexpr double much    = 0.1;
    const double     balance = std::abs(worst_balance) > record.energy_balance ?
                                 worst_balance :
                                 record.energy_balance;
    if (integrator->is_dynamic() && !is_unstable &&
        std::abs(balance) > much * energy_supply)
      log.warning(fmt::format(
        "energy_balance: {:.3g} J have {}, and {:.3g} J have been put in: "
        "shorter time steps{}, finer cells or Material/Rotation = "
        "quadrature points make such errors smaller",
        std::abs(balance),
        balance > 0 ? "come out of nothing" : "been lost",
        energy_supply,
        integrator->is_explicit() ? ", more estimates of the stable step" :
                                    ""));
  }

  bool
  TimeLoop::next(StepRecord &record, const Interruption &interruption)
  {
    StepRecord next = is_between_records ? unrecorded : record;
    // The record of the state that is left if a step fails.
    StepRecord good = integrator->is_explicit() ? record : next;
    if (!std::exchange(is_between_records, false))
      next.clamped_cells = 0;
    const auto stay = [&](const StepRecord &reached) {
      unrecorded         = reached;
      is_between_records = true;
      return false;
    };
    system.implicit_solver().ask(StopQuestion(interruption.within_step));
    const dealii::ScopeExit ask_no_more(
      [&] { system.implicit_solver().ask({}); });
    for (bool is_first = true; is_first || !is_recorded(next.step, from, done);
         is_first      = false)
      {
        if (!is_first && interruption.after_step && interruption.after_step())
          return stay(next);
        if (parts_left.empty())
          begin_step(next);
        try
          {
            if (next.step > largest_number_of_steps)
              throw ComputationError(
                fmt::format("found {} steps already; allowed are no more",
                            largest_number_of_steps));
            if (integrator->is_explicit())
              advance_explicitly(next);
            else if (adaptive)
              advance_adaptively(next);
            else if (!advance(next, interruption.after_step))
              return stay(next);
            if (!integrator->is_explicit() ||
                is_recorded(next.step, from, done))
              good = next;
            if (is_stable_step_due(next.step))
              follow_stable_step();
          }
        catch (const StepInterrupted &)
          {
            // The state that is left is the one at the start of a step or of a
            // part of it. A step that was halved stays so.
            restore_state();
            system.equation().set_state(present);
            if (next.parts > 0 || parts_left.size() > 1)
              return stay(next);
            parts_left.clear();
            if (good.step == record.step)
              good.clamped_cells = 0;
            // The step to come is again the rest of one that was left.
            if (from < done)
              start_of_left_step = from;
            return stay(good);
          }
        catch (const ComputationError &)
          {
            if (integrator->is_explicit())
              {
                failure = {next.step, time(from)};
                restore_state();
                done = good_done;
              }
            else if (!parts_left.empty() && next.parts > 0)
              {
                // A part of the step has been done.
                good       = next;
                is_partial = true;
              }
            parts_left.clear();
            is_new = good.step > record.step;
            record = good;
            warn_of_balance(record);
            throw;
          }
      }
    record = next;
    report(record);
    return true;
  }
} // namespace corotet
