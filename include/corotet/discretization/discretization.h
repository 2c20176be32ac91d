// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_discretization_h
#define corotet_discretization_discretization_h

#include <corotet/base/vector.h>
#include <corotet/mesh/mesh.h>

#include <deal.II/base/array_view.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_fe.h>

#include <memory>
#include <vector>

namespace corotet
{
  /**
   * Geometry of a straight-sided cell: x = p0 + J xi, with xi in the reference
   * tetrahedron.
   */
  struct CellGeometry
  {
    /// Rows are the gradients of the reference coordinates xi_k with respect to
    /// x: J^{-1}. Unit 1/m.
    dealii::Tensor<2, 3> inverse_jacobian;
    /// Volume in m^3, positive.
    double volume;
    /// Region as the mesh numbers it.
    unsigned int region;
  };

  /**
   * A triangle of the body's surface that belongs to a locally owned cell.
   */
  struct BoundaryFace
  {
    unsigned int cell;
    /// Number of the face in the cell, 0 to 3, as
    /// dealii::ReferenceCells::Tetrahedron numbers it.
    unsigned int face;
    unsigned int boundary;
  };

  /**
   * Continuous tetrahedral elements of degree p for a displacement:
   * FESystem(FE_SimplexP(p), 3) with p = 1, 2, 3 on a distributed mesh.
   *
   * Nodes are numbered such that the unknowns of node n are 3n, 3n+1, 3n+2 (x,
   * y, z), on each rank in the order in which its cells meet them. Cells, nodes
   * and unknowns are addressed by local numbers: owned cells come first, then
   * ghost cells (all that share a vertex with an owned one); owned nodes come
   * first, then ghost nodes (all others of local cells). Local node n has the
   * local unknowns 3n, 3n+1, 3n+2 of vectors made by initialize_vector().
   *
   * @p mesh must outlive this object.
   */
  class Discretization
  {
  public:
    Discretization(const Mesh &mesh, const unsigned int degree);

    const Mesh &
    mesh() const
    {
      return *mesh_pointer;
    }

    MPI_Comm
    communicator() const
    {
      return mesh_pointer->communicator();
    }

    unsigned int
    degree() const
    {
      return fe.degree;
    }

    /// (p+1)(p+2)(p+3)/6: 4, 10, 20.
    unsigned int
    n_nodes_per_cell() const
    {
      return n_cell_nodes;
    }

    unsigned int
    n_owned_cells() const
    {
      return n_owned;
    }

    /// Owned and ghost cells.
    unsigned int
    n_local_cells() const
    {
      return geometries.size();
    }

    dealii::types::global_dof_index
    n_global_cells() const
    {
      return mesh_pointer->triangulation().n_global_active_cells();
    }

    /// Local numbers of the nodes of local cell @p cell, in the order of
    /// FE_SimplexP.
    dealii::ArrayView<const unsigned int>
    cell_nodes(const unsigned int cell) const
    {
      return {nodes_of_cells.data() +
                static_cast<std::size_t>(cell) * n_cell_nodes,
              n_cell_nodes};
    }

    const CellGeometry &
    geometry(const unsigned int cell) const
    {
      return geometries[cell];
    }

    /// The surface, as far as it belongs to owned cells.
    const std::vector<BoundaryFace> &
    boundary_faces() const
    {
      return surface;
    }

    dealii::types::global_dof_index
    n_global_nodes() const
    {
      return vector_partitioner->size() / 3;
    }

    unsigned int
    n_owned_nodes() const
    {
      return vector_partitioner->locally_owned_size() / 3;
    }

    /// Owned and ghost nodes.
    unsigned int
    n_local_nodes() const
    {
      return n_owned_nodes() + vector_partitioner->n_ghost_indices() / 3;
    }

    /// Global number of a local node. Owned nodes are consecutive.
    dealii::types::global_dof_index
    global_node(const unsigned int local_node) const
    {
      return vector_partitioner->local_to_global(3 * local_node) / 3;
    }

    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    partitioner() const
    {
      return vector_partitioner;
    }

    /// Makes @p vector one of unknowns with ghost entries for all local nodes;
    /// all zero.
    void
    initialize_vector(Vector &vector) const
    {
      vector.reinit(vector_partitioner);
    }

    /// Positions of the nodes at rest in m, ghosts included.
    const Vector &
    node_positions() const
    {
      return positions;
    }

    dealii::Point<3>
    node_position(const unsigned int local_node) const
    {
      return {positions.local_element(3 * local_node),
              positions.local_element(3 * local_node + 1),
              positions.local_element(3 * local_node + 2)};
    }

    const dealii::FESystem<3> &
    finite_element() const
    {
      return fe;
    }

    const dealii::MappingFE<3> &
    mapping() const
    {
      return linear_mapping;
    }

    /// For deal.II's tools; its numbering is the one described above.
    const dealii::DoFHandler<3> &
    dof_handler() const
    {
      return dofs;
    }

  private:
    void
    renumber_nodes_by_cells();
    void
    set_up_cells();

    const Mesh           *mesh_pointer;
    dealii::FESystem<3>   fe;
    dealii::MappingFE<3>  linear_mapping;
    dealii::DoFHandler<3> dofs;
    unsigned int          n_cell_nodes;
    unsigned int          n_owned = 0;

    std::vector<CellGeometry> geometries;
    std::vector<unsigned int> nodes_of_cells;
    std::vector<BoundaryFace> surface;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
           vector_partitioner;
    Vector positions;
  };
} // namespace corotet

#endif
