// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_quality_h
#define corotet_mesh_mesh_quality_h

#include <corotet/mesh/serial_mesh.h>

#include <mpi.h>

namespace corotet
{
  /**
   * Figures that tell whether a mesh has the intended size and how well its
   * cells are shaped.
   */
  struct MeshQuality
  {
    /// The sum of the volumes of the cells [m^3].
    double volume = 0;
    /// The smallest angle between two faces of a cell [degree]. At most 70.53,
    /// the angle in the regular tetrahedron.
    double smallest_dihedral_angle = 180;
    /// The largest aspect ratio: the longest edge of a cell over 2 sqrt(6)
    /// times the radius of its inscribed sphere, which is 1 for the regular
    /// tetrahedron and larger for all others.
    double worst_aspect_ratio = 1;
  };

  /// The figures of one cell.
  struct CellShape
  {
    /// The volume [m^3], negative if the cell is inverted.
    double volume;
    /// The cosines of the angles between two faces.
    std::array<double, 6> dihedral_cosines;
    double                aspect_ratio;
  };

  /**
   * The volume of the tetrahedron with these vertices [m^3], negative if p3
   * sees the triangle p0 p1 p2 clockwise.
   */
  double
  signed_volume(const std::array<dealii::Point<3>, 4> &p);

  /// The square of the longest edge of a tetrahedron [m^2].
  double
  square_of_longest_edge(const std::array<dealii::Point<3>, 4> &p);

  /// The shape of a tetrahedron, whose volume must be positive.
  CellShape
  cell_shape(const std::array<dealii::Point<3>, 4> &p);

  /// The vertices of a cell of @p mesh.
  std::array<dealii::Point<3>, 4>
  cell_vertices(const MeshCells &mesh, const MeshCells::Cell &cell);

  /// The quality of the cells of all ranks, whose volumes must be positive.
  /// Angles and aspect ratios are those of the straight cells with the same
  /// vertices. Collective.
  MeshQuality
  mesh_quality(const MeshCells &mesh, const MPI_Comm comm = MPI_COMM_SELF);
} // namespace corotet

#endif
