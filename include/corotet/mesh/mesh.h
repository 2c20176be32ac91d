// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_h
#define corotet_mesh_mesh_h

#include <corotet/base/log.h>
#include <corotet/base/selectable.h>
#include <corotet/mesh/distributed_triangulation.h>
#include <corotet/mesh/edges.h>
#include <corotet/mesh/mesh_names.h>
#include <corotet/mesh/mesh_source.h>
#include <corotet/mesh/selections.h>

#include <deal.II/base/array_view.h>

#include <string>

namespace corotet
{
  /**
   * The parameters of section Mesh: the source, uniform refinements and a
   * scale; and those of section Selections, which declares its own.
   */
  struct MeshParameters
  {
    MeshParameters();

    void
    declare_parameters(dealii::ParameterHandler &prm);

    Selectable<MeshSource> source;
    unsigned int           n_refinements = 0;
    double                 scale         = 1;
    SelectionParameters    selections;
  };

  /**
   * A checked tetrahedral mesh, distributed over the ranks of a communicator.
   * All cells are on level 0 (refinements are flattened), in an order that
   * keeps neighbours close in memory. Lengths in metres.
   */
  class Mesh
  {
  public:
    /**
     * Makes the mesh on rank 0, checks it, logs its statistics and distributes
     * it. @p folder is that of the parameter file. Folds of curved cells that
     * elements of degree @p element_degree do not use are allowed. Throws
     * InputError. Collective.
     */
    Mesh(const MeshParameters &parameters,
         const std::string    &folder,
         const MPI_Comm        comm,
         Log                  &log,
         const unsigned int    element_degree = 3);

    /// The same for a mesh that is already made (it is read on rank 0 only).
    Mesh(SerialMesh                 mesh,
         const unsigned int         n_refinements,
         const double               scale,
         const MPI_Comm             comm,
         Log                       &log,
         const unsigned int         element_degree = 3,
         const SelectionParameters &selections     = {});

    /// Cells carry the region as material id and the surface's faces the
    /// boundary as boundary id, or unnamed_boundary (triangulation.h) where
    /// they belong to none.
    const dealii::parallel::fullydistributed::Triangulation<3> &
    triangulation() const
    {
      return tria;
    }

    const MeshNames &
    regions() const
    {
      return region_names;
    }

    const MeshNames &
    boundaries() const
    {
      return place_names.boundaries;
    }

    /// Of boundaries, edges and corners.
    const PlaceNames &
    places() const
    {
      return place_names;
    }

    /// Edges with names of the owned cells, which are called by their
    /// active_cell_index(), in ascending order.
    const std::vector<CellPart> &
    named_edges() const
    {
      return edges_of_cells;
    }

    /// Vertices with names, in the same way.
    const std::vector<CellPart> &
    named_corners() const
    {
      return corners_of_cells;
    }

    MPI_Comm
    communicator() const
    {
      return tria.get_communicator();
    }

    /// Degree q of the maps of curved cells; 1 if there are none. The
    /// triangulation has the straight cells with the same vertices.
    unsigned int
    geometry_degree() const
    {
      return curve_degree;
    }

    /**
     * Images of the support points of FE_SimplexP(q) under the map of a curved
     * cell, owned or ghost, that the triangulation gives this
     * active_cell_index(); none if it is straight.
     */
    dealii::ArrayView<const dealii::Point<3>>
    curved_nodes(const unsigned int cell) const
    {
      if (curve_degree == 1 || curves[cell] == SerialMesh::straight)
        return {};
      const std::size_t n = n_curved_nodes();
      return {nodes_of_curves.data() + n * curves[cell], n};
    }

  private:
    /// Of a curved cell.
    unsigned int
    n_curved_nodes() const
    {
      return (curve_degree + 1) * (curve_degree + 2) * (curve_degree + 3) / 6;
    }

    DistributedTriangulation tria;
    MeshNames                region_names;
    PlaceNames               place_names;
    std::vector<CellPart>    edges_of_cells;
    std::vector<CellPart>    corners_of_cells;

    unsigned int curve_degree = 1;
    /// Number of each active cell among the curved ones, or
    /// SerialMesh::straight; empty if there are none.
    std::vector<unsigned int>     curves;
    std::vector<dealii::Point<3>> nodes_of_curves;
  };
} // namespace corotet

#endif
