// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_quality_h
#define corotet_mesh_mesh_quality_h

#include <corotet/mesh/serial_mesh.h>

#include <mpi.h>

namespace corotet
{
  /**
   * Figures that tell whether a mesh is what its user meant, and how well it is
   * shaped.
   */
  struct MeshQuality
  {
    /// Sum over the cells, in m^3.
    double volume = 0;
    /// Between two faces of a cell, in degrees. At most 70.53, that of the
    /// regular tetrahedron.
    double smallest_dihedral_angle = 180;
    /// Longest edge of a cell over 2 sqrt(6) times the radius of its inscribed
    /// sphere: 1 for the regular tetrahedron, larger for all others.
    double worst_aspect_ratio = 1;
  };

  /// The same of one cell.
  struct CellShape
  {
    /// In m^3, negative if it is inverted.
    double volume;
    /// Cosines of the angles between two faces.
    std::array<double, 6> dihedral_cosines;
    double                aspect_ratio;
  };

  /**
   * Volume of the tetrahedron with these vertices in m^3, negative if p3 sees
   * the triangle p0 p1 p2 clockwise.
   */
  double
  signed_volume(const std::array<dealii::Point<3>, 4> &p);

  /// In m^2, of the tetrahedron with these vertices.
  double
  square_of_longest_edge(const std::array<dealii::Point<3>, 4> &p);

  /// Of the tetrahedron with these vertices, whose volume is positive.
  CellShape
  cell_shape(const std::array<dealii::Point<3>, 4> &p);

  /// The vertices of a cell of @p mesh.
  std::array<dealii::Point<3>, 4>
  cell_vertices(const MeshCells &mesh, const MeshCells::Cell &cell);

  /// Volumes must be positive. Angles and aspect ratios are those of the
  /// straight cells with the same vertices. Of all ranks' cells. Collective.
  MeshQuality
  mesh_quality(const MeshCells &mesh, const MPI_Comm comm = MPI_COMM_SELF);
} // namespace corotet

#endif
