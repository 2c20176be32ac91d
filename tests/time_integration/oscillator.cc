// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Integrators on a scalar oscillator m a + c v + k u = p sin(w t) with a known
// solution: measured orders, energy, numerical dissipation, prescribed motion.

#include "../oscillator.h"

#include <corotet/time_integration/backward_euler.h>
#include <corotet/time_integration/bdf2.h>
#include <corotet/time_integration/central_difference.h>
#include <corotet/time_integration/generalized_alpha.h>
#include <corotet/time_integration/hht_alpha.h>
#include <corotet/time_integration/implicit_midpoint.h>
#include <corotet/time_integration/load_stepping.h>
#include <corotet/time_integration/newmark.h>
#include <corotet/time_integration/time_integrators.h>

#include <gtest/gtest.h>

#include <cmath>

#include "../integrators.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // The state after @p n equal steps to @p end.
  State
  integrate(TimeIntegrator    &integrator,
            Oscillator        &system,
            State              state,
            const double       end,
            const unsigned int n)
  {
    integrator.reset();
    for (unsigned int i = 0; i < n; ++i)
      integrator.step(system, {i * end / n, end / n, (i + 1.) / n}, state);
    return state;
  }

  // The order for the undamped oscillator with natural frequency 2, driven at w
  // = 3: u = cos(2t) + b sin(2t) + p / (k - m w^2) sin(3t), u(0) = 1, v(0) = 0.
  double
  measured_order(TimeIntegrator &integrator)
  {
    Oscillator system;
    system.p               = 5;
    const double end       = 2;
    const double amplitude = system.p / (system.k - system.m * 9);
    const double exact     = std::cos(2 * end) -
                         1.5 * amplitude * std::sin(2 * end) +
                         amplitude * std::sin(3 * end);
    double error[2];
    for (const unsigned int i : {0, 1})
      error[i] = std::abs(
        integrate(
          integrator, system, initial_state(system, 1., 0.), end, 1000 << i)
          .u.local_element(0) -
        exact);
    return std::log2(error[0] / error[1]);
  }
} // namespace

TEST(Oscillator, Orders)
{
  BackwardEuler backward_euler;
  EXPECT_NEAR(measured_order(backward_euler), 1, 0.1);
  Newmark newmark;
  EXPECT_NEAR(measured_order(newmark), 2, 0.1);
  newmark.gamma = 0.6;
  newmark.beta  = 0.3025;
  EXPECT_NEAR(measured_order(newmark), 1, 0.1);
  for (const double rho : {0., 0.5, 0.8, 1.})
    {
      GeneralizedAlpha generalized_alpha;
      generalized_alpha.spectral_radius = rho;
      EXPECT_NEAR(measured_order(generalized_alpha), 2, 0.1) << rho;
    }
  for (const double alpha : {0., -0.1, -1. / 3})
    {
      HHTAlpha hht_alpha;
      hht_alpha.alpha = alpha;
      EXPECT_NEAR(measured_order(hht_alpha), 2, 0.1) << alpha;
    }
  BDF2 bdf2;
  EXPECT_NEAR(measured_order(bdf2), 2, 0.1);
  ImplicitMidpoint midpoint;
  EXPECT_NEAR(measured_order(midpoint), 2, 0.1);
  CentralDifference central_difference;
  EXPECT_NEAR(measured_order(central_difference), 2, 0.1);
}

// Every registered integrator has the order that it states.
TEST(Oscillator, EveryIntegratorHasItsOrder)
{
  for (const std::string &name : integrators_with(is_dynamic))
    {
      const auto integrator = make_integrator(name);
      EXPECT_NEAR(measured_order(*integrator), integrator->order(), 0.1)
        << name;
    }
}

// The stated properties of integrators depend on their parameters, by the
// textbook's formulas: gamma = 1/2 is of second order, the trapezoidal rule
// keeps energy, and only alpha_m = alpha_f = 0 balances at the end.
TEST(TimeIntegrator, PropertiesFollowParameters)
{
  Newmark newmark;
  EXPECT_EQ(newmark.order(), 2u);
  EXPECT_TRUE(newmark.keeps_energy());
  EXPECT_TRUE(newmark.balances_at_end());
  newmark.gamma = 0.6;
  newmark.beta  = 0.3025;
  EXPECT_EQ(newmark.order(), 1u);
  EXPECT_FALSE(newmark.keeps_energy());
  HHTAlpha hht_alpha;
  EXPECT_FALSE(hht_alpha.keeps_energy());
  EXPECT_FALSE(hht_alpha.balances_at_end());
  hht_alpha.alpha = 0;
  EXPECT_TRUE(hht_alpha.keeps_energy());
  EXPECT_TRUE(hht_alpha.balances_at_end());
  GeneralizedAlpha generalized_alpha;
  for (const double rho : {0., 0.3, 0.8, 1.})
    {
      generalized_alpha.spectral_radius = rho;
      EXPECT_EQ(generalized_alpha.order(), 2u) << rho;
      EXPECT_EQ(generalized_alpha.keeps_energy(), rho == 1) << rho;
      EXPECT_FALSE(generalized_alpha.balances_at_end());
    }
}

