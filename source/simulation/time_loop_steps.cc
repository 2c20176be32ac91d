// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The kinds of steps of a time loop: several explicit ones at once, steps that
// are halved if they fail, and adaptive ones.

#include <corotet/base/exceptions.h>
#include <corotet/simulation/time_loop.h>
#include <corotet/solvers/linear_solver_errors.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  namespace
  {
    // This limit ensures that a run that is to stop need not wait long.
    constexpr unsigned int most_steps_together = 1000;
  } // namespace

  void
  TimeLoop::keep_state()
  {
    if (integrator->is_explicit())
      good_state.u = present.u;
    good_state.v = present.v;
    good_state.a = present.a;
  }

  void
  TimeLoop::restore_state()
  {
    present.u =
      integrator->is_explicit() ? good_state.u : budget->last_displacement();
    present.v = good_state.v;
    present.a = good_state.a;
  }

  void
  TimeLoop::advance_explicitly(StepRecord &record)
  {
    // If many steps can be made at once, take all steps up to one that is
    // recorded or that is followed by an estimate of the stable step.
    unsigned int n  = 1;
    double       to = end_of_step(record.step);
    while (
      n < most_steps_together && system.acceleration_solver().can_step_many() &&
      !is_recorded(record.step, from, to) && !is_stable_step_due(record.step))
      {
        ++record.step;
        ++n;
        from = to;
        to   = end_of_step(record.step, n);
      }
    integrate(done, to, record, n);
    account(done, to, record, n);
    budget->end_step(present);
    if (is_recorded(record.step, from, done))
      {
        complete(record);
        check_growth(record);
        keep_state();
        good_done = done;
      }
  }

  bool
  TimeLoop::advance(StepRecord                  &record,
                    const std::function<bool()> &is_interrupted)
  {
    if (parts_left.empty())
      parts_left = {{end_of_step(record.step), parameters.max_halvings}};
    while (!parts_left.empty())
      {
        const unsigned int n_made = record.parts;
        make_part(record);
        if (record.parts > n_made && !parts_left.empty() && is_interrupted &&
            is_interrupted())
          return false;
      }
    return true;
  }

  void
  TimeLoop::make_part(StepRecord &record)
  {
    const auto [to, halvings_left] = parts_left.back();
    keep_state();
    try
      {
        const double start = done;
        integrate(start, to, record);
        finish_step(start, to, record);
        parts_left.pop_back();
      }
    catch (const ComputationError &error)
      {
        const double middle = 0.5 * (done + to);
        // In dynamics a half must be longer than the round-off of the time.
        const bool is_swallowed =
          integrator->is_dynamic() &&
          (time() >= time(middle) || time(middle) >= time(to));
        const bool is_final =
          is_unstable || meets_same_matrix(error) || is_swallowed;
        restore_state();
        if (halvings_left == 0 || is_final)
          {
            if (parameters.max_halvings == 0 || is_final)
              throw;
            throw ComputationError(
              fmt::format("{}; the step has been halved {} times",
                          error.what(),
                          parameters.max_halvings));
          }
        announce_half(to, error);
        parts_left.back().halvings_left = halvings_left - 1;
        parts_left.push_back({middle, halvings_left - 1});
      }
  }

  bool
  TimeLoop::meets_same_matrix(const ComputationError &error) const
  {
    if (dynamic_cast<const LinearSolverError *>(&error) == nullptr ||
        integrator->is_dynamic())
      return false;
    const EquationOfMotion &equation = system.equation();
    if (equation.terms.surface_matrix_depends_on_time() ||
        equation.terms.surface_matrix_depends_on_motion() ||
        equation.terms.has_linearization(Tangent::consistent))
      return false;
    Vector difference(present.u);
    difference -= budget->last_displacement();
    return equation.is_linear() || norm(difference) == 0;
  }

  void
  TimeLoop::announce_half(const double to, const ComputationError &error) const
  {
    log.line(fmt::format("t = {:.6g}: {}; trying half the step",
                         time(to),
                         error.what()));
  }

  double
  TimeLoop::size_of_motion()
  {
    if (!the_size_of_motion)
      {
        const auto springs =
          system.equation().terms.springs(body.reference,
                                          parameters.start_time);
        the_size_of_motion =
          std::make_unique<const SizeOfMotion>(body, springs.get());
      }
    return (*the_size_of_motion)(present.u);
  }

  void
  TimeLoop::advance_adaptively(StepRecord &record)
  {
    const double duration = parameters.end_time - parameters.start_time;
    keep_state();
    // The end of the shortest of the steps that were rejected.
    double rejected = std::numeric_limits<double>::infinity();
    for (;;)
      {
        const double to = end_of_step(record.step);
        const double dt = (to - done) * duration;
        // Half of one unit of round-off may be rounded to that unit again.
        if (!(to > done && to < rejected))
          throw ComputationError(
            fmt::format("found a step of {:.6g} s, which round-off of the time "
                        "swallows",
                        adaptive->length()));
        const AdaptiveStep known = *adaptive;
        try
          {
            integrate(done, to, record);
            acceleration_change = present.a;
            acceleration_change -= good_state.a;
            const double error = integrator->error_constant() * dt * dt *
                                 body.root_mean_square(acceleration_change);
            if (adaptive->accept(dt, error, size_of_motion()))
              {
                finish_step(done, to, record);
                record.rejected_steps = adaptive->n_rejected();
                return;
              }
          }
        catch (const ComputationError &error)
          {
            // The step may have failed after the error control accepted it.
            adaptive = std::make_unique<AdaptiveStep>(known);
            if (is_unstable || !adaptive->reduce(dt))
              {
                restore_state();
                throw;
              }
            announce_half(to, error);
          }
        rejected = to;
        restore_state();
        if (done == 0 && starts_from_mean_acceleration())
          {
            // The mean acceleration is that of a first step of this length.
            solve_first_acceleration();
            begin_budget();
            keep_state();
          }
        warn_of_steps(record.step + (1 - done) * duration / adaptive->length(),
                      adaptive->length());
      }
  }

  void
  TimeLoop::integrate(const double       from,
                      const double       to,
                      StepRecord        &record,
                      const unsigned int n)
  {
    TimeStep first = {time(from), duration((to - from) / n), to};
    if (n == 1)
      first.end = time(to);
    StageReport report;
    try
      {
        report = integrator->steps(system, first, n, present);
      }
    // The values of supports were tried only at some times before the start.
    catch (const InputError &error)
      {
        throw ComputationError((error.entry.empty() ? "" : error.entry + ": ") +
                               error.what());
      }
    record.newton_iterations += report.newton_iterations;
    record.linear_iterations += report.linear_iterations;
  }

  void
  TimeLoop::account(const double       from,
                    const double       to,
                    StepRecord        &record,
                    const unsigned int n)
  {
    const double dt = duration((to - from) / n);
    budget->add_work(present, time(to), dt);
    done = to;
    record.dt += dt;
    ++record.parts;
  }

  void
  TimeLoop::finish_step(const double from, const double to, StepRecord &record)
  {
    StepRecord finished = record;
    account(from, to, finished);
    try
      {
        complete(finished);
        if (integrator->is_dynamic())
          check_growth(finished);
      }
    catch (const ComputationError &)
      {
        budget->take_back();
        done = from;
        throw;
      }
    budget->end_step(present);
    record = finished;
  }

  void
  TimeLoop::check_growth(const StepRecord &record)
  {
    // The limits are far above the errors of a stable step relative to the
    // energy supplied, and above the noise of a body at rest. Implicit steps
    // may be long, so their limit is larger.
    const double factor =
      integrator->is_explicit() ? std::max(100., 10 * amplification) : 1e4;
    const auto cause = [&] {
      return integrator->is_explicit() ?
               "the time step is too long, or what makes the body stiffer "
               "comes between two estimates of the stable step: let 'Time "
               "step', 'Steps between estimates' or 'Safety factor' be "
               "smaller" :
               "the time step is too long";
    };
    // The kinetic energy between steps may be negative if the motion is
    // unstable.
    const double energy =
      std::abs(record.kinetic_energy) + record.elastic_energy;
    const bool is_visible = record.max_displacement >
                            1e-3 * std::cbrt(budget->initial_record().volume);
    // Forces of programs that depend on the velocity may drive the body, and
    // so may friction on obstacles that move.
    const double driven = system.equation().terms.may_drive() ?
                            std::max(-record.dissipated_energy, 0.) :
                            0.;
    energy_supply       = std::max(energy_supply,
                             std::abs(record.external_work) + driven +
                               std::abs(budget->kinetic_energy_of_supports()));
    // Stable steps of methods that keep the energy lose none that is not
    // accounted for, unless supports move fast: an unstable motion may lose
    // more than there is.
    const double lost_energy =
      integrator->is_staggered() && body.motion.is_at_rest() ?
        -record.energy_balance :
        0.;
    constexpr double most_lost = 2;
    const bool has_lost = is_visible && lost_energy > most_lost * energy_supply;
    is_unstable = has_lost || (is_visible && energy > factor * energy_supply);
    // The work of follower pressures grows faster than the energy of an
    // unstable motion.
    constexpr double lost = 1e8;
    largest_energy =
      std::max(largest_energy, energy + std::abs(record.dissipated_energy));
    if (is_visible && std::abs(record.energy_balance) > lost * largest_energy)
      {
        is_unstable = true;
        throw ComputationError(fmt::format(
          "the motion is unstable: loads have done work of {:.3g} J, and the "
          "energy is {:.3g} J; {}",
          record.external_work,
          energy,
          cause()));
      }
    if (has_lost)
      throw ComputationError(fmt::format(
        "the motion is unstable: {:.3g} J have vanished, and {:.3g} J have "
        "been put in; {}",
        lost_energy,
        energy_supply,
        cause()));
    if (is_unstable)
      throw ComputationError(fmt::format(
        "the motion is unstable: the energy is {:.3g} J, and {:.3g} "
        "J have been put in; {}",
        energy,
        energy_supply,
        cause()));
    if (is_visible && integrator->is_staggered() && body.motion.is_at_rest() &&
        std::abs(record.energy_balance) > std::abs(worst_balance))
      worst_balance = record.energy_balance;
  }

  void
  TimeLoop::complete(StepRecord &record)
  {
    budget->record(record, present, time(done));
    record.clamped_cells =
      std::max(record.clamped_cells,
               system.implicit_solver().take_clamped_cells());
  }
} // namespace corotet
