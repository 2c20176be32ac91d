// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_gmsh_elements_h
#define corotet_mesh_gmsh_elements_h

#include <corotet/mesh/gmsh_model.h>

#include <map>
#include <string>
#include <vector>

/**
 * The types of elements in a model of gmsh.
 */
namespace corotet::gmsh_elements
{
  /// The number of nodes of elements, by gmsh's number of their type.
  using NodeNumbers = std::map<int, std::size_t>;
  /// The elements that a model may have, of degree 1, 2 and 3; their corners
  /// are the first nodes.
  inline const NodeNumbers tetrahedron_nodes{{4, 4}, {11, 10}, {29, 20}};
  inline const NodeNumbers triangle_nodes{{2, 3}, {9, 6}, {21, 10}};
  inline const NodeNumbers line_nodes{{1, 2}, {8, 3}, {26, 4}};
  inline const NodeNumbers point_nodes{{15, 1}};

  /// The tetrahedra of a model, which are all of one type.
  struct Tetrahedra
  {
    /// gmsh's number of the type.
    int type;
    /// The degree of the map from the reference cell: 1, 2 or 3.
    unsigned int degree;
    /// The positions in gmsh's order of the nodes of FE_SimplexP(degree).
    std::vector<unsigned int> order;
  };

  /// The tetrahedra of @p model. Throws InputError, blamed on the file @p path,
  /// if there are no tetrahedra, several types of them, or other cells.
  Tetrahedra
  tetrahedra(const GmshModel &model, const std::string &path);
} // namespace corotet::gmsh_elements

#endif
