// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_check_mesh_h
#define corotet_mesh_check_mesh_h

#include <corotet/mesh/local_mesh.h>

#include <mpi.h>

namespace corotet
{
  /**
   * Makes sure that a mesh can be computed on, or throws an InputError that
   * says what is wrong and where (in the coordinates of @p mesh):
   * - there are cells, and indices of vertices are in range;
   * - every volume is positive, that of the straight cell with the vertices of
   *   a curved one, too, and curved cells have no folds that elements of degree
   *   @p element_degree use;
   * - curved cells have the same nodes on common edges and faces;
   * - a triangle belongs to one cell, or to two that lie on its two sides;
   * - no two vertices of the surface coincide, and nowhere does the surface
   *   touch itself other than in shared vertices and edges. (Where cells do not
   *   fit together, at a hanging node or along an unglued interface, there are
   *   two layers of surface.)
   * - listed faces are faces of cells, and each has one boundary.
   *
   * Listed faces inside the body (a named interface of two regions) are removed
   * with a remark, and so are named edges and corners that belong to no cell.
   */
  void
  check_mesh(SerialMesh &mesh, const unsigned int element_degree = 3);

  /// The part of check_mesh() that checks coordinates and indices of vertices,
  /// with check_curves().
  void
  check_vertices(const SerialMesh &mesh);

  /// The part of check_mesh() that checks that each curved cell has the nodes
  /// of one map, finite and the first four the cell's vertices.
  void
  check_curves(const MeshCells &mesh, const std::string &origin);

  /// The part of check_mesh() that checks volumes and folds, for a mesh that is
  /// spread over the ranks. Returns the result of check_curved_cells().
  /// Collective.
  double
  check_cells_on_ranks(const MeshPart    &part,
                       const std::string &origin,
                       const unsigned int element_degree,
                       const MPI_Comm     comm);

  /// The largest number of cells that may be refined @p n_refinements times.
  double
  largest_number_of_cells(const unsigned int n_refinements);

  /// Throws an InputError if so many cells, refined so often, are too many.
  void
  check_number_of_cells(const std::size_t  n_cells,
                        const unsigned int n_refinements);

  /**
   * Throws the InputError with @p message about a mesh. It blames the file @p
   * origin or, if that is empty and so the mesh was generated, the parameter
   * that chose its generator.
   */
  [[noreturn]] void
  refuse_mesh(const std::string &origin, const std::string &message);

  /// The text of a point in messages.
  std::string
  position(const dealii::Point<3> &p);

  /// The vertices of a triangle.
  using Triangle = std::array<unsigned int, 3>;

  /// The centre of the triangle with these vertices.
  dealii::Point<3>
  centre(const MeshCells &mesh, const Triangle &triangle);

  /// The text of a boundary in messages.
  std::string
  boundary_name(const SerialMesh &mesh, const unsigned int id);
} // namespace corotet

#endif
