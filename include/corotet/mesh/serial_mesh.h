// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_serial_mesh_h
#define corotet_mesh_serial_mesh_h

#include <deal.II/base/point.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * A tetrahedral mesh as a MeshSource makes it: whole, on one rank, not yet
   * checked.
   */
  struct SerialMesh
  {
    /// A tetrahedron: p3 sees the triangle p0 p1 p2 counter-clockwise
    /// [seed, 2.1.2.1], and the region it belongs to.
    struct Cell
    {
      std::array<unsigned int, 4> vertices;
      unsigned int                region;
    };

    /// A triangle of the surface (in any orientation), and the boundary it
    /// belongs to.
    struct Face
    {
      std::array<unsigned int, 3> vertices;
      unsigned int                boundary;
    };

    std::vector<dealii::Point<3>> vertices;
    std::vector<Cell>             cells;
    /// Faces on the surface that belong to a named boundary. Others need not be
    /// listed.
    std::vector<Face> faces;

    /// Names by id. A region or boundary that the source gives no name is known
    /// by its id only.
    std::map<unsigned int, std::string> region_names;
    std::map<unsigned int, std::string> boundary_names;

    /// What an error in the mesh is blamed on: a file name, or empty for a
    /// generated mesh.
    std::string origin;

    /// What the user should know about how the mesh was made: lines for the
    /// log.
    std::vector<std::string> remarks;
  };
} // namespace corotet

#endif
