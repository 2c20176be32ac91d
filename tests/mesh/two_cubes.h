// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_mesh_two_cubes_h
#define corotet_tests_mesh_two_cubes_h

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "tools.h"

/**
 * Two unit cubes side by side in x, for the text of a mesh file: six
 * tetrahedra for each cube, and two triangles for each of the sides x = 0 and
 * x = 2.
 */
namespace corotet::tests::two_cubes
{
  constexpr std::array<std::array<int, 3>, 12> nodes{{{{0, 0, 0}},
                                                      {{1, 0, 0}},
                                                      {{2, 0, 0}},
                                                      {{0, 1, 0}},
                                                      {{1, 1, 0}},
                                                      {{2, 1, 0}},
                                                      {{0, 0, 1}},
                                                      {{1, 0, 1}},
                                                      {{2, 0, 1}},
                                                      {{0, 1, 1}},
                                                      {{1, 1, 1}},
                                                      {{2, 1, 1}}}};

  using Numbers = std::vector<int>;

  /// The nodes of each element, which count from one: first the four triangles,
  /// then the twelve tetrahedra.
  inline const std::vector<Numbers> elements{{1, 4, 10},
                                             {1, 7, 10},
                                             {3, 6, 12},
                                             {3, 12, 9},
                                             {1, 2, 5, 11},
                                             {1, 2, 11, 8},
                                             {1, 4, 11, 5},
                                             {1, 4, 10, 11},
                                             {1, 7, 8, 11},
                                             {1, 7, 11, 10},
                                             {2, 3, 6, 12},
                                             {2, 3, 12, 9},
                                             {2, 5, 12, 6},
                                             {2, 5, 11, 12},
                                             {2, 8, 9, 12},
                                             {2, 8, 12, 11}};

  /// The text that @p line makes for each node from its number and position.
  inline std::string
  node_lines(
    const std::function<std::string(int, const std::array<int, 3> &)> &line)
  {
    std::string result;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      result += line(static_cast<int>(i) + 1, nodes[i]);
    return result;
  }

  /// The text that @p line makes for each element from its number, its cube (0
  /// or 1) and its nodes.
  inline std::string
  element_lines(
    const std::function<std::string(int, int, const Numbers &)> &line)
  {
    std::string result;
    for (std::size_t e = 0; e < elements.size(); ++e)
      result +=
        line(static_cast<int>(e) + 1,
             e < 4 ? static_cast<int>(e) / 2 : static_cast<int>(e - 4) / 6,
             elements[e]);
    return result;
  }

  /// The physical group of an element: 1 and 2 for triangles of the two cubes,
  /// 3 and 4 for tetrahedra.
  inline int
  group_of(const int dimension, const int cube)
  {
    return 1 + cube + (dimension == 3 ? 2 : 0);
  }

  /// Checks the mesh that was read from a file of the two cubes.
  inline void
  expect_cubes(const SerialMesh  &mesh,
               const std::string &a     = "A",
               const std::string &b     = "B",
               const std::string &left  = "left",
               const std::string &right = "right")
  {
    EXPECT_EQ(mesh.cells.size(), 12u);
    EXPECT_NEAR(volume(mesh, a), 1, 1e-14);
    EXPECT_NEAR(volume(mesh, b), 1, 1e-14);
    EXPECT_NEAR(area(mesh, left), 1, 1e-14);
    EXPECT_NEAR(area(mesh, right), 1, 1e-14);
    EXPECT_EQ(mesh.faces.size(), 4u);
  }
} // namespace corotet::tests::two_cubes

#endif
