// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Cells that are straight up to the digits that a file has for coordinates.

#include <corotet/mesh/curved_cells.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "../curved_mesh.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;

namespace
{
  // The mesh as it is in a file that writes numbers with this format.
  SerialMesh
  written(SerialMesh mesh, const std::string &format)
  {
    const auto round = [&](Point<3> &x) {
      for (unsigned int a = 0; a < 3; ++a)
        x[a] = std::stod(fmt::format(fmt::runtime(format), x[a]));
    };
    for (Point<3> &x : mesh.vertices)
      round(x);
    for (Point<3> &x : mesh.curved_nodes)
      round(x);
    return mesh;
  }

  // A distorted box, moved and stretched; its maps have this degree, but are
  // straight.
  SerialMesh
  straight_box(const unsigned int degree)
  {
    return curved(box("2, 1, 1", "4, 2, 2", 0.1),
                  degree,
                  [](const Point<3> &x) {
                    return Point<3>(17 * x[0] - 3.1, 13 * x[1] + 40, 7 * x[2]);
                  });
  }
} // namespace

TEST(WrittenDigits, StraightCellsAreTold)
{
  for (const unsigned int degree : {2, 3})
    for (const std::string format :
         {"{:.5e}", "{:.8e}", "{:.6f}", "{:.3f}", "{:.9g}", "{:.17g}"})
      {
        SerialMesh        mesh   = written(straight_box(degree), format);
        const std::string remark = remove_written_straight_maps(mesh);
        EXPECT_TRUE(mesh.curved_nodes.empty()) << format;
        EXPECT_EQ(mesh.geometry_degree, 1u) << format;
        // With all digits of a double there is nothing to remark on.
        EXPECT_EQ(remark.empty(), format == "{:.17g}") << remark;
        if (format == "{:.8e}")
          {
            EXPECT_NE(remark.find(
                        "cells are straight but for the 9 digits that "
                        "the file has"),
                      std::string::npos)
              << remark;
          }
      }
}

// Binary files may have numbers of single precision.
TEST(WrittenDigits, SinglePrecision)
{
  const auto single = [](SerialMesh mesh) {
    const auto round = [](Point<3> &x) {
      for (unsigned int a = 0; a < 3; ++a)
        x[a] = static_cast<float>(x[a]);
    };
    std::ranges::for_each(mesh.vertices, round);
    std::ranges::for_each(mesh.curved_nodes, round);
    return mesh;
  };
  for (const unsigned int degree : {2, 3})
    {
      SerialMesh        mesh   = single(straight_box(degree));
      const std::string remark = remove_written_straight_maps(mesh);
      EXPECT_TRUE(mesh.curved_nodes.empty());
      EXPECT_NE(remark.find("the 7 digits"), std::string::npos) << remark;

      const SerialMesh exact  = half_curved_box(degree);
      SerialMesh       curved = single(exact);
      remove_written_straight_maps(curved);
      EXPECT_EQ(curved.curved_nodes.size(), exact.curved_nodes.size());
    }
}

// Cells that are curved by more than the last digit stay curved, as in half of
// this box; the other half is straight.
TEST(WrittenDigits, CurvedCellsStay)
{
  for (const unsigned int degree : {2, 3})
    {
      const SerialMesh exact = half_curved_box(degree);
      for (const std::string format : {"{:.5e}", "{:.8f}", "{:.17g}"})
        {
          SerialMesh mesh = written(exact, format);
          remove_written_straight_maps(mesh);
          EXPECT_EQ(mesh.curved_nodes.size(), exact.curved_nodes.size())
            << format;
        }
    }
}

// Numbers with few digits count as exact: here an edge is bent by its last
// digit.
TEST(WrittenDigits, RoundNumbersAreExact)
{
  SerialMesh mesh =
    curved(box("1, 1, 1", "1, 1, 1"), 2, [](const Point<3> &x) { return x; });
  for (Point<3> &x : mesh.curved_nodes)
    if (x.distance(Point<3>(0.5, 0, 0)) < 1e-12)
      x[1] = 0.1;
  SerialMesh exact = mesh;
  remove_straight_maps(exact);
  ASSERT_FALSE(exact.curved_nodes.empty());
  EXPECT_EQ(remove_written_straight_maps(mesh), "");
  EXPECT_EQ(mesh.curved_nodes.size(), exact.curved_nodes.size());
}
