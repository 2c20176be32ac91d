// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The estimate of the round-off of elastic forces. A translation does not
// change forces, so any change is round-off. The estimate must lie above it, or
// Newton's method would not end, and not far above, since Newton's method
// accepts residuals of that size. It is some ten times the effect of one
// rounding of each displacement, since time steps add up many.

#include <corotet/operators/force_round_off.h>

#include <gtest/gtest.h>

#include "../body.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  // The force of a smooth displacement plus a translation, less the force
  // without the translation.
  struct Noise
  {
    double measured;
    double estimated;
  };

  Noise
  noise_of_translation(const SerialMesh  &mesh,
                       const Element      element,
                       const std::string &type,
                       const double       distance)
  {
    MovingBody body(mesh, element_text(element) + type + material_text(1e3));
    Elasticity elastic(body.discretization,
                       body.reference,
                       body.materials,
                       body.law);
    const auto displacement = [](const Point<3> &x) {
      return Tensor<1, 3>({1e-3 * std::sin(2 * x[0] + x[1]),
                           2e-3 * x[0] * x[0],
                           1e-3 * std::cos(x[0] * x[2])});
    };
    const Vector u     = body.interpolate(displacement);
    const Vector moved = body.interpolate([&](const Point<3> &x) {
      return displacement(x) + distance * Tensor<1, 3>({1., 0.7, -0.4});
    });
    Vector       f, g;
    for (Vector *vector : {&f, &g})
      body.discretization.initialize_vector(*vector);
    elastic.update_rotations_and_force(f, u);
    elastic.update_rotations_and_force(g, moved);
    f -= g;
    const ForceRoundOff round_off(body.discretization, elastic);
    return {norm(f),
            round_off.of_displacement(moved) + round_off.of_rotations()};
  }

  const std::vector<std::string> types{material_type("linear"),
                                       material_type("corotational"),
                                       material_type("corotational") +
                                         rotation_at("quadrature points")};
} // namespace

class ForceRoundOffTest : public testing::TestWithParam<Element>
{};

// Translations are from a tenth of the size of a cell to 1e12 times that size.
TEST_P(ForceRoundOffTest, HoldsAndIsSharp)
{
  double smallest = 1, largest = 0;
  for (const auto &mesh : {box("1, 1, 1", "3, 3, 3", 0.2),
                           box("1, 1, 0.02", "4, 4, 1"),
                           box("1e-6, 1e-6, 1e-6", "3, 3, 3")})
    for (const std::string &type : types)
      for (const double distance : {0.03, 3e2, 3e5})
        {
          const auto [measured, estimated] =
            noise_of_translation(mesh, GetParam(), type, distance);
          EXPECT_LE(measured, estimated) << type << distance;
          smallest = std::min(smallest, measured / estimated);
          largest  = std::max(largest, measured / estimated);
        }
  report("smallest measured / estimated", smallest);
  report("largest measured / estimated", largest);
  // In regular meshes a translation may round all displacements in the same
  // way.
  EXPECT_GE(largest, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Elements,
                         ForceRoundOffTest,
                         testing::Values(Element(1),
                                         Element(2),
                                         Element(3),
                                         Element::quadratic_with_bubbles()),
                         [](const auto &info) {
                           return "P" + std::to_string(info.param.degree()) +
                                  (info.param.has_bubbles() ? "WithBubbles" :
                                                              "");
                         });
