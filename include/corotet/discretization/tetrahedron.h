// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_tetrahedron_h
#define corotet_discretization_tetrahedron_h

/**
 * The reference tetrahedron as deal.II numbers it, at compile time.
 */
namespace corotet::tetrahedron
{
  /// The vertices of the edges. The nodes on an edge go from the first vertex
  /// to the second.
  inline constexpr int edges[6][2] =
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  /// The vertices of the faces.
  inline constexpr int faces[4][3] = {{0, 1, 2},
                                      {1, 0, 3},
                                      {0, 2, 3},
                                      {2, 1, 3}};
  /// The edges of the faces.
  inline constexpr int edges_of_faces[4][3] = {{0, 1, 2},
                                               {0, 3, 4},
                                               {2, 3, 5},
                                               {1, 4, 5}};
} // namespace corotet::tetrahedron

#endif
