// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The strain that belongs to a stress, and principal values.

#include <corotet/material/stress_measures.h>

#include <gtest/gtest.h>

#include <cmath>

#include "../body.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::SymmetricTensor;
using dealii::Tensor;

// The strain is the inverse of the law, to round-off, which is enlarged by 1 /
// (1 - 2 nu).
TEST(StressMeasures, StrainOfStress)
{
  SymmetricTensor<2, 3> strain;
  strain[0][0] = 0.1;
  strain[1][1] = -0.3;
  strain[2][2] = 0.25;
  strain[0][1] = 0.07;
  strain[0][2] = -0.02;
  strain[1][2] = 0.13;
  for (const double nu : {-0.5, 0., 0.3, 0.499})
    {
      const IsotropicMaterial     material = isotropic_material(7., nu, 1.);
      const SymmetricTensor<2, 3> sigma    = stress(material, strain);
      EXPECT_LE((strain_of_stress(material, sigma) - strain).norm(),
                1e-15 / (1 - 2 * nu))
        << nu;
      EXPECT_NEAR(0.5 * (sigma * strain_of_stress(material, sigma)),
                  energy_density(material, strain),
                  1e-15 / (1 - 2 * nu))
        << nu;
    }
}

// Principal values do not depend on the axes and are ordered by value. They are
// accurate to round-off also where two or three are equal, as in uniaxial
// stress.
TEST(StressMeasures, PrincipalValues)
{
  const Tensor<2, 3> R = rotation_about(Tensor<1, 3>({0.3, -1., 2.}), 0.7);
  const std::vector<std::array<double, 3>> cases{{{3., 1., -2.}},
                                                 {{1., 0., 0.}},
                                                 {{0., 0., -5e8}},
                                                 {{2., 2., 2.}},
                                                 {{0., 0., 0.}}};
  for (const std::array<double, 3> &values : cases)
    {
      Tensor<2, 3> tensor;
      double       size = 0;
      for (unsigned int a = 0; a < 3; ++a)
        {
          tensor[a][a] = values[2 - a];
          size         = std::max(size, std::abs(values[a]));
        }
      const auto found =
        principal_values(symmetrize(R * tensor * transpose(R)));
      for (unsigned int a = 0; a < 3; ++a)
        EXPECT_NEAR(found[a], values[a], 4e-15 * size);
    }
  SymmetricTensor<2, 3> not_finite;
  not_finite[0][1] = std::nan("");
  for (const double value : principal_values(not_finite))
    EXPECT_FALSE(std::isfinite(value));
}
