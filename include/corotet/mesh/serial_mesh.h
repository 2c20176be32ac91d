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
    /// The value of Cell::curve for a straight cell.
    static constexpr unsigned int straight =
      std::numeric_limits<unsigned int>::max();

    /// A tetrahedron and its region: p3 sees the triangle p0 p1 p2
    /// counter-clockwise [seed, 2.1.2.1].
    struct Cell
    {
      std::array<unsigned int, 4> vertices;
      unsigned int                region;
      /// The number among the curved cells, or straight.
      unsigned int curve = straight;
    };

    std::vector<dealii::Point<3>> vertices;
    std::vector<Cell>             cells;

    /// The degree q of the maps from the reference tetrahedron to curved cells:
    /// 2 or 3, or 1 if there are none.
    unsigned int geometry_degree = 1;
    /// The images of the support points of FE_SimplexP(q), one curved cell
    /// after another. The first four are the cell's vertices.
    std::vector<dealii::Point<3>> curved_nodes;

    /// The number of nodes of the map of a curved cell.
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

    /// An edge of a cell, and the id of a name. An edge with several names is
    /// listed with each of their ids.
    struct Edge
    {
      std::array<unsigned int, 2> vertices;
      unsigned int                id;
    };

    /// A vertex of a cell, and the id of a name. A vertex with several names is
    /// listed with each of their ids.
    struct Corner
    {
      unsigned int vertex;
      unsigned int id;
    };

    /// The faces on the surface that belong to a named boundary. Other faces
    /// need not be listed.
    std::vector<Face> faces;
    /// The named edges and vertices, on the surface or inside of the body.
    std::vector<Edge>   edges;
    std::vector<Corner> corners;

    /// The number of refinements that the source has made by itself.
    unsigned int n_refinements = 0;

    /// The names of regions, boundaries, edges and corners. An id without a
    /// name is known by its number only.
    NamedSets regions;
    NamedSets boundaries;
    NamedSets edge_names;
    NamedSets corner_names;

    /// The file that an error in the mesh is blamed on; empty for a generated
    /// mesh.
    std::string origin;

    /// The wall time of reading or making the mesh [s].
    double read_time = 0;

    /// Whether the file says that lengths are in millimetres, as those of CAD
    /// programs do.
    bool is_in_millimetres = false;

    /// Remarks for the user about how the mesh was made: lines for the log.
    std::vector<std::string> remarks;
    /// The ids of curved boundaries with straight cells, which one of the
    /// remarks is about, see remark_facets().
    std::set<unsigned int> faceted;
  };
} // namespace corotet

#endif
