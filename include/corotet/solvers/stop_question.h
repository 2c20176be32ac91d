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
   * The question whether a solve is to be given up. Each rank is asked, and a
   * single yes is enough. The answers are added to sums that a method takes
   * anyway.
   */
  class StopQuestion
  {
  public:
    /// A question without anybody to ask: never stops.
    StopQuestion() = default;

    /// @p wants_to_stop may answer differently on different ranks; empty means
    /// no.
    explicit StopQuestion(std::function<bool()> wants_to_stop)
      : wants_to_stop(std::move(wants_to_stop))
    {}

    /// The summand of this rank in a sum over all ranks.
    double
    share() const
    {
      return wants_to_stop && wants_to_stop() ? 1. : 0.;
    }

    /// Throws StepInterrupted if @p sum, the sum of all shares, is positive.
    static void
    obey(const double sum)
    {
      if (sum > 0)
        throw StepInterrupted();
    }

    /// Asks, sums and obeys. Does nothing if nobody is to be asked, which must
    /// be so on all ranks or on none. Collective.
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
