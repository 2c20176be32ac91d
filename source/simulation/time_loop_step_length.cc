// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// How long steps are, and how many.

#include <corotet/base/exceptions.h>
#include <corotet/simulation/time_loop.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  void
  TimeLoop::check_parameters() const
  {
    const std::string section = "Time integration/";
    if (!(parameters.end_time > parameters.start_time))
      throw InputError(section + "End time",
                       fmt::format("found {}; allowed: a time after the start "
                                   "time {}",
                                   parameters.end_time,
                                   parameters.start_time));
    if (parameters.newton.linearly_implicit && !integrator->is_dynamic())
      throw InputError("Newton/Linearly implicit",
                       "found true; allowed with Time integration/Type = "
                       "static: false, as nothing would correct the error of "
                       "a load step");
    const auto has_stable_step = [](const TimeIntegrator &method) {
      return method.stability() != nullptr;
    };
    if (parameters.time_step == 0 && integrator->is_dynamic() &&
        !has_stable_step(*integrator))
      throw InputError(
        section + "Time step",
        fmt::format("found 0; allowed: a positive number (0, the program's "
                    "choice, with Type = {})",
                    parameters.time_integrator.names_of(has_stable_step)));
    parameters.adaptive_step.check();
    const auto estimates_error = [](const TimeIntegrator &method) {
      return method.error_constant() > 0 && !method.is_explicit();
    };
    if (parameters.adaptive_step.enabled && !estimates_error(*integrator))
      throw InputError(
        section + "Adaptive step/Enabled",
        fmt::format("found true; allowed with Type = {}, which estimate their "
                    "error (Newmark with gamma = 1/2 and beta of at least 1/4)",
                    parameters.time_integrator.names_of(estimates_error)));
  }

  void
  TimeLoop::choose_step()
  {
    const double duration = parameters.end_time - parameters.start_time;
    if (parameters.adaptive_step.enabled)
      {
        adaptive = std::make_unique<AdaptiveStep>(parameters.adaptive_step,
                                                  parameters.time_step,
                                                  duration);
        body.discretization.initialize_vector(acceleration_change);
        warn_of_steps(duration / adaptive->length(), adaptive->length());
      }
    else if (parameters.time_step > 0 || !integrator->is_dynamic())
      {
        begin_equal_steps(0);
      }
    if (integrator->stability() != nullptr)
      check_stable_step();
  }

  void
  TimeLoop::check_stable_step()
  {
    try
      {
        follow_stable_step();
      }
    catch (const ComputationError &error)
      {
        throw InputError("Time integration/Time step", error.what());
      }
  }

  void
  TimeLoop::begin_equal_steps(const unsigned int step)
  {
    const double duration = parameters.end_time - time(done);
    const double n        = integrator->n_steps(duration, parameters.time_step);
    if (!(n <= largest_number_of_steps - step))
      throw InputError("Time integration/Time step",
                       fmt::format("found {}, which makes {:.4g} steps "
                                   "from t = {} to {}; allowed: at most {} "
                                   "steps, so at least {:.6g}",
                                   parameters.time_step,
                                   n,
                                   time(done),
                                   parameters.end_time,
                                   largest_number_of_steps,
                                   duration / largest_number_of_steps));
    n_steps     = static_cast<unsigned int>(n);
    first_step  = step;
    first_done  = done;
    step_length = duration / n_steps;
    // Times have 16 digits, so that four are left for the length of a step.
    constexpr double least = 1e-12;
    const double     latest =
      std::max(std::abs(parameters.start_time), std::abs(parameters.end_time));
    if (!(step_length >= least * latest))
      throw InputError(
        "Time integration/Time step",
        fmt::format(
          "steps are lost in the round-off of times: found steps of "
          "{:g} s and times up to {:g} s; allowed are steps of {:.3g} "
          "s or more there",
          step_length,
          latest,
          least * latest));
    // Steps that are a little shorter than the given one are not worth a
    // message.
    constexpr double much = 0.5;
    if (integrator->is_dynamic() && step_length < much * parameters.time_step)
      log.line(fmt::format("steps of {:.6g} s: found 'Time step' = {:g}, and "
                           "{:.6g} s to the end time",
                           step_length,
                           parameters.time_step,
                           duration));
    warn_of_steps(n, step_length);
  }

  namespace
  {
    // The smallest distance of the squared step from the squared stable one,
    // relative to the latter: the accuracy with which that is known.
    constexpr double least_distance_from_limit = 1e-3;
  } // namespace

  AccelerationSolver::LargestFrequencies
  TimeLoop::largest_frequencies()
  {
    EquationOfMotion &equation = system.equation();
    equation.set_state(present);
    // The tangent of a state without finite energy has no eigenvalues.
    if (done > 0 &&
        !std::isfinite(body.elasticity.state(equation.displacement()).energy))
      throw ComputationError(fmt::format(
        "the energy is not finite{}; does the body become stiffer quickly? "
        "Then {} must be smaller",
        equation.why_not_finite(),
        n_steps > 0 ? "'Time step'" :
                      "'Steps between estimates' or 'Safety factor'"));
    return system.acceleration_solver().largest_frequencies(present,
                                                            time(done));
  }

  void
  TimeLoop::follow_stable_step()
  {
    const StabilityControl &control = *integrator->stability();
    const auto [omega, damped]      = largest_frequencies();
    // A step dt is stable if (dt omega)^2 + 2 alpha_K dt damped^2 is at most
    // the limit for one frequency, as the largest eigenvalue of the sum is no
    // larger than the sum of both. So the damping counts by the ratio of these
    // frequencies.
    const double ratio  = omega > 0 ? damped / omega : 1;
    const double stable = integrator->stable_step(
      omega,
      system.equation().terms.damping_shares().stiffness * ratio * ratio);
    // Close to the limit the energy of the fastest mode, computed by central
    // differences from two velocities, is larger by the factor 1 / (1 - r^2).
    const double r =
      n_steps == 0 ? control.safety_factor : step_length / stable;
    amplification =
      r <= 1 ? 1 / std::max(1 - r * r, least_distance_from_limit) : 1;
    if (n_steps == 0)
      {
        if (!std::isfinite(stable))
          throw ComputationError(
            "found 0, the stable step, which there is none of, as nothing "
            "that is free can swing; allowed is a number above 0");
        step_length = control.safety_factor * stable;
        if (done == 0)
          log.line(fmt::format("Stable step: {:.6g} s; steps of at most "
                               "{:.6g} s",
                               stable,
                               step_length));
        const double n = (1 - done) *
                         (parameters.end_time - parameters.start_time) /
                         step_length;
        if (!(n <= largest_number_of_steps))
          throw ComputationError(
            fmt::format("found {} and stable steps of {:.6g} s, which makes "
                        "{:.4g} steps from t = {:.6g} to {}; allowed: at most "
                        "{} steps",
                        parameters.time_step,
                        step_length,
                        n,
                        time(done),
                        parameters.end_time,
                        largest_number_of_steps));
        warn_of_steps(n, step_length);
        return;
      }
    if (step_length <= stable)
      return;
    const std::string text = fmt::format(
      "found a step of {:.6g} s at t = {:.6g}, which is unstable; allowed: up "
      "to the stable step, {:.6g} s{}, or 0 for the program's choice",
      step_length,
      time(done),
      stable,
      done == 0 ? "" : " now that the body has deformed");
    if (control.refuse)
      throw ComputationError(text);
    log.warning(text);
  }

  void
  TimeLoop::warn_of_steps(const double n_of_length, const double length)
  {
    double n = n_of_length, dt = length;
    // Steps whose length the run chooses also end at results.
    const double interval = recording.time_between_results;
    if (n_steps == 0 && interval > 0 && interval < length)
      {
        const double left =
          (1 - done) * (parameters.end_time - parameters.start_time);
        n += left / interval - left / length;
        dt = interval;
      }
    constexpr double many = 1e7;
    if (n_planned == 0)
      n_planned = n;
    if (!(n > many) || has_warned)
      return;
    has_warned = true;
    log.warning(fmt::format(
      "steps of {:.6g} s: {:.3g} of them up to the end time", dt, n));
  }

  double
  TimeLoop::time(const double part) const
  {
    const double start = parameters.start_time;
    const double time  = start + part * (parameters.end_time - start);
    const double latest =
      std::max(std::abs(start), std::abs(parameters.end_time));
    // A time is decimal if it has at most this number of digits, up to the
    // round-off of three operations.
    constexpr int    n_digits  = 12;
    constexpr double round_off = 4 * std::numeric_limits<double>::epsilon();
    // Powers of ten are exact up to this exponent.
    constexpr int most_places = 22;
    const double  places      = n_digits - 1 - std::floor(std::log10(latest));
    if (places < 0 || places > most_places)
      return time;
    const double unit    = std::pow(10., places);
    const double decimal = std::round(time * unit) / unit;
    // Adding zero removes the sign of a negative zero.
    return std::abs(decimal - time) <= round_off * latest ? decimal + 0. : time;
  }

  double
  TimeLoop::end_of_step(const unsigned int step, const unsigned int ahead) const
  {
    if (n_steps > 0)
      return first_done + (1 - first_done) *
                            (static_cast<double>(step - first_step) / n_steps);

    const double duration = parameters.end_time - parameters.start_time;
    const double interval = recording.time_between_results;
    const double now      = time(done);
    // A multiple counts as reached even if round-off has left it slightly
    // below.
    const double target =
      interval > 0 ?
        std::min((std::floor(now / interval + 1e-6) + 1) * interval,
                 parameters.end_time) :
        parameters.end_time;
    const double end = target >= parameters.end_time - 1e-6 * interval ?
                         1. :
                         (target - parameters.start_time) / duration;
    const double dt  = adaptive ? adaptive->length() : step_length;
    const double n   = std::ceil((end - done) * duration / dt * (1 - 1e-10));
    if (n <= ahead)
      return end;
    // Steps that stability limits are all equal; those that an error controls
    // keep their length, and none that is left over becomes very short.
    return adaptive && n > 2 ? done + dt / duration :
                               done + ahead * (end - done) / n;
  }

  double
  TimeLoop::duration(const double part) const
  {
    if (n_steps == 0)
      return part * (parameters.end_time - parameters.start_time);
    // The duration is the same number for each step, whatever round-off there
    // is in its ends, as matrices depend on it.
    return std::ldexp(
      step_length, std::lround(std::log2(part * n_steps / (1 - first_done))));
  }
} // namespace corotet
