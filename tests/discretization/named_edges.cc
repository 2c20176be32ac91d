// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Edges and corners that have names are held at all their nodes, and only
// there, on any number of ranks.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../body.h"
#include "../refusal.h"
#include "../serial_meshes.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // The positions and components of the prescribed unknowns of all ranks, in an
  // order that does not depend on how many ranks there are.
  std::vector<std::array<double, 4>>
  prescribed_places(const MovingBody &body)
  {
    std::vector<std::array<double, 4>> places;
    for (const unsigned int i : body.motion.unknowns())
      {
        const auto x = body.discretization.node_position(i / 3);
        places.push_back({{x[0], x[1], x[2], i % 3 + 0.}});
      }
    std::vector<std::array<double, 4>> all;
    for (const auto &of_rank :
         dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, places))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    std::sort(all.begin(), all.end());
    return all;
  }

  // A unit cube of 2 x 2 x 2 cuboids. Named are the line around it at half its
  // height, its upper edge at x = 0, and the point in its middle.
  SerialMesh
  box_with_lines(const unsigned int n_refinements)
  {
    SelectionParameters selections;
    selections.edges   = "belt: plane 0 0 0.5 0 0 1, brow: x-min and z-max";
    selections.corners = "heart: sphere 0.5 0.5 0.5 0.01";
    SerialMesh mesh    = with_selections(box("1, 1, 1", "2, 2, 2"), selections);
    refine_uniformly(mesh, n_refinements);
    return mesh;
  }
} // namespace

// All nodes of a line are held, whatever their rank and the degree p, and only
// these: 8 p nodes on the 8 edges around the cube, 16 p after a refinement, and
// one node of a corner. A component that one condition leaves free may be
// prescribed by another: the line at x = 0 is held in x only. (On several ranks
// there are nodes whose owner has no cell with the edge.)
TEST(PrescribedMotion, NamedEdgesAndCorners)
{
  for (const unsigned int n_refinements : {0u, 1u})
    for (const unsigned int degree : {1u, 2u, 3u})
      {
        SCOPED_TRACE(
          fmt::format("{} refinements, degree {}", n_refinements, degree));
        MovingBody body(box_with_lines(n_refinements),
                        element_text(degree) + fixed("heart") +
                          displacements("belt: free; 0; 0.1, x-min: 0; free; "
                                        "free, brow: free; free; 0.2*y"));
        body.system.prescribe(body.state, 0., 1.);
        const unsigned int n      = 2 * degree << n_refinements;
        unsigned int       n_belt = 0, n_brow = 0, n_side = 0, n_heart = 0;
        for (const auto &[x, y, z, component] : prescribed_places(body))
          if (std::abs(x - 0.5) + std::abs(y - 0.5) + std::abs(z - 0.5) < 1e-10)
            ++n_heart;
          else if (component == 0)
            {
              EXPECT_EQ(x, 0);
              ++n_side;
            }
          else if (std::abs(z - 0.5) < 1e-10)
            {
              EXPECT_LT(std::min({x, y, 1 - x, 1 - y}), 1e-10);
              ++n_belt;
            }
          else
            {
              EXPECT_EQ(component, 2);
              EXPECT_LT(x + 1 - z, 1e-10);
              ++n_brow;
            }
        EXPECT_EQ(n_heart, 3u);
        EXPECT_EQ(n_belt, 2 * 4 * n);
        EXPECT_EQ(n_brow, n + 1);
        EXPECT_EQ(n_side, (n + 1) * (n + 1));
        for (const unsigned int i : body.motion.unknowns())
          {
            const auto x = body.discretization.node_position(i / 3);
            if (i % 3 != 2 || x[2] < 0.75)
              continue;
            EXPECT_NEAR(body.state.u.local_element(i), 0.2 * x[1], 1e-16);
          }

        // Other ranks have the same prescribed unknowns in their copies of
        // nodes.
        Vector marks;
        body.discretization.initialize_vector(marks);
        for (const unsigned int i : body.motion.unknowns())
          marks.local_element(i) = 1;
        marks.update_ghost_values();
        for (unsigned int i = 0; i < 3 * body.discretization.n_local_nodes();
             ++i)
          EXPECT_EQ(body.motion.is_prescribed()[i], marks.local_element(i));
      }
}

// A line and a side where it ends have one point in common; a line and a point
// that is not on it have none. Two conditions must agree where they meet.
TEST(PrescribedMotion, EdgesMeetOtherPlaces)
{
  MovingBody body(box_with_lines(1),
                  element_text(2) + displacements("brow & y-min: 0; 0; 0"));
  EXPECT_EQ(prescribed_places(body),
            (std::vector<std::array<double, 4>>{{{0, 0, 1, 0}},
                                                {{0, 0, 1, 1}},
                                                {{0, 0, 1, 2}}}));
  EXPECT_EQ(refusal([] {
              MovingBody apart(box_with_lines(0), fixed("brow & heart"));
            }),
            "Boundary conditions/Fixed: places have no node in common: found "
            "'heart & brow'; allowed are those that meet in an edge or a "
            "corner");
  MovingBody        differing(box_with_lines(0),
                       fixed("x-min") + displacements("belt: free; 0; t"));
  const std::string text =
    refusal([&] { differing.system.prescribe(differing.state, 1., 1.); });
  EXPECT_EQ(text.find(
              "Boundary conditions/Displacement: places 'x-min' and 'belt' "
              "prescribe different displacements in z at their common point "
              "(0, "),
            0u)
    << text;
}
