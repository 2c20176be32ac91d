// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Proportions of the five cells of a cuboid: one in the middle, which is
// regular in a cube, and four in its corners.

#include <corotet/discretization/cell_proportions.h>

#include <gtest/gtest.h>

#include <cmath>

#include "../body.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // Two of the three stretches are the same in all these cells, so that the
  // formula for eigenvalues has the arc cosine of 1: it is known to the square
  // root of round-off, 1e-8, times their ratio.
  constexpr double accuracy = 1e-6;

  CellProportions
  proportions(const std::string &size, const std::string &cells)
  {
    const MovingBody body(box(size, cells), element_text(1));
    return cell_proportions(body.discretization);
  }
} // namespace

// The corner cell of a cube is a regular tetrahedron stretched by sqrt(2),
// sqrt(2) and 1 / sqrt(2): it is flat by a factor of 2.
TEST(CellProportions, OfCubes)
{
  const CellProportions found = proportions("3, 2, 2", "3, 2, 2");
  EXPECT_EQ(found.share_flat, 0);
  EXPECT_EQ(found.share_stretched, 0);
  EXPECT_NEAR(found.largest_ratio, 2, accuracy);
  EXPECT_NEAR(found.mean_ratio, std::pow(2., 0.8), accuracy);
  EXPECT_EQ(found.text(), "no cell is flat or stretched by more than 4");
}

// The cell in the middle has the proportions of the cuboid; those in the
// corners are flatter by a factor of less than 2, or less stretched.
TEST(CellProportions, OfFlatAndStretchedCuboids)
{
  const CellProportions flat = proportions("3, 2, 0.2", "3, 2, 2");
  EXPECT_EQ(flat.share_flat, 1);
  EXPECT_EQ(flat.share_stretched, 0);
  EXPECT_GT(flat.largest_ratio, 10 - accuracy);
  EXPECT_GT(flat.mean_ratio, 10 - accuracy);
  EXPECT_LT(flat.mean_ratio, 20);
  EXPECT_EQ(flat.text().find("100 % of the cells are flat, 0 % stretched (by "
                             "more than 4; most by 1"),
            0u)
    << flat.text();

  const CellProportions stretched = proportions("30, 2, 2", "3, 2, 2");
  EXPECT_EQ(stretched.share_flat, 0);
  EXPECT_EQ(stretched.share_stretched, 1);
  EXPECT_NEAR(stretched.largest_ratio, 10, accuracy);
}

// Only the cells of one layer are flat, so the worst cell is in it.
TEST(CellProportions, WorstCell)
{
  SerialMesh mesh = box("2, 2, 8", "2, 2, 8");
  for (auto &x : mesh.vertices)
    if (x[2] > 3.5)
      x[2] -= 0.9;
  const MovingBody      body(mesh, element_text(2));
  const CellProportions found = cell_proportions(body.discretization);
  EXPECT_NEAR(found.share_flat, 1. / 8, 1e-12);
  EXPECT_GT(found.place[2], 3);
  EXPECT_LT(found.place[2], 3.1);
}
