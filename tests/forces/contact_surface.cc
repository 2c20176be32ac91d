// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The surface that touches obstacles: faces near one, and their stiffness.

#include <corotet/forces/obstacle.h>

#include <gtest/gtest.h>

#include "../body.h"
#include "../joined_meshes.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  MovingBody
  touching_block(const Element      element,
                 const std::string &obstacle,
                 const std::string &motion = "0; 0; 0.3 * sin(t)")
  {
    return {box("2, 1, 1", "3, 2, 2", 0.1),
            element_text(element) + section("Contact",
                                            {{"Obstacles", "o: " + obstacle},
                                             {"Motions", "o: " + motion}})};
  }

  // The block falls from 3 m above to 0.3 m below, and waves as it does.
  Vector
  falling(const MovingBody &body, const double t)
  {
    return body.interpolate([&](const Point<3> &x) {
      return Tensor<1, 3>({0.3 * std::sin(3 * x[2] + t),
                           0.2 * std::cos(2 * x[0] - t),
                           3 - t + 0.2 * std::sin(2 * x[1] + 3 * t)});
    });
  }

  Vector
  pressure(const MovingBody &body, const double t, const Vector &u)
  {
    Vector f;
    body.discretization.initialize_vector(f);
    body.system.equation().terms.external_force(f, {t, u, u}, 1.);
    return f;
  }
} // namespace

class NearbyFacesTest : public testing::TestWithParam<Element>
{};

INSTANTIATE_TEST_SUITE_P(Elements,
                         NearbyFacesTest,
                         testing::Values(Element(1), Element(3)));

// Forces after many short steps, and after some long ones, are to the last
// digit those of a body that has made none.
TEST_P(NearbyFacesTest, ForcesDoNotDependOnThePast)
{
  for (const char *const obstacle : {"plane 0 0 0.2 0.1 0 1",
                                     "sphere 1 0.5 -1 1.2",
                                     "not cylinder 1 0.5 -9 1 0.5 9 1.05"})
    {
      MovingBody   body      = touching_block(GetParam(), obstacle);
      unsigned int n_touched = 0;
      for (unsigned int step = 0; step <= 330; ++step)
        {
          // In steps of 0.01 to the end, and back to the start in long ones.
          const double t = 0.01 * step;
          const Vector f = pressure(body, t, falling(body, t));
          if (step % 30 != 0)
            continue;
          const MovingBody fresh      = touching_block(GetParam(), obstacle);
          Vector           difference = pressure(fresh, t, falling(fresh, t));
          n_touched += difference.linfty_norm() > 0;
          difference -= f;
          EXPECT_EQ(difference.linfty_norm(), 0) << obstacle << ", t = " << t;
        }
      EXPECT_GE(n_touched, 2) << obstacle;
      for (const double t : {0., 3.2, 1.5, 3.})
        {
          const MovingBody fresh      = touching_block(GetParam(), obstacle);
          Vector           difference = pressure(fresh, t, falling(fresh, t));
          difference -= pressure(body, t, falling(body, t));
          EXPECT_EQ(difference.linfty_norm(), 0) << obstacle << ", t = " << t;
        }
    }
}

// The same where only the obstacle moves, from far away.
TEST(NearbyFaces, FollowTheObstacle)
{
  const std::string obstacle = "plane 0 0 -3 0 0 1", motion = "0; 0; t";
  MovingBody        body = touching_block(Element(2), obstacle, motion);
  const Vector      at_rest =
    body.interpolate([](const Point<3> &) { return Tensor<1, 3>(); });
  for (unsigned int step = 0; step <= 350; ++step)
    {
      const double t = 0.01 * step;
      const Vector f = pressure(body, t, at_rest);
      if (step % 50 != 0)
        continue;
      const MovingBody fresh = touching_block(Element(2), obstacle, motion);
      Vector           difference = pressure(fresh, t, at_rest);
      EXPECT_EQ(difference.linfty_norm() > 0, t > 3);
      difference -= f;
      EXPECT_EQ(difference.linfty_norm(), 0) << t;
    }
}

// The default stiffness depends on the thickness of the part that a face
// belongs to, not on that of another one far away.
TEST(ContactSurface, StiffnessIsThatOfThePart)
{
  const SerialMesh  plate   = box("1, 1, 0.02", "4, 4, 1");
  const std::string pressed = section("Contact",
                                      {{"Obstacles", "o: plane 0 0 0.01 0 0 1"},
                                       {"Boundaries", "z-min"}});
  const auto        energy  = [&](const SerialMesh &mesh) {
    const MovingBody body(mesh, element_text(Element(2)) + pressed);
    const Vector     u =
      body.interpolate([](const Point<3> &) { return Tensor<1, 3>(); });
    return body.system.equation().terms.contact_energy({0., u, u});
  };
  SerialMesh both = plate;
  add_mesh(both, box("2, 2, 2", "2, 2, 2"), Tensor<1, 3>({3, 0, 0}));
  const double alone = energy(plate);
  EXPECT_GT(alone, 0);
  EXPECT_NEAR(energy(both) / alone, 1, 1e-13);
}
