// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_tetrahedron_cut_h
#define corotet_mesh_tetrahedron_cut_h

#include <array>
#include <vector>

namespace corotet
{
  /**
   * The division of a tetrahedron into eight: its vertices have the numbers 0
   * to 3, the middles of its edges 4 to 9.
   */
  struct TetrahedronCut
  {
    /// Divides along diagonal number 0, 1 or 2, between 6 and 8, 5 and 7, or 4
    /// and 9.
    explicit TetrahedronCut(const unsigned int diagonal);

    std::array<std::array<unsigned int, 4>, 8> vertices;
    /// The parts of each face: children, and the numbers of their faces.
    std::array<std::vector<std::array<unsigned int, 2>>, 4> faces;
  };

  /// The three divisions, by their diagonals.
  const std::array<TetrahedronCut, 3> &
  tetrahedron_cuts();
} // namespace corotet

#endif
