// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_time_integration_bdf2_h
#define corotet_time_integration_bdf2_h

#include <corotet/time_integration/time_integrator.h>

#include <limits>

namespace corotet
{
  /**
   * Backward differentiation formula of order 2, for u and for v, with the
   * equation of motion at the end of the step: v_1 = D u, a_1 = D v,
   *
   *   D y = ((1 + 2 w) y_1 - (1 + w)^2 y_0 + w^2 y_-1) / ((1 + w) dt),
   *
   * where w is the ratio of the step to the one before. The first step is one
   * of backward Euler. Unconditionally stable for equal steps on linear
   * problems; damps motion that the step does not resolve, less than backward
   * Euler does.
   */
  class BDF2 : public TimeIntegrator
  {
  public:
    void
    reset() override
    {
      present.clear();
      before.clear();
    }

    void
    transfer(Archive &archive) override
    {
      archive.within("present", [&] { present.transfer(archive); });
      archive.within("before", [&] { before.transfer(archive); });
    }

    StageReport
    step(SecondOrderSystem &system,
         const TimeStep    &step,
         State             &state) override;

    unsigned int
    order() const override
    {
      return 2;
    }

    unsigned int
    n_earlier_steps() const override
    {
      return 1;
    }

    bool
    balances_at_end() const override
    {
      return true;
    }

  private:
    /// Displacement and velocity at a time; the time is -infinity at first.
    struct Past
    {
      void
      clear()
      {
        time = -std::numeric_limits<double>::infinity();
        u.reinit(0);
        v.reinit(0);
      }

      void
      transfer(Archive &archive)
      {
        archive.transfer("time", time);
        archive.transfer("displacement", u);
        archive.transfer("velocity", v);
      }

      double time = -std::numeric_limits<double>::infinity();
      Vector u;
      Vector v;
    };

    /// Keeps the motion at the start of the step.
    void
    remember(const TimeStep &step, const State &state);

    /// The motion at the start of the step, and one step earlier.
    Past present, before;
  };
} // namespace corotet

#endif
