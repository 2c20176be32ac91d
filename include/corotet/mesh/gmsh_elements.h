// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_gmsh_elements_h
#define corotet_mesh_gmsh_elements_h

#include <string>
#include <vector>

/**
 * The kinds of elements that gmsh's current model has.
 */
namespace corotet::gmsh_elements
{
  /// The tetrahedra of a model, which are all of one kind.
  struct Tetrahedra
  {
    /// gmsh's number of the type.
    int type;
    /// Of the map from the reference cell: 1, 2 or 3.
    unsigned int degree;
    /// Where gmsh has the nodes that FE_SimplexP(degree) has.
    std::vector<unsigned int> order;
  };

  /// Throws InputError, blamed on the file @p path, if there are no tetrahedra,
  /// several kinds of them, or other cells.
  Tetrahedra
  tetrahedra(const std::string &path);

  /// Tags of the surfaces of volumes that are curved, by the geometry: its
  /// normals at the mesh's nodes differ by more than 1e-3. None if there is no
  /// geometry, but a mesh only.
  std::vector<int>
  curved_surfaces();

  /// Tags of the corners of all triangles of a surface of the geometry, of
  /// whatever degree: three for each.
  std::vector<std::size_t>
  triangles(const int entity);
} // namespace corotet::gmsh_elements

#endif