// After reset() a run equals that of a new integrator, to the last bit,
// whenever it starts and whatever was computed before.
TEST(TimeIntegrator, ResetForgetsEarlierSteps)
{
  const auto run = [](TimeIntegrator &integrator) {
    Oscillator system;
    State      state = initial_state(system, 0.3, -1.);
    integrator.reset();
    for (unsigned int i = 0; i < 5; ++i)
      integrator.step(system, {7 + 0.1 * i, 0.1, 0.2 * (i + 1)}, state);
    return std::make_pair(state.u.local_element(0), state.v.local_element(0));
  };
  for (const auto &candidate : time_integrators())
    {
      const auto used = candidate.make(), fresh = candidate.make();
      Oscillator system;
      integrate(*used, system, initial_state(system, 1., 2.), 1., 10);
      EXPECT_EQ(run(*used), run(*fresh)) << candidate.name;
    }
}

// Without loads and damping all integrators that promise it keep m v^2 + k u^2,
// to the round-off of 10,000 steps (those with staggered velocities keep
// another sum: see below).
TEST(Oscillator, EnergyIsKept)
{
  const auto energy_change = [](TimeIntegrator &integrator) {
    Oscillator  system;
    const State state = integrate(
      integrator, system, initial_state(system, 1., 2.), 1000., 10000);
    const double u = state.u.local_element(0), v = state.v.local_element(0);
    return (system.m * v * v + system.k * u * u) / (2 * 4. + 8.) - 1;
  };
  for (const std::string &name :
       integrators_with([](const TimeIntegrator &integrator) {
         return integrator.keeps_energy() && !integrator.is_staggered();
       }))
    EXPECT_NEAR(energy_change(*make_integrator(name)), 0, 1e-11) << name;
  HHTAlpha hht_alpha;
  hht_alpha.alpha = 0;
  EXPECT_NEAR(energy_change(hht_alpha), 0, 1e-11);
  GeneralizedAlpha generalized_alpha;
  generalized_alpha.spectral_radius = 1;
  EXPECT_NEAR(energy_change(generalized_alpha), 0, 1e-11);
}

// For w dt < 2 the central difference method keeps m v^2 + k u^2 - dt^2 m a^2 /
// 4; above, the motion grows.
TEST(Oscillator, CentralDifference)
{
  CentralDifference integrator;
  Oscillator        system; // with the angular frequency 2
  EXPECT_NEAR(integrator.stable_step(2., 0.), 1, 1e-15);
  const auto energy = [&](const State &s, const double dt) {
    const double u = s.u.local_element(0), v = s.v.local_element(0),
                 a = s.a.local_element(0);
    return system.m * v * v + system.k * u * u -
           0.25 * dt * dt * system.m * a * a;
  };
  const State start = initial_state(system, 1., 2.);
  for (const double dt : {0.1, 0.9, 0.99})
    {
      const State end = integrate(integrator, system, start, 10000 * dt, 10000);
      // In this norm an error of u is multiplied by 1 / (1 - (w dt / 2)^2), up
      // to 50.
      EXPECT_NEAR(energy(end, dt) / energy(start, dt), 1, 1e-9) << dt;
    }
  const State grown = integrate(integrator, system, start, 1000 * 1.01, 1000);
  EXPECT_GT(std::abs(grown.u.local_element(0)), 1e3);
}

// Damping by mass, c = alpha m, is centred: the motion decays with second
// order, and the stable step remains.
TEST(Oscillator, CentralDifferenceWithDamping)
{
  CentralDifference integrator;
  Oscillator        system;
  system.c         = 0.4 * system.m;
  const double end = 2;
  const double w   = std::sqrt(4 - 0.04);
  const double exact =
    std::exp(-0.2 * end) * (std::cos(w * end) + 0.2 / w * std::sin(w * end));
  double error[2];
  for (const unsigned int i : {0, 1})
    error[i] = std::abs(
      integrate(
        integrator, system, initial_state(system, 1., 0.), end, 500 << i)
        .u.local_element(0) -
      exact);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.1);
  const State s = integrate(
    integrator, system, initial_state(system, 1., 0.), 0.99 * 1000, 1000);
  EXPECT_LE(std::abs(s.u.local_element(0)), 1e-10);
}

// BDF2 takes the ratio of unequal steps into account, also when a step is
// repeated with another length.
TEST(Oscillator, BDF2WithUnequalSteps)
{
  double error[2];
  for (const unsigned int i : {0, 1})
    {
      const unsigned int n = 200 << i;
      BDF2               integrator;
      Oscillator         system;
      State              state = initial_state(system, 1., 0.);
      double             time  = 0;
      for (unsigned int k = 0; k < n; ++k)
        {
          // Steps alternate between 2 / 3 and 4 / 3 of the mean.
          const double dt = 2. / n * (k % 2 == 0 ? 2. / 3 : 4. / 3);
          State        trial(state);
          integrator.step(system, {time, 1.7 * dt, 1.}, trial);
          integrator.step(system, {time, dt, 1.}, state);
          time += dt;
        }
      error[i] = std::abs(state.u.local_element(0) - std::cos(2 * time));
    }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.1);
}

