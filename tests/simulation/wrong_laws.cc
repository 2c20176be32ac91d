// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Laws that a program adds and whose functions contradict each other are used,
// but the log warns of them.

#include <corotet/laws/law_kind.h>
#include <corotet/laws/linear.h>

#include <gtest/gtest.h>

#include "complete_run.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Tensor;

namespace
{
  // A law that is linear elasticity at rest, with wrong energy or derivative
  // elsewhere.
  class Wrong : public PointLaw
  {
  public:
    Wrong(const double of_energy, const double of_derivative)
      : of_energy(of_energy)
      , of_derivative(of_derivative)
    {}

    Tensor<2, 3>
    stress(const IsotropicMaterial &material,
           const Tensor<2, 3>      &H) const override
    {
      return linear_law()->stress(material, H);
    }

    Tensor<2, 3>
    stress_derivative(const IsotropicMaterial &material,
                      const Tensor<2, 3>      &H,
                      const Tensor<2, 3>      &dF) const override
    {
      return (1 + of_derivative * H.norm()) *
             linear_law()->stress_derivative(material, H, dF);
    }

    double
    energy_density(const IsotropicMaterial &material,
                   const Tensor<2, 3>      &H) const override
    {
      return (1 + of_energy * H.norm()) *
             linear_law()->energy_density(material, H);
    }

  private:
    double of_energy, of_derivative;
  };

  std::vector<std::string>
  warnings_of_law(const double of_energy, const double of_derivative)
  {
    const AddedCandidate<LawKind> added(law_candidate("wrong", [=] {
      return material_law(std::make_shared<Wrong>(of_energy, of_derivative));
    }));
    CompleteRun run(box_mesh("1, 1, 1", "1, 1, 1") + element_text(1) +
                    material_type("wrong") + fixed("x-min") +
                    tractions("x-max: 1; 0; 0") + statics());
    return warnings(run);
  }
} // namespace

TEST(WrongLaws, AreNamed)
{
  EXPECT_TRUE(warnings_of_law(0., 0.).empty());
  const auto energy = warnings_of_law(1., 0.);
  ASSERT_EQ(energy.size(), 1u);
  EXPECT_TRUE(energy.front().starts_with(
    "Material/Type: the law's stress is not the derivative of its energy, from "
    "which it differs by "))
    << energy.front();
  const auto derivative = warnings_of_law(0., -1.);
  ASSERT_EQ(derivative.size(), 1u);
  EXPECT_TRUE(derivative.front().starts_with(
    "Material/Type: the law's stress does not have the derivative that the law "
    "gives, which differs by "))
    << derivative.front();
}
