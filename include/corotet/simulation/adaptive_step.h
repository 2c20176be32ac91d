// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_adaptive_step_h
#define corotet_simulation_adaptive_step_h

#include <corotet/base/archive.h>

#include <deal.II/base/parameter_handler.h>

namespace corotet
{
  /**
   * The parameters of section Time integration/Adaptive step.
   */
  struct AdaptiveStepParameters
  {
    void
    declare_parameters(dealii::ParameterHandler &prm);

    /// Throws InputError if the entries contradict each other.
    void
    check() const;

    bool   enabled       = false;
    double target_error  = 1e-4;
    double smallest_step = 0;
    double largest_step  = 0;
  };

  /**
   * Chooses the length of time steps by the estimated local error of the
   * displacement [Zienkiewicz and Xie, A simple error estimator and adaptive
   * time stepping procedure for dynamic analysis, 1991]: its root mean square
   * over the body is to be below the target error times the largest root mean
   * square of the displacement so far. The local error is of third order.
   */
  class AdaptiveStep
  {
  public:
    /// @p duration is that of the run [s], which scales the round-off of times.
    AdaptiveStep(const AdaptiveStepParameters &parameters,
                 const double                  first_step,
                 const double                  duration);

    /// Length of the next step [s].
    double
    length() const
    {
      return dt;
    }

    /**
     * Judges a step of length @p taken with the local error @p error that led
     * to a displacement of size @p size [m]: whether it is good enough, or
     * cannot be shorter. Sets the length of the next one.
     */
    bool
    accept(const double taken, const double error, const double size);

    /// Halves the step after one of length @p taken that could not be made.
    /// Returns whether that is allowed.
    bool
    reduce(const double taken);

    /// Steps that were not accepted.
    unsigned int
    n_rejected() const
    {
      return rejected;
    }

    /// Steps that were accepted because they could not be shorter.
    unsigned int
    n_too_inaccurate() const
    {
      return too_inaccurate;
    }

    /// Transfers the data that decide the next steps.
    void
    transfer(Archive &archive);

  private:
    void
    set_length(const double wanted);
    /// Takes note that the length has become shorter.
    void
    take_note_of_shorter_step();

    const AdaptiveStepParameters &parameters;
    double                        smallest;
    /// The longest step that still counts as a smallest one: times are rounded,
    /// and the last steps before a result are longer by up to 1e-10.
    double smallest_taken;
    double largest;
    double dt;
    double largest_size = 0;
    /// Accepted steps since the last change of the length, and the number of
    /// them that a longer step has to wait for.
    unsigned int since_change = 0;
    unsigned int pause        = 0;
    /// Whether the last change was a longer step.
    bool         has_grown      = false;
    unsigned int rejected       = 0;
    unsigned int too_inaccurate = 0;
  };
} // namespace corotet

#endif
