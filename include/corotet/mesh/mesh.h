// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_h
#define corotet_mesh_mesh_h

#include <corotet/base/log.h>
#include <corotet/base/selectable.h>
#include <corotet/mesh/local_mesh.h>
#include <corotet/mesh/mesh_names.h>
#include <corotet/mesh/mesh_source.h>
#include <corotet/mesh/selections.h>

#include <deal.II/base/array_view.h>
#include <deal.II/distributed/fully_distributed_tria.h>

#include <memory>
#include <string>

namespace corotet
{
  enum class Partitioner;

  /**
   * The parameters of section Mesh: the source, uniform refinements, a scale
   * and the distribution of cells; and the parameters of section Selections,
   * which SelectionParameters declares.
   */
  struct MeshParameters
  {
    MeshParameters();

    void
    declare_parameters(dealii::ParameterHandler &prm);

    Selectable<MeshSource> source;
    unsigned int           n_refinements = 0;
    double                 scale         = 1;
    /// The partitioner; the default is the first value, the curve.
    Partitioner         partitioner{};
    SelectionParameters selections;
  };

  /**
   * A checked tetrahedral mesh, distributed over the ranks of a communicator.
   * All cells are on level 0 (refinements are flattened), in an order that
   * keeps neighbours close in memory. Lengths are in metres.
   */
  class Mesh
  {
  public:
    /**
     * Makes the mesh on rank 0 and distributes it, or reads it on all ranks if
     * its source can; then checks it, refines it and logs its statistics. @p
     * folder is the folder of the parameter file. Folds of curved cells that
     * elements of degree @p element_degree do not use are allowed. Throws
     * InputError. Collective.
     */
    Mesh(const MeshParameters &parameters,
         const std::string    &folder,
         const MPI_Comm        comm,
         Log                  &log,
         const unsigned int    element_degree = 3);

    /// Does the same with a mesh that exists already; only that of rank 0 is
    /// used.
    Mesh(SerialMesh         mesh,
         const unsigned int n_refinements,
         const double       scale,
         const MPI_Comm     comm,
         Log               &log,
         const unsigned int element_degree = 3);

    /// This rank's part of the mesh: its own cells and those beside them.
    const LocalMesh &
    local() const
    {
      return local_mesh;
    }

    /**
     * The mesh for deal.II's tools, with the cells in the same order. It is
     * made at the first call, which is collective and takes longer than the
     * rest of the set-up. Cells carry the region as material id and the
     * surface's faces the boundary as boundary id, or unnamed_boundary
     * (mesh_names.h) if they belong to none.
     */
    const dealii::parallel::fullydistributed::Triangulation<3> &
    triangulation() const;

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

    /// The names of boundaries, edges and corners.
    const PlaceNames &
    places() const
    {
      return place_names;
    }

    /// The named edges of the owned cells, in ascending order of the cells.
    const std::vector<CellPart> &
    named_edges() const
    {
      return local_mesh.edges;
    }

    /// The named vertices of the owned cells, in ascending order of the cells.
    const std::vector<CellPart> &
    named_corners() const
    {
      return local_mesh.corners;
    }

    /// Wall times [s] on rank 0: of reading or making the mesh, and of
    /// checking, sorting and distributing its cells.
    double
    read_time() const
    {
      return seconds_read;
    }

    double
    partition_time() const
    {
      return seconds_partition;
    }

    MPI_Comm
    communicator() const
    {
      return local_mesh.communicator;
    }

    /// The degree q of the maps of curved cells; 1 if there are none.
    unsigned int
    geometry_degree() const
    {
      return local_mesh.geometry_degree;
    }

    /**
     * The images of the support points of FE_SimplexP(q) under the map of a
     * local cell, owned or ghost; none if it is straight.
     */
    dealii::ArrayView<const dealii::Point<3>>
    curved_nodes(const unsigned int cell) const
    {
      const unsigned int curve = local_mesh.cells[cell].curve;
      if (curve == SerialMesh::straight)
        return {};
      const std::size_t n = local_mesh.n_map_nodes();
      return {local_mesh.curved_nodes.data() + n * curve, n};
    }

  private:
    /// The last part of all constructors: the cells of @p mesh still have to be
    /// checked, refined @p n_refinements times, scaled and sorted.
    void
    set_up(SpreadMesh          &&mesh,
           const unsigned int    n_refinements,
           const MeshParameters &parameters,
           const MPI_Comm        comm,
           Log                  &log,
           const unsigned int    element_degree);

    /// Distributes the cells to ranks by PT-Scotch.
    void
    share_out_by_graph(const std::string &origin, Log &log);

    /// Checks that named boundaries are on the surface. Throws InputError.
    /// Collective.
    void
    check_boundaries(const std::string &origin) const;

    double     seconds_read      = 0;
    double     seconds_partition = 0;
    LocalMesh  local_mesh;
    MeshNames  region_names;
    PlaceNames place_names;

    mutable std::unique_ptr<
      const dealii::parallel::fullydistributed::Triangulation<3>>
      tria;
  };
} // namespace corotet

#endif
