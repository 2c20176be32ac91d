// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "tetrahedron_cut.h"

#include <corotet/mesh/edges.h>

#include <deal.II/grid/reference_cell.h>

#include <algorithm>

namespace corotet
{
  namespace
  {
    // Whether one of the ten vertices is on a face of the tetrahedron.
    bool
    is_on_face(const unsigned int vertex, const unsigned int face)
    {
      const auto is_corner = [&](const unsigned int k) {
        return std::find(corners_of_faces[face].begin(),
                         corners_of_faces[face].end(),
                         k) != corners_of_faces[face].end();
      };
      if (vertex < 4)
        return is_corner(vertex);
      const auto &[a, b] = ends_of_edges[vertex - 4];
      return is_corner(a) && is_corner(b);
    }
  } // namespace



  TetrahedronCut::TetrahedronCut(const unsigned int diagonal)
  {
    const auto table =
      dealii::ReferenceCells::Tetrahedron.new_isotropic_child_cell_vertices(
        diagonal);
    for (unsigned int child = 0; child < 8; ++child)
      for (unsigned int k = 0; k < 4; ++k)
        vertices[child][k] = table[child][k];
    for (unsigned int f = 0; f < 4; ++f)
      for (unsigned int child = 0; child < 8; ++child)
        for (unsigned int g = 0; g < 4; ++g)
          if (std::all_of(corners_of_faces[g].begin(),
                          corners_of_faces[g].end(),
                          [&](const unsigned int k) {
                            return is_on_face(vertices[child][k], f);
                          }))
            faces[f].push_back({{child, g}});
  }



  const std::array<TetrahedronCut, 3> &
  tetrahedron_cuts()
  {
    static const std::array<TetrahedronCut, 3> all{
      {TetrahedronCut(0), TetrahedronCut(1), TetrahedronCut(2)}};
    return all;
  }
} // namespace corotet
