// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Parts of a body that only an edge or a vertex connects: stress and dilatation
// of one do not reach into another.

#include <corotet/discretization/connected_parts.h>
#include <corotet/laws/linear.h>
#include <corotet/operators/stress_field.h>

#include <gtest/gtest.h>

#include "../body.h"
#include "../joined_meshes.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
  const std::vector<Point<3>> corners{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}};

  // Three unit cubes, each of which has an edge in common with each other one,
  // and all three a vertex.
  SerialMesh
  three_cubes()
  {
    const SerialMesh cube = box("1, 1, 1", "3, 3, 3");
    SerialMesh       mesh = cube;
    mesh.faces.clear();
    mesh.boundaries = {};
    for (const unsigned int part : {1, 2})
      add_mesh(mesh, cube, corners[part]);
    return mesh;
  }

  bool
  contains(const unsigned int part, const Point<3> &x)
  {
    bool is_inside = true;
    for (unsigned int a = 0; a < 3; ++a)
      is_inside =
        is_inside && std::abs(x[a] - corners[part][a] - 0.5) < 0.5 + 1e-10;
    return is_inside;
  }

  // The first cube is stretched along x, the last one along z, the other one
  // not at all, with the common edges at rest.
  Tensor<1, 3>
  stretch(const Point<3> &x)
  {
    return Tensor<1, 3>({contains(0, x) ? 0.01 * (x[0] - 1) : 0.,
                         0.,
                         contains(2, x) ? 0.03 * (x[2] - 1) : 0.});
  }

  SymmetricTensor<2, 3>
  strain(const unsigned int part)
  {
    SymmetricTensor<2, 3> result;
    result[0][0] = part == 0 ? 0.01 : 0.;
    result[2][2] = part == 2 ? 0.03 : 0.;
    return result;
  }

  const std::string law = section("Material",
                                  {{"Type", "linear"},
                                   {"Young's modulus", 10},
                                   {"Poisson's ratio", 0.45}});
} // namespace

class HingedParts : public testing::TestWithParam<Element>
{};

INSTANTIATE_TEST_SUITE_P(Elements,
                         HingedParts,
                         testing::Values(Element(1),
                                         Element(2),
                                         Element(3),
                                         Element::quadratic_with_bubbles()));

TEST_P(HingedParts, HaveDifferentColours)
{
  const MovingBody     body(three_cubes(), element_text(GetParam()));
  const ConnectedParts parts(body.discretization);
  ASSERT_EQ(parts.n_parts, 3u);
  auto colours = parts.colours(body.discretization.communicator());
  std::sort(colours.begin(), colours.end());
  EXPECT_EQ(colours, (std::vector<unsigned int>{0, 1, 2}));
}

// Constant stress of each cube is recovered up to the hinges, where values are
// means over the cubes, and no error is estimated.
TEST_P(HingedParts, StressStaysInItsPart)
{
  const MovingBody body(three_cubes(), element_text(GetParam()) + law);
  StressField      field{
    body.discretization, body.reference, body.materials, linear_law(), nullptr};
  const Vector u = body.interpolate(stretch);
  field.set_displacement(u);
  const auto              nodal    = field.at_nodes();
  const IsotropicMaterial material = isotropic_material(10, 0.45, 1);
  for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
    {
      const Point<3>        x = body.discretization.node_position(n);
      SymmetricTensor<2, 3> sum;
      unsigned int          n_parts = 0;
      for (unsigned int part = 0; part < 3; ++part)
        if (contains(part, x))
          {
            sum += stress(material, strain(part));
            ++n_parts;
          }
      ASSERT_GT(n_parts, 0u);
      // A fit may cost some digits of the stress, 0.8 Pa.
      EXPECT_LE((nodal.stress[n] - sum / double(n_parts)).norm(), 1e-12) << x;
    }
  EXPECT_GT(field.error().stress_norm, 0.01);
  EXPECT_LE(field.error().energy_norm, 1e-12 * field.error().stress_norm);
}

// With a dilatation for each vertex, the energy of constant strain in each cube
// is exact, as vertices of a hinge have one for each cube.
TEST(HingedParts, DilatationStaysInItsPart)
{
  MovingBody   body(three_cubes(),
                  element_text(Element(1)) + law +
                    section("Material", {{"Dilatation", "vertices"}}));
  const Vector u = body.interpolate(stretch);
  body.elasticity.update_rotations(u);
  const IsotropicMaterial material = isotropic_material(10, 0.45, 1);
  double                  expected = 0;
  for (unsigned int part = 0; part < 3; ++part)
    expected += 0.5 * (stress(material, strain(part)) * strain(part));
  EXPECT_NEAR(body.elasticity.state(u).energy, expected, 1e-13 * expected);
}
