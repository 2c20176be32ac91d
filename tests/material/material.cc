// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Isotropic elasticity compared with textbook relations, and refusals of the
// section Material.

#include <corotet/laws/material_parameters.h>
#include <corotet/material/corotational.h>

#include <gtest/gtest.h>

#include "../body.h"
#include "../refusal.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::SymmetricTensor;
using dealii::Tensor;

// Under a uniaxial stress s the strains are s / E and -nu s / E.
TEST(Material, UniaxialStress)
{
  const double            E = 210e9, nu = 0.3, sigma = 1e6;
  const IsotropicMaterial material = isotropic_material(E, nu, 7850);
  SymmetricTensor<2, 3>   strain;
  strain[0][0] = sigma / E;
  strain[1][1] = strain[2][2] = -nu * sigma / E;
  SymmetricTensor<2, 3> expected;
  expected[0][0] = sigma;
  // The round-off of a few operations.
  EXPECT_LE((stress(material, strain) - expected).norm(), 1e-14 * sigma * 10);
  EXPECT_NEAR(von_mises(stress(material, strain)), sigma, 1e-14 * sigma * 10);
  EXPECT_NEAR(energy_density(material, strain),
              0.5 * sigma * sigma / E,
              1e-14 * sigma * sigma / E * 10);
}

// The von Mises stress of a pure shear tau is sqrt(3) tau.
TEST(Material, VonMisesOfShear)
{
  SymmetricTensor<2, 3> sigma;
  sigma[0][1] = 2;
  EXPECT_NEAR(von_mises(sigma), 2 * std::sqrt(3.), 1e-15 * 10);
}

TEST(Material, RotationAngle)
{
  for (const double angle : {0., 1e-9, 0.5, 3., dealii::numbers::PI})
    EXPECT_NEAR(rotation_angle(
                  rotation_about(Tensor<1, 3>({1., -2., 0.5}), angle)),
                angle,
                1e-15 * 4);
}

// The tangent with frozen rotation is the derivative of a function that is
// affine in grad u: differences of any size give it to round-off.
TEST(Material, TangentIsDerivativeOfStress)
{
  const IsotropicMaterial material = isotropic_material(3, 0.4, 1);
  const Tensor<2, 3>      R = rotation_about(Tensor<1, 3>({1., 2., 3.}), 2.);
  Tensor<2, 3>            H, dH;
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = 0; b < 3; ++b)
      {
        H[a][b]  = std::sin(1. + 3 * a + b);
        dH[a][b] = std::cos(2. + a + 3 * b);
      }
  const Tensor<2, 3> difference = corotational_stress(material, H + dH, R) -
                                  corotational_stress(material, H, R);
  EXPECT_LE((difference - corotational_tangent(material, dH, R)).norm(),
            1e-14 * 100);
}

namespace
{
  const MeshNames two_regions("region", {{{1, "steel"}, {7, "rubber"}}, {}});

  std::string
  material_refusal(const std::string &entry, const std::string &value)
  {
    MaterialParameters       parameters;
    dealii::ParameterHandler prm;
    parameters.declare_parameters(prm);
    prm.set(entry, value);
    return refusal([&] { parameters.materials(two_regions); });
  }
} // namespace

TEST(MaterialParameters, ByRegion)
{
  MaterialParameters       parameters;
  dealii::ParameterHandler prm;
  parameters.declare_parameters(prm);
  prm.set("Young's modulus", "steel: 2e11, 7: 1e6");
  prm.set("Poisson's ratio", "0");
  prm.set("Density", "rubber : 1100, steel : 7850");
  const auto materials = parameters.materials(two_regions);
  EXPECT_EQ(materials.at(1).mu, 1e11);
  EXPECT_EQ(materials.at(7).mu, 5e5);
  EXPECT_EQ(materials.at(1).density, 7850);
  EXPECT_EQ(materials.at(7).density, 1100);
}

TEST(MaterialParameters, Refusals)
{
  EXPECT_EQ(material_refusal("Poisson's ratio", "0.5"),
            "Material/Poisson's ratio: found 0.5 for region 'steel'; allowed: "
            "-1 < nu <= 0.499999 (at 0.5 the material is incompressible; 0.499 "
            "is in general close enough)");
  EXPECT_EQ(material_refusal("Poisson's ratio", "steel: 0.3, rubber: -1"),
            "Material/Poisson's ratio: found -1 for region 'rubber'; allowed: "
            "-1 < nu <= 0.499999 (at 0.5 the material is incompressible; 0.499 "
            "is in general close enough)");
  EXPECT_EQ(material_refusal("Density", "-3"),
            "Material/Density: found -3 for region 'steel'; allowed: a "
            "positive number of kg/m^3");
  EXPECT_EQ(material_refusal("Young's modulus", "0"),
            "Material/Young's modulus: found 0 for region 'steel'; allowed: a "
            "positive number of Pa");
  EXPECT_EQ(material_refusal("Young's modulus", "steel: 1"),
            "Material/Young's modulus: region 'rubber' has no value; needed is "
            "one for each region");
  EXPECT_EQ(
    material_refusal("Young's modulus", "steel: 1, 1: 2, rubber: 2"),
    "Material/Young's modulus: region 'steel' has two values; allowed is "
    "one, by names that share no cells");
  EXPECT_EQ(material_refusal("Young's modulus", "hard"),
            "Material/Young's modulus: 'hard' is not a number; allowed: a "
            "number, or 'region: number, ...'");
  EXPECT_EQ(material_refusal("Young's modulus", "steel: 1, 2"),
            "Material/Young's modulus: found '2'; allowed: a number for all "
            "regions, or 'region: number, ...'");
  EXPECT_NE(material_refusal("Density", "steal: 1, rubber: 1").find("steel"),
            std::string::npos);
}
