// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_joint_reduction_h
#define corotet_base_joint_reduction_h

#include <deal.II/base/tensor.h>

#include <mpi.h>

#include <vector>

namespace corotet
{
  /**
   * Sums, maxima and minima over all ranks of numbers that are known at the
   * same time, with one message for all of them: with many ranks the number of
   * messages counts and not their length.
   *
   * First register the numbers, the same ones on all ranks, which must live
   * until run(); run() replaces them by the results.
   */
  class JointReduction
  {
  public:
    void
    sum(double &value)
    {
      sums.push_back(&value);
    }

    void
    sum(dealii::Tensor<1, 3> &value)
    {
      for (unsigned int a = 0; a < 3; ++a)
        sums.push_back(&value[a]);
    }

    /// Registers a count to be summed; exact up to 2^53.
    void
    sum(unsigned int &value)
    {
      counts.push_back(&value);
    }

    /// Registers a number whose maximum is wanted; if values are not finite,
    /// the result is one of these.
    void
    max(double &value)
    {
      maxima.push_back(&value);
    }

    void
    min(double &value)
    {
      minima.push_back(&value);
    }

    /// Replaces all numbers by the results. Collective.
    void
    run(const MPI_Comm comm) const;

  private:
    std::vector<double *>       sums;
    std::vector<unsigned int *> counts;
    std::vector<double *>       maxima;
    std::vector<double *>       minima;
  };
} // namespace corotet

#endif
