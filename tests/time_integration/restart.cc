// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The data that integrators keep between steps, and the balance at the end of a
// step, on a scalar oscillator m a + c v + k u = p sin(w t).

#include <gtest/gtest.h>

#include <cmath>

#include "../integrators.h"
#include "../memory_archive.h"
#include "../oscillator.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // The start of a step; steps are unequal.
  double
  start_of(const unsigned int i)
  {
    return 0.1 * i + 0.003 * i * i;
  }

  // Makes the steps first ... end - 1.
  void
  make_steps(TimeIntegrator    &integrator,
             Oscillator        &system,
             State             &state,
             const unsigned int first,
             const unsigned int end)
  {
    for (unsigned int i = first; i < end; ++i)
      integrator.step(system,
                      {start_of(i),
                       start_of(i + 1) - start_of(i),
                       (i + 1.) / end},
                      state);
  }
} // namespace

// A restart: an object that gets the data of another one continues to the last
// bit as that would, whatever it did before.
TEST(TimeIntegrator, GoesOnWithWhatItKept)
{
  for (const std::string &name : integrators_with(is_dynamic))
    {
      Oscillator system;
      system.p                 = 5;
      State      state         = initial_state(system, 1., 0.5);
      const auto uninterrupted = make_integrator(name);
      const auto restarted     = make_integrator(name);
      uninterrupted->reset();
      make_steps(*uninterrupted, system, state, 0, 5);

      State other = initial_state(system, -2., 3.);
      restarted->reset();
      make_steps(*restarted, system, other, 0, 3);
      restarted->reset();
      MemoryArchive archive;
      uninterrupted->transfer(archive);
      archive.reading = true;
      restarted->transfer(archive);

      other = state;
      make_steps(*uninterrupted, system, state, 5, 9);
      make_steps(*restarted, system, other, 5, 9);
      EXPECT_EQ(other.u.local_element(0), state.u.local_element(0)) << name;
      EXPECT_EQ(other.v.local_element(0), state.v.local_element(0)) << name;
    }
}

// A step that was given up is tried again, at a time that differs by round-off,
// as the times of a run that goes on with another end time do.
TEST(TimeIntegrator, TriesAStepAgain)
{
  for (const std::string &name : integrators_with(is_dynamic))
    {
      const auto displacement = [&](const double shift) {
        Oscillator system;
        system.p              = 5;
        State      state      = initial_state(system, 1., 0.5);
        const auto integrator = make_integrator(name);
        integrator->reset();
        make_steps(*integrator, system, state, 0, 5);
        if (shift != 0)
          {
            State given_up = state;
            make_steps(*integrator, system, given_up, 5, 6);
          }
        const double t = start_of(5) * (1 + shift);
        integrator->step(system, {t, start_of(6) - t, 1.}, state);
        return state.u.local_element(0);
      };
      const double expected = displacement(0);
      for (const double shift : {-3e-16, 3e-16})
        EXPECT_NEAR(displacement(shift), expected, 1e-13) << name;
    }
}

// With integrators that promise it the equation of motion holds at the end of a
// step up to round-off, which the formulas for accelerations divide by the
// square of the step; with others it holds in between, and at the end up to
// terms of first order in the step.
TEST(TimeIntegrator, BalanceAtEnd)
{
  for (const std::string &name : integrators_with(is_dynamic))
    {
      Oscillator system;
      system.p              = 5;
      State      state      = initial_state(system, 1., 0.5);
      const auto integrator = make_integrator(name);
      integrator->reset();
      const double dt = 0.05;
      for (unsigned int i = 0; i < 20; ++i)
        integrator->step(system, {i * dt, dt, (i + 1) / 20.}, state);
      const double residual =
        std::abs(system.m * state.a.local_element(0) +
                 system.k * state.u.local_element(0) - system.load(20 * dt));
      if (integrator->balances_at_end())
        EXPECT_LE(residual, 1e-15 * system.m / (dt * dt) * 10) << name;
      else
        EXPECT_GE(residual, 1e-3) << name;
    }
}
