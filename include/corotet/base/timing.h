// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_timing_h
#define corotet_base_timing_h

#include <chrono>

namespace corotet
{
  /**
   * Adds the wall time [s] from its construction to its destruction to a sum.
   */
  class ScopedTimer
  {
  public:
    explicit ScopedTimer(double &sum)
      : sum(sum)
      , start(std::chrono::steady_clock::now())
    {}

    ~ScopedTimer()
    {
      sum +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count();
    }

    ScopedTimer(const ScopedTimer &) = delete;
    ScopedTimer &
    operator=(const ScopedTimer &) = delete;

  private:
    double                                     &sum;
    const std::chrono::steady_clock::time_point start;
  };

  /**
   * The wall time [s] of the parts of a run. Reading or making the mesh and
   * distributing it to the ranks are parts of the set-up.
   */
  struct WallTimes
  {
    double setup    = 0;
    double assembly = 0;
    double solve    = 0;
    double output   = 0;

    double read      = 0;
    double partition = 0;
  };
} // namespace corotet

#endif