// The estimate of the local error of u: that of one step that starts with the
// acceleration of the method. The exact motion starts from the same u and v.
TEST(Oscillator, ErrorEstimate)
{
  const auto names = integrators_with([](const TimeIntegrator &integrator) {
    return integrator.error_constant() > 0;
  });
  EXPECT_GE(names.size(), 3u);
  for (const std::string &name : names)
    {
      const auto   integrator = make_integrator(name);
      Oscillator   system;
      const double dt       = 1e-3;
      const auto   state_at = [&](const double t) {
        return initial_state(system,
                             std::cos(2 * t) + 0.5 * std::sin(2 * t),
                             -2 * std::sin(2 * t) + std::cos(2 * t));
      };
      // After some steps a_n belongs to the time that the method gives it.
      const unsigned int n = 100;
      State before = integrate(*integrator, system, state_at(0.), n * dt, n);
      State after  = before;
      integrator->step(system, {n * dt, dt, 1.}, after);
      const double estimate =
        integrator->error_constant() * dt * dt *
        std::abs(after.a.local_element(0) - before.a.local_element(0));
      // The exact motion from the same u and v.
      const double u = before.u.local_element(0), v = before.v.local_element(0);
      const double exact = u * std::cos(2 * dt) + 0.5 * v * std::sin(2 * dt);
      const double error = std::abs(after.u.local_element(0) - exact);
      // The estimate is the first term of a series in dt w = 2e-3.
      EXPECT_NEAR(estimate / error, 1, 2e-2) << name;
    }
}

// A motion far too fast for the step decreases by the spectral radius per step.
TEST(Oscillator, SpectralRadiusAtInfinity)
{
  for (const double rho : {0.3, 0.5, 0.9})
    {
      GeneralizedAlpha integrator;
      integrator.spectral_radius = rho;
      Oscillator system;
      system.k        = 1e12;
      const auto norm = [&](const unsigned int n) {
        const State s = integrate(
          integrator, system, initial_state(system, 1., 0.), 0.1 * n, n);
        return std::abs(s.u.local_element(0));
      };
      // The amplification matrix at infinity is defective: norms are powers of
      // rho times a polynomial. Over many steps only the rate matters.
      const double rate = std::pow(norm(200) / norm(100), 0.01);
      EXPECT_NEAR(rate, rho, 0.02 * rho) << rho;
    }
}

// The static equation k u = s p sin(w t): the load factor s grows in equal
// steps.
TEST(Oscillator, LoadStepping)
{
  LoadStepping integrator;
  // Time is only a parameter of the load.
  EXPECT_FALSE(integrator.is_dynamic());
  EXPECT_EQ(integrator.order(), 0u);
  Oscillator system;
  system.p    = 5;
  State state = initial_state(system, 0., 1.);
  integrator.step(system, {0.25, 0.25, 0.5}, state);
  EXPECT_NEAR(state.u.local_element(0),
              0.5 * system.load(0.5) / system.k,
              1e-15);
  EXPECT_EQ(state.v.local_element(0), 0.);
  integrator.proportional = false;
  integrator.step(system, {0.5, 0.25, 0.75}, state);
  EXPECT_NEAR(state.u.local_element(0), system.load(0.75) / system.k, 1e-15);
}

TEST(TimeIntegrator, NumberOfSteps)
{
  const Newmark newmark;
  EXPECT_EQ(newmark.n_steps(1., 0.1), 10u);
  EXPECT_EQ(newmark.n_steps(0.3, 0.1), 3u);
  EXPECT_EQ(newmark.n_steps(1., 0.3), 4u);
  LoadStepping statics;
  statics.load_steps = 7;
  EXPECT_EQ(statics.n_steps(1., 0.1), 7u);
}

// With c = alpha_K omega the stable x = omega dt solves x^2 + 2 c x = 4, from
// very small to very large c: to a few units of round-off, as all terms of the
// left side are positive, so its relative error is at most twice that of x.
TEST(CentralDifference, StableStepWithDamping)
{
  const CentralDifference method;
  // This value makes c exact.
  const double omega = 8;
  for (double c = 1e-8; c < 2e12; c *= 10)
    {
      const long double x = omega * method.stable_step(omega, c / omega);
      EXPECT_NEAR(static_cast<double>((x * x + 2 * c * x) / 4), 1, 1e-15) << c;
    }
  EXPECT_EQ(method.stable_step(omega, 0), 2 / omega);
}

TEST(TimeIntegrator, NumberOfStepsDoesNotOverflow)
{
  const Newmark newmark;
  EXPECT_NEAR(newmark.n_steps(1., 1e-12), 1e12, 1e3);
  EXPECT_NEAR(newmark.n_steps(1., 1e-300), 1e300, 1e291);
  EXPECT_EQ(newmark.n_steps(1e-300, 1e300), 1.);
}
