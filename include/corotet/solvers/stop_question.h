// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_stop_question_h
#define corotet_solvers_stop_question_h

#include <corotet/base/exceptions.h>
#include <corotet/base/vector.h>

#include <functional>
#include <utility>

namespace corotet
{
  /**
   * Whether a solve is to be given up. Each rank is asked, and one that says
   * yes is enough. Its answers go along with sums that a method takes anyway.
   */
  class StopQuestion
  {
  public:
    /// Nobody wants to stop.
    StopQuestion() = default;

    /// @p wants_to_stop may say different things on different ranks; empty: no.
    explicit StopQuestion(std::function<bool()> wants_to_stop)
      : wants_to_stop(std::move(wants_to_stop))
    {}

    /// What this rank adds to a sum over all ranks.
    double
    share() const
    {
      return wants_to_stop && wants_to_stop() ? 1. : 0.;
    }

    /// Throws StepInterrupted if @p sum, of all shares, says so.
    static void
    obey(const double sum)
    {
      if (sum > 0)
        throw StepInterrupted();
    }

    /// Takes the sum and obeys. Does nothing if nobody is to be asked, which
    /// must be so on all ranks or on none. Collective.
    void
    ask(const MPI_Comm comm) const
    {
      if (!wants_to_stop)
        return;
      double sum = share();
      sum_over_ranks({&sum, 1}, comm);
      obey(sum);
    }

  private:
    std::function<bool()> wants_to_stop;
  };
} // namespace corotet

#endif
