// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A law that the test itself writes at a point and registers from outside: it
// must agree with the library's own law of that kind, to as many digits.

#include <corotet/laws/law_kind.h>
#include <corotet/operators/elasticity.h>

#include <gtest/gtest.h>

#include "../operators/random_states.h"
#include "../refusal.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Tensor;

namespace
{
  // The Saint Venant-Kirchhoff law, P = F (lambda tr(E) I + 2 mu E).
  class MyKirchhoff : public PointLaw
  {
  public:
    Tensor<2, 3>
    stress(const IsotropicMaterial &material,
           const Tensor<2, 3>      &H) const override
    {
      return (H + unit()) * second_stress(material, strain(H));
    }

    Tensor<2, 3>
    stress_derivative(const IsotropicMaterial &material,
                      const Tensor<2, 3>      &H,
                      const Tensor<2, 3>      &dF) const override
    {
      const Tensor<2, 3> F = H + unit();
      return dF * second_stress(material, strain(H)) +
             F * second_stress(material,
                               0.5 * (transpose(dF) * F + transpose(F) * dF));
    }

    double
    energy_density(const IsotropicMaterial &material,
                   const Tensor<2, 3>      &H) const override
    {
      const Tensor<2, 3> E = strain(H);
      return 0.5 * scalar_product(E, second_stress(material, E));
    }

  private:
    static Tensor<2, 3>
    unit()
    {
      return Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
    }

    static Tensor<2, 3>
    strain(const Tensor<2, 3> &H)
    {
      return 0.5 * (H + transpose(H) + transpose(H) * H);
    }

    static Tensor<2, 3>
    second_stress(const IsotropicMaterial &material, const Tensor<2, 3> &E)
    {
      // Laws may divide by it, as for Poisson's ratio.
      EXPECT_GT(material.mu, 0);
      return material.lambda * trace(E) * unit() + 2 * material.mu * E;
    }
  };
} // namespace

// Laws that differ from linear elasticity at rest, or have a stress there, are
// refused before a run.
TEST(OutsideLaws, AreCheckedAtRest)
{
  class Wrong : public MyKirchhoff
  {
  public:
    Wrong(const double factor, const double stress_at_rest)
      : factor(factor)
      , stress_at_rest(stress_at_rest)
    {}

    Tensor<2, 3>
    stress(const IsotropicMaterial &material,
           const Tensor<2, 3>      &H) const override
    {
      return factor * MyKirchhoff::stress(material, H) +
             stress_at_rest * Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
    }

    Tensor<2, 3>
    stress_derivative(const IsotropicMaterial &material,
                      const Tensor<2, 3>      &H,
                      const Tensor<2, 3>      &dF) const override
    {
      return factor * MyKirchhoff::stress_derivative(material, H, dF);
    }

  private:
    double factor, stress_at_rest;
  };
  const IsotropicMaterial material = isotropic_material(1e3, 0.3, 1);
  const auto said = [&](const double factor, const double stress_at_rest) {
    return refusal(
      [&] { check_at_rest(Wrong(factor, stress_at_rest), material); });
  };
  EXPECT_EQ(said(1, 0), "nothing was refused");
  EXPECT_EQ(said(2, 0).find(
              "Material/Type: the law is not linear elasticity at "
              "rest"),
            0u)
    << said(2, 0);
  EXPECT_EQ(said(1, 7).find("Material/Type: the law has a stress of 12.1 Pa"),
            0u)
    << said(1, 7);
  EXPECT_NE(said(std::nan(""), 0), "nothing was refused");

  const AddedCandidate<LawKind> added(law_candidate("twice as stiff", [] {
    return material_law(std::make_shared<Wrong>(2., 0.));
  }));
  EXPECT_NE(refusal([] {
              MovingBody(box("1, 1, 1", "1, 1, 1"),
                         material_type("twice as stiff"));
            }).find("not linear elasticity at rest"),
            std::string::npos);
}

// The check of laws finds stresses, energies and derivatives that contradict
// each other.
TEST(OutsideLaws, ErrorsOfALaw)
{
  class Wrong : public MyKirchhoff
  {
  public:
    Wrong(const double of_energy, const double of_derivative)
      : of_energy(of_energy)
      , of_derivative(of_derivative)
    {}

    Tensor<2, 3>
    stress_derivative(const IsotropicMaterial &material,
                      const Tensor<2, 3>      &H,
                      const Tensor<2, 3>      &dF) const override
    {
      return of_derivative * MyKirchhoff::stress_derivative(material, H, dF);
    }

    double
    energy_density(const IsotropicMaterial &material,
                   const Tensor<2, 3>      &H) const override
    {
      return of_energy * MyKirchhoff::energy_density(material, H);
    }

  private:
    double of_energy, of_derivative;
  };
  const Tensor<2, 3> H({{0.1, 0.2, 0.}, {-0.1, 0.05, 0.}, {0., 0.1, -0.2}});
  const IsotropicMaterial material = isotropic_material(1e3, 0.3, 1);
  const LawErrors         energy   = law_errors(Wrong(1.25, 1.), material, H);
  EXPECT_NEAR(energy.stress, 0.25, 1e-8);
  EXPECT_LE(energy.stress_derivative, 1e-8);
  const LawErrors derivative = law_errors(Wrong(1., 0.5), material, H);
  EXPECT_LE(derivative.stress, 1e-8);
  EXPECT_NEAR(derivative.stress_derivative, 0.5, 1e-8);
}

// A candidate that makes no law is refused, too.
TEST(OutsideLaws, NoLaw)
{
  const AddedCandidate<LawKind> added(
    law_candidate("none", [] { return std::shared_ptr<const MaterialLaw>(); }));
  EXPECT_THROW(MovingBody(box("1, 1, 1", "1, 1, 1"), material_type("none")),
               std::logic_error);
}

TEST(OutsideLaws, IsLikeTheLibrarysOwn)
{
  const AddedCandidate<LawKind> added(law_candidate("my Kirchhoff", [] {
    return material_law(std::make_shared<MyKirchhoff>());
  }));
  for (const unsigned int degree : {1, 2, 3})
    {
      // The entry Type has the name of the law as a choice.
      const std::string text = element_text(degree) + material_text(1e3);
      // An odd number of cells, which fill no registers.
      const SerialMesh mesh = box("1, 2, 1", "1, 3, 1", 0.2);
      MovingBody       mine(mesh, text + material_type("my Kirchhoff"));
      MovingBody theirs(mesh, text + material_type("Saint Venant-Kirchhoff"));
      Elasticity a   = elasticity_of(mine, mine.law),
                 b   = elasticity_of(theirs, theirs.law);
      const Vector u = displacement(mine, states[2], 1.5, 3),
                   v = random_direction(mine);
      const Vector f = force(b, u);
      // The round-off of sums of some hundred products.
      EXPECT_LE(largest_difference(force(a, u), f), 1e-13 * f.linfty_norm());
      EXPECT_NEAR(a.state(u).energy,
                  b.state(u).energy,
                  1e-13 * b.state(u).energy);
      Vector Kv(f), expected(f);
      a.linearize(u, Tangent::consistent);
      a.apply_stiffness(Kv, v, Tangent::consistent);
      b.linearize(u, Tangent::consistent);
      b.apply_stiffness(expected, v, Tangent::consistent);
      EXPECT_LE(largest_difference(Kv, expected),
                1e-13 * expected.linfty_norm());
      EXPECT_NEAR(a.cell_results(u).von_mises[0],
                  b.cell_results(u).von_mises[0],
                  1e-13 * b.cell_results(u).von_mises[0]);
    }
}
