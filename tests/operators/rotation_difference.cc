// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The largest difference between rotations inside of cells and those at their
// centres, compared with formulas for a plane motion.

#include <corotet/discretization/point_geometry.h>
#include <corotet/material/corotational.h>
#include <corotet/material/polar_decomposition.h>
#include <corotet/operators/rotation_difference.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include "../body.h"
#include "../curved_mesh.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  double
  difference(const MovingBody &body, const Vector &u)
  {
    return largest_rotation_difference(body.discretization, body.reference, u);
  }

  // For u = (-c x z, 0, c x^2 / 2), F in the plane is {{1 - c z, -c x}, {c x,
  // 1}}, and its rotation has the angle atan2(2 c x, 2 - c z).
  constexpr double c = 0.3;

  double
  angle(const Point<3> &x)
  {
    return std::atan2(2 * c * x[0], 2 - c * x[2]);
  }
} // namespace

// The difference is right to the round-off of sums of terms of order one.
TEST(RotationDifference, BentBox)
{
  for (const unsigned int degree : {2u, 3u})
    {
      const MovingBody body(box("2, 1, 1", "4, 2, 2", 0.2),
                            element_text(degree));
      const auto       u       = body.interpolate([](const Point<3> &x) {
        return Tensor<1, 3>({-c * x[0] * x[2], 0., 0.5 * c * x[0] * x[0]});
      });
      double           largest = 0;
      const auto      &disc    = body.discretization;
      const auto      &rule    = body.reference.stiffness_rule;
      for (unsigned int cell = 0; cell < disc.n_owned_cells(); ++cell)
        {
          const Point<3>     p0 = disc.node_position(disc.cell_nodes(cell)[0]);
          const Tensor<2, 3> J  = invert(disc.geometry(cell).inverse_jacobian);
          const double centre   = angle(p0 + J * Point<3>(0.25, 0.25, 0.25));
          for (const Point<3> &xi : rule.points)
            largest = std::max(largest, std::abs(angle(p0 + J * xi) - centre));
        }
      largest = dealii::Utilities::MPI::max(largest, disc.communicator());
      EXPECT_GT(largest, 0.05);
      EXPECT_NEAR(difference(body, u), largest, 1e-13);
    }
}

// In curved cells, rotations are taken at the points of their force integrals.
TEST(RotationDifference, CurvedCells)
{
  for (const unsigned int degree : {2u, 3u})
    {
      const MovingBody body(half_curved_box(degree), element_text(degree));
      const auto       u           = body.interpolate([](const Point<3> &x) {
        return Tensor<1, 3>({-c * x[0] * x[2], 0., 0.5 * c * x[0] * x[0]});
      });
      const auto      &disc        = body.discretization;
      const auto       curved_rule = ReferenceElement::curved_rule(degree);

      const auto rotation = [&](const unsigned int                   cell,
                                const ReferenceElement::PointValues &rule,
                                const unsigned int                   q) {
        Tensor<2, 3> F = displacement_gradient(disc, u, cell, rule, q);
        for (unsigned int a = 0; a < 3; ++a)
          F[a][a] += 1;
        return polar_decomposition(F).rotation;
      };
      double       largest = 0, at_other_points = 0;
      unsigned int n_curved = 0;
      for (unsigned int cell = 0; cell < disc.n_owned_cells(); ++cell)
        {
          const bool  is_curved = disc.is_curved(cell);
          const auto  centre    = rotation(cell, body.reference.centre, 0);
          const auto &straight  = body.reference.stiffness_rule;
          const auto &rule      = is_curved ? curved_rule : straight;
          n_curved += is_curved ? 1 : 0;
          for (unsigned int q = 0; q < rule.weights.size(); ++q)
            largest = std::max(largest,
                               rotation_angle(transpose(centre) *
                                              rotation(cell, rule, q)));
          for (unsigned int q = 0; q < straight.weights.size(); ++q)
            at_other_points =
              std::max(at_other_points,
                       rotation_angle(transpose(centre) *
                                      rotation(cell, straight, q)));
        }
      const MPI_Comm comm = disc.communicator();
      largest             = dealii::Utilities::MPI::max(largest, comm);
      at_other_points     = dealii::Utilities::MPI::max(at_other_points, comm);
      EXPECT_GT(dealii::Utilities::MPI::sum(n_curved, comm), 0u);
      EXPECT_NEAR(difference(body, u), largest, 1e-13);
      EXPECT_GT(largest, 1.01 * at_other_points);
    }
}

// A body at rest, and one that is rotated and uniformly stretched, have the
// same rotation everywhere.
TEST(RotationDifference, NoneWhereRotationIsTheSame)
{
  const MovingBody body(box("2, 1, 1", "4, 2, 2", 0.2), element_text(2));
  EXPECT_EQ(difference(body, body.interpolate([](const Point<3> &) {
              return Tensor<1, 3>();
            })),
            0);
  EXPECT_LT(difference(body, body.interpolate([](const Point<3> &x) {
              const double s = std::sin(2.), k = std::cos(2.);
              return Tensor<1, 3>({1.1 * k * x[0] - s * x[1] - x[0],
                                   1.1 * s * x[0] + k * x[1] - x[1],
                                   0.});
            })),
            1e-13);
}
