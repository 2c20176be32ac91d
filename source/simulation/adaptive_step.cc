// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/simulation/adaptive_step.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  void
  AdaptiveStepParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    prm.add_parameter("Enabled",
                      enabled,
                      "Whether the length of time steps follows from the error "
                      "that they make; for HHT-alpha, generalized-alpha, and "
                      "Newmark with gamma = 0.5 and beta >= 0.25. Steps end at "
                      "all multiples of 'Output/Time between results'.");
    prm.add_parameter(
      "Target error",
      target_error,
      "Largest error of the displacement that a step may make, relative to the "
      "largest displacement so far (of a body that nothing holds, without its "
      "translation), both as root mean squares over the body [-]. A step with a "
      "larger error is repeated with a shorter length. "
      "(Smaller targets than are allowed could not be told from the errors "
      "that Newton's method and round-off leave.)",
      Double(1e-12, 1));
    prm.add_parameter("Smallest step",
                      smallest_step,
                      "Length of the shortest steps [s], which are accepted "
                      "whatever error they make. 0: a millionth of 'Time "
                      "step', or of 'Largest step' if that is shorter.",
                      Double(0));
    prm.add_parameter("Largest step",
                      largest_step,
                      "Length of the longest steps [s]. 0: no limit. Steps may "
                      "miss a load pulse that is shorter than they are.",
                      Double(0));
  }

  void
  AdaptiveStepParameters::check() const
  {
    if (largest_step > 0 && smallest_step > largest_step)
      throw InputError("Time integration/Adaptive step/Smallest step",
                       fmt::format("found {}; allowed: at most the largest "
                                   "step, {}",
                                   smallest_step,
                                   largest_step));
  }

  AdaptiveStep::AdaptiveStep(const AdaptiveStepParameters &parameters,
                             const double                  first_step,
                             const double                  duration)
    : parameters(parameters)
  {
    largest  = parameters.largest_step > 0 ?
                 parameters.largest_step :
                 std::numeric_limits<double>::infinity();
    smallest = parameters.smallest_step > 0 ?
                 parameters.smallest_step :
                 1e-6 * std::min(first_step, largest);
    // Both ends of a step are rounded sums.
    const double round_off =
      4 * std::numeric_limits<double>::epsilon() * duration;
    smallest_taken =
      smallest * (1 + 1e-9) + std::min(round_off, 0.5 * smallest);
    set_length(first_step);
  }

  void
  AdaptiveStep::set_length(const double wanted)
  {
    dt = std::clamp(wanted, smallest, largest);
  }

  bool
  AdaptiveStep::accept(const double taken,
                       const double error,
                       const double size)
  {
    // A step that meets the target is longer by the cube root of this ratio;
    // the factor has a margin.
    const double scale = std::max(largest_size, size);
    const double ratio = error > 0 ? parameters.target_error * scale / error :
                                     std::numeric_limits<double>::infinity();
    // The ratio is not a number if the displacement is not finite.
    const bool   is_accurate = ratio >= 1;
    const double factor =
      ratio >= 0 ? std::clamp(0.9 * std::cbrt(ratio), 0.2, 2.) : 0.2;
    if (!is_accurate && taken > smallest_taken)
      {
        ++rejected;
        take_note_of_shorter_step();
        set_length(factor * taken);
        return false;
      }
    ++since_change;
    if (!is_accurate)
      ++too_inaccurate;
    largest_size = scale;
    // A step that was shortened to end at a result says nothing against the
    // length that was planned. Growth of a few percent is not worth a new
    // preconditioner.
    if (factor < 0.95)
      {
        take_note_of_shorter_step();
        set_length(factor * taken);
      }
    else if (factor > 1.2 && since_change > pause)
      {
        // A length that has held for long is no sign of hunting.
        if (has_grown || since_change > 4 * pause)
          pause /= 2;
        // After that, small changes disturb less.
        constexpr double careful = 1.25;
        has_grown                = true;
        since_change             = 0;
        set_length(
          std::max((pause > 0 ? std::min(factor, careful) : factor) * taken,
                   dt));
      }
    return true;
  }

  void
  AdaptiveStep::take_note_of_shorter_step()
  {
    // Each change of the length disturbs stiff modes, which takes some steps to
    // decay; meanwhile errors tell little. If a longer step leads to a shorter
    // one, the next attempt comes later.
    constexpr unsigned int shortest = 8, longest = 64;
    if (has_grown)
      pause = std::clamp(2 * pause, shortest, longest);
    has_grown    = false;
    since_change = 0;
  }

  bool
  AdaptiveStep::reduce(const double taken)
  {
    if (taken <= smallest_taken)
      return false;
    ++rejected;
    set_length(0.5 * taken);
    return true;
  }

  void
  AdaptiveStep::transfer(Archive &archive)
  {
    archive.transfer("length", dt);
    // The limits of the step may have changed.
    if (archive.is_reading())
      set_length(dt);
    archive.transfer("largest_size", largest_size);
    archive.transfer("since_change", since_change);
    archive.transfer("pause", pause);
    archive.transfer("has_grown", has_grown);
    archive.transfer("rejected", rejected);
    archive.transfer("too_inaccurate", too_inaccurate);
  }
} // namespace corotet
