// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/forces/rayleigh_damping.h>
#include <corotet/operators/force_round_off.h>
#include <corotet/operators/mass.h>

#include <deal.II/base/numbers.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace corotet
{
  namespace
  {
    // a - b, or zero if that is only the round-off of decimal numbers.
    double
    difference(const double a, const double b)
    {
      return std::abs(a - b) <= 1e-14 * (a + b) ? 0. : a - b;
    }
  } // namespace

  void
  DampingParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Mass coefficient",
                      given.mass,
                      "Coefficient alpha_M [1/s] of the mass in Rayleigh "
                      "damping C = alpha_M M + alpha_K K. It also brakes rigid "
                      "motion.",
                      Double(0));
    prm.add_parameter("Stiffness coefficient",
                      given.stiffness,
                      "Coefficient alpha_K [s] of the stiffness in Rayleigh "
                      "damping C = alpha_M M + alpha_K K, where K is the "
                      "stiffness at rest, rotated with each cell.",
                      Double(0));
    const List none_or_two{Double(0), 0, 2};
    prm.add_parameter(
      "Frequencies",
      frequencies,
      "Two frequencies [Hz], the lower one first, at which vibrations have the "
      "damping ratios of Ratios, in place of the two coefficients. Between "
      "them damping is below the straight line through the ratios, outside "
      "above it. Empty: the coefficients are used.",
      none_or_two);
    prm.add_parameter("Ratios",
                      ratios,
                      "Damping ratios [-] at the two Frequencies; 1 is "
                      "critical. The larger one is at most the smaller one "
                      "times the ratio of the frequencies.",
                      none_or_two);
  }

  DampingCoefficients
  DampingParameters::coefficients() const
  {
    if (frequencies.empty() && ratios.empty())
      return given;
    if (frequencies.size() != 2 || !(frequencies[0] > 0) ||
        !(frequencies[1] > frequencies[0]))
      throw InputError("Damping/Frequencies",
                       fmt::format("found '{}' with Damping/Ratios = '{}'; "
                                   "allowed are two positive frequencies, the "
                                   "lower one first",
                                   fmt::join(frequencies, ", "),
                                   fmt::join(ratios, ", ")));
    if (ratios.size() != 2)
      throw InputError("Damping/Ratios",
                       fmt::format("found '{}' with Damping/Frequencies = "
                                   "'{}'; allowed are two ratios",
                                   fmt::join(ratios, ", "),
                                   fmt::join(frequencies, ", ")));
    if (given.mass != 0 || given.stiffness != 0)
      throw InputError("Damping/Frequencies",
                       fmt::format("damping is given twice: found frequencies "
                                   "next to the coefficients {} and {}; "
                                   "allowed are these or those",
                                   given.mass,
                                   given.stiffness));

    const double omega0    = 2 * dealii::numbers::PI * frequencies[0];
    const double omega1    = 2 * dealii::numbers::PI * frequencies[1];
    const double divisor   = (omega1 - omega0) * (omega1 + omega0) / 2;
    const double mass      = difference(ratios[0] * omega1, ratios[1] * omega0);
    const double stiffness = difference(ratios[1] * omega1, ratios[0] * omega0);
    if (mass < 0 || stiffness < 0)
      throw InputError(
        "Damping/Ratios",
        fmt::format("a {} coefficient below zero would be needed: found the "
                    "ratios {} and {} at {} and {} Hz; allowed with the first "
                    "is a second from {:.6g} to {:.6g}",
                    mass < 0 ? "mass" : "stiffness",
                    ratios[0],
                    ratios[1],
                    frequencies[0],
                    frequencies[1],
                    ratios[0] * frequencies[0] / frequencies[1],
                    ratios[0] * frequencies[1] / frequencies[0]));
    return {omega0 * omega1 * mass / divisor, stiffness / divisor};
  }

  RayleighDamping::RayleighDamping(const Discretization     &discretization,
                                   const Mass               &mass,
                                   Elasticity               &elasticity,
                                   const DampingCoefficients coefficients)
    : mass(mass)
    , elasticity(elasticity)
    , coefficients(coefficients)
  {
    discretization.initialize_vector(product);
  }

  void
  RayleighDamping::add_force(Vector &f, const Motion &motion) const
  {
    const auto subtract = [&](const double factor) {
      for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
        f.local_element(i) -= factor * product.local_element(i);
    };
    if (coefficients.stiffness > 0)
      {
        if (!elasticity.is_by_cell(Tangent::frozen_rotation))
          elasticity.linearize(motion.u, Tangent::frozen_rotation);
        elasticity.apply_stiffness(product, motion.v, Tangent::frozen_rotation);
        subtract(coefficients.stiffness);
      }
    if (coefficients.mass > 0)
      {
        mass.apply(product, motion.v);
        subtract(coefficients.mass);
      }
  }

  double
  RayleighDamping::round_off(const Motion &motion,
                             const double,
                             const ForceRoundOff &noise) const
  {
    return coefficients.stiffness > 0 ?
             coefficients.stiffness * noise.of_displacement(motion.v) :
             0;
  }

  void
  RayleighDampingKind::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Damping");
    parameters.declare_parameters(prm);
    prm.leave_subsection();
  }

  std::vector<ForceKind::GivenEntry>
  RayleighDampingKind::given() const
  {
    const DampingCoefficients c = parameters.coefficients();
    if (c.mass == 0 && c.stiffness == 0)
      return {};
    return {
      {"Damping", fmt::format("{:g} 1/s, {:g} s", c.mass, c.stiffness), ""}};
  }

  void
  RayleighDampingKind::add_to(ForceTerms         &terms,
                              const ForceContext &context) const
  {
    const DampingCoefficients c = parameters.coefficients();
    if (!parameters.frequencies.empty())
      context.log.line(
        fmt::format("Damping: alpha_M = {:.6g} 1/s, alpha_K = {:.6g} s",
                    c.mass,
                    c.stiffness));
    if (c.mass > 0 || c.stiffness > 0)
      terms.add(std::make_unique<RayleighDamping>(
                  context.discretization, context.mass, context.elasticity, c),
                "Damping");
  }
} // namespace corotet
