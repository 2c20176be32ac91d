// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Names by place of edges and corners: lengths of lines and numbers of vertices
// are known for a box.

#include <gtest/gtest.h>

#include "mesh/edges.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  double
  selected_length(const std::string &selection)
  {
    return edge_length(box_with("chosen: " + selection), "chosen");
  }

  std::size_t
  n_selected_corners(const std::string &selection)
  {
    return corner_places(box_with("", "chosen: " + selection), "chosen").size();
  }
} // namespace

// A shape selects edges on the surface with both ends in it. A boundary's name,
// a normal or a patch selects the edges of its faces, so that two of these have
// the border between them in common. "sharp" selects sharp edges, here the
// twelve edges of the box.
TEST(SelectedEdges, Shapes)
{
  EXPECT_NEAR(selected_length("plane 0 0 0.5 0 0 1"), 6, 1e-13);
  EXPECT_NEAR(selected_length("box 2 0 0 0 0 0"), 2, 1e-14);
  EXPECT_NEAR(selected_length("cylinder 1 0 1 2 0 1 0.01"), 1, 1e-14);
  // Three edges of a cuboid, and the diagonals between their far ends.
  EXPECT_NEAR(selected_length("sphere 0 0 0 0.3"),
              0.75 * (1 + std::sqrt(2.)),
              1e-14);
  EXPECT_NEAR(selected_length("x-min and z-min"), 1, 1e-14);
  EXPECT_NEAR(selected_length("normal 1 0 0 and normal 0 0 1"), 1, 1e-14);
  EXPECT_NEAR(selected_length("patch 1 0.5 3 and patch 1 -3 0.5"), 2, 1e-14);
  EXPECT_NEAR(selected_length("sharp"), 16, 1e-13);
  EXPECT_NEAR(selected_length("sharp 89 and not x-min and not x-max"),
              8,
              1e-13);
}

// A selection may use earlier ones, which keep their meaning.
TEST(SelectedEdges, OverlapAndNames)
{
  const SerialMesh mesh = box_with(
    "belt: plane 0 0 0.5 0 0 1, half: belt and box 0 0 0 1 1 1, rim: top "
    "and sharp, both: half or rim",
    "",
    "top: normal 0 0 1");
  EXPECT_NEAR(edge_length(mesh, "belt"), 6, 1e-13);
  EXPECT_NEAR(edge_length(mesh, "half"), 3, 1e-13);
  EXPECT_NEAR(edge_length(mesh, "rim"), 6, 1e-13);
  EXPECT_NEAR(edge_length(mesh, "both"), 9, 1e-13);
  EXPECT_NEAR(area(mesh, "top"), 2, 1e-13);
}

// A shape selects vertices anywhere in the body; names, normals and patches
// select the vertices on them.
TEST(SelectedCorners, Shapes)
{
  EXPECT_EQ(n_selected_corners("sphere 1 0.5 0.5 0.01"), 1u);
  EXPECT_EQ(n_selected_corners("plane 1 0 0 1 0 0"), 25u);
  EXPECT_EQ(n_selected_corners("x-min"), 25u);
  EXPECT_EQ(n_selected_corners("x-min and y-max and z-min"), 1u);
  EXPECT_EQ(n_selected_corners("normal -1 0 0 and patch 1 0.5 9"), 5u);
  EXPECT_EQ(n_selected_corners("not (x-min or x-max or y-min or y-max or z-min "
                               "or z-max)"),
            7u * 3 * 3);
  const SerialMesh mesh = box_with("belt: plane 0 0 0.5 0 0 1",
                                   "a: belt and x-min, b: a and y-min, c: b or "
                                   "sphere 2 1 1 0.1");
  EXPECT_EQ(corner_places(mesh, "a").size(), 5u);
  EXPECT_EQ(corner_places(mesh, "b"),
            (std::vector<std::array<double, 3>>{{{0, 0, 0.5}}}));
  EXPECT_EQ(corner_places(mesh, "c"),
            (std::vector<std::array<double, 3>>{{{0, 0, 0.5}}, {{2, 1, 1}}}));
}

TEST(SelectedEdges, Refusals)
{
  const auto says = [](const std::string &edges,
                       const std::string &corners,
                       const std::string &message) {
    EXPECT_EQ(refusal([&] { box_with(edges, corners); }),
              (edges.empty() ? "Selections/Corners: " : "Selections/Edges: ") +
                message);
  };
  says("a: plane 0 0 0.45 0 0 1",
       "",
       "selection 'a' has no edge; the nearest to 'plane 0 0 0.45 0 0 1' is "
       "0.05 m away");
  says("a: sharp 95",
       "",
       "selection 'a' has no edge; the nearest to 'sharp 95' is 5 degrees "
       "away");
  says("a: normal 1 1 1 10",
       "",
       "selection 'a' has no edge; the nearest to 'normal 1 1 1 10' is 44.74 "
       "degrees away");
  says("",
       "a: sphere 0 0 2 0.5",
       "selection 'a' has no corner; the nearest to 'sphere 0 0 2 0.5' is 0.5 "
       "m away");
  says("",
       "a: sharp",
       "a corner is not between two faces: found 'sharp'; allowed are 'box x y "
       "z x y z', 'cylinder x y z x y z radius', 'normal nx ny nz [angle]', "
       "'patch x y z [angle]', 'plane x y z nx ny nz', 'sphere x y z radius'");
  says("a: sharp 1 2",
       "",
       "a shape has another number of numbers: found 'sharp 1 2'; allowed is "
       "'sharp [angle]'");
  says("a: sharp, b: aa",
       "",
       "no such boundary or edge: found 'aa'; the mesh has the boundaries: "
       "x-min, x-max, y-min, y-max, z-min, z-max; the edges: a; did you mean "
       "'a'?");
  for (const std::string name : {"a", "x-min"})
    says("a: sharp, " + name + ": sharp",
         "",
         "the mesh has this name, or another selection: found '" + name +
           "'; give another one");
  EXPECT_EQ(refusal([] { box_with("a: sharp", "a: x-min"); }),
            "Selections/Corners: the mesh has this name, or another selection: "
            "found 'a'; give another one");
}
