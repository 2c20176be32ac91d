// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_serial_mesh_h
#define corotet_mesh_serial_mesh_h

#include <corotet/mesh/mesh_names.h>

#include <deal.II/base/point.h>

#include <array>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * Tetrahedra, straight and curved, and their vertices.
   */
  struct MeshCells
  {
    /// Of a cell that is not curved.
    static constexpr unsigned int straight =
      std::numeric_limits<unsigned int>::max();

    /// A tetrahedron: p3 sees the triangle p0 p1 p2 counter-clockwise
    /// [seed, 2.1.2.1], and the region it belongs to.
    struct Cell
    {
      std::array<unsigned int, 4> vertices;
      unsigned int                region;
      /// Number among the curved cells, or straight.
      unsigned int curve = straight;
    };

    std::vector<dealii::Point<3>> vertices;
    std::vector<Cell>             cells;

    /// Degree q of the maps that make curved cells of the reference
    /// tetrahedron: 2 or 3, or 1 if there are none.
    unsigned int geometry_degree = 1;
    /// Images of the support points of FE_SimplexP(q), of one curved cell after
    /// another. The first four are the cell's vertices.
    std::vector<dealii::Point<3>> curved_nodes;

    /// Nodes of the map of a curved cell.
    unsigned int
    n_map_nodes() const
    {
      const unsigned int q = geometry_degree;
      return (q + 1) * (q + 2) * (q + 3) / 6;
    }
  };

  /**
   * A tetrahedral mesh as a MeshSource makes it: whole, on one rank, not yet
   * checked.
   */
  struct SerialMesh : MeshCells
  {
    /// A triangle of the surface (in any orientation), and the boundary it
    /// belongs to.
    struct Face
    {
      std::array<unsigned int, 3> vertices;
      unsigned int                boundary;
    };

    /// An edge of a cell, and the id of a name. One that has several names is
    /// listed with each of their ids.
    struct Edge
    {
      std::array<unsigned int, 2> vertices;
      unsigned int                id;
    };

    /// A vertex of a cell, and the id of a name, in the same way.
    struct Corner
    {
      unsigned int vertex;
      unsigned int id;
    };

    /// Faces on the surface that belong to a named boundary. Others need not be
    /// listed.
    std::vector<Face> faces;
    /// Those that have names, on the surface or inside of the body.
    std::vector<Edge>   edges;
    std::vector<Corner> corners;

    /// How often the source has refined the mesh by itself.
    unsigned int n_refinements = 0;

    /// What regions and boundaries are called. Those that the source gives no
    /// name are known by their ids only.
    NamedSets regions;
    NamedSets boundaries;
    NamedSets edge_names;
    NamedSets corner_names;

    /// What an error in the mesh is blamed on: a file name, or empty for a
    /// generated mesh.
    std::string origin;

    /// Wall time [s] that reading or making it took.
    double read_time = 0;

    /// Whether the file says so, as those of CAD programs do.
    bool is_in_millimetres = false;

    /// What the user should know about how the mesh was made: lines for the
    /// log.
    std::vector<std::string> remarks;
    /// What one of them is about, remark_facets(): ids of curved boundaries
    /// with straight cells.
    std::set<unsigned int> faceted;
  };
} // namespace corotet

#endif
