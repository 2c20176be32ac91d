// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_discretization_h
#define corotet_discretization_discretization_h

#include <corotet/discretization/nodes.h>
#include <corotet/discretization/reference_element.h>
#include <corotet/mesh/mesh.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_fe.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace corotet
{
  struct LocalNodes;

  /**
   * The geometry of a cell: x = p0 + J xi, with xi in the reference
   * tetrahedron; for a curved cell J is the Jacobian at its centre.
   */
  struct CellGeometry
  {
    /// Rows are the gradients of the reference coordinates xi_k with respect to
    /// x: J^{-1}. Unit 1/m.
    dealii::Tensor<2, 3> inverse_jacobian;
    /// Volume in m^3, positive.
    double volume;
    /// The region of the cell, as the mesh numbers it.
    unsigned int region;
  };

  /**
   * A triangle of the body's surface that belongs to a locally owned cell.
   */
  struct BoundaryFace
  {
    unsigned int cell;
    /// Number of the face in the cell, 0 to 3, as corners_of_faces and
    /// dealii::ReferenceCells::Tetrahedron number it.
    unsigned int face;
    unsigned int boundary;
  };

  /**
   * Continuous tetrahedral elements for a displacement: FESystem of three
   * FE_SimplexP(p), p = 1, 2, 3, or FE_SimplexP_Bubbles(2), on a distributed
   * mesh.
   *
   * Curved cells have the mesh's map, or if that is of a higher degree than the
   * element, its interpolant of the element's degree: so positions are finite
   * element functions, x = sum_i N_i(xi) X_i with the positions X_i of the
   * nodes, in every cell.
   *
   * @p mesh must outlive this object.
   */
  class Discretization : public Nodes
  {
  public:
    /// Throws InputError if a curved cell is folded at its centre or a
    /// quadrature point. Collective.
    Discretization(const Mesh &mesh, const Element element);

    const Mesh &
    mesh() const
    {
      return *mesh_pointer;
    }

    dealii::types::global_dof_index
    n_global_cells() const
    {
      return mesh_pointer->local().n_global_cells;
    }

    /// The geometry of a local cell; computed at each call, except for curved
    /// cells.
    CellGeometry
    geometry(const unsigned int cell) const;

    /// The volume of the body at rest, on all ranks together [m^3].
    double
    volume() const
    {
      return body_volume;
    }

    /// The region of a local cell, as the mesh numbers it.
    unsigned int
    region(const unsigned int cell) const
    {
      return mesh_pointer->local().cells[local_mesh_cells[cell]].region;
    }

    bool
    is_curved(const unsigned int cell) const
    {
      return !curved_cells.empty() && curved_cells[cell] != 0;
    }

    /// The Jacobian dx / dxi of a cell, straight or curved, at point @p q of a
    /// rule with this element's functions.
    dealii::Tensor<2, 3>
    jacobian(const unsigned int                   cell,
             const ReferenceElement::PointValues &rule,
             const unsigned int                   q) const
    {
      const auto             nodes  = cell_nodes(cell);
      const dealii::Point<3> origin = node_position(nodes[0]);
      dealii::Tensor<2, 3>   J;
      for (unsigned int i = 1; i < nodes.size(); ++i)
        {
          const dealii::Tensor<1, 3> x = node_position(nodes[i]) - origin;
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int k = 0; k < 3; ++k)
              J[a][k] += x[a] * rule.gradients[q][i][k];
        }
      return J;
    }

    /// The number of local cell @p cell in the mesh's LocalMesh.
    unsigned int
    cell_in_local_mesh(const unsigned int cell) const
    {
      return local_mesh_cells[cell];
    }

    /// The number of local cell @p cell in the whole mesh, whatever its
    /// partition.
    dealii::types::coarse_cell_id
    mesh_cell(const unsigned int cell) const
    {
      return mesh_pointer->local().numbers[local_mesh_cells[cell]];
    }

    /// The faces of the body's surface that belong to owned cells.
    const std::vector<BoundaryFace> &
    boundary_faces() const
    {
      return surface;
    }

    /// The faces of a boundary, or with unnamed_boundary those that belong to
    /// none.
    const std::vector<BoundaryFace> &
    boundary_faces(const unsigned int boundary) const
    {
      static const std::vector<BoundaryFace> none;
      const auto found = faces_of_boundaries.find(boundary);
      return found == faces_of_boundaries.end() ? none : found->second;
    }

    /// The faces of ghost cells on boundaries that have a number in the mesh,
    /// and those on the rest of the surface that have a corner of an own cell.
    const std::vector<BoundaryFace> &
    ghost_boundary_faces() const
    {
      return surface_of_ghosts;
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

    /// The lower and upper corner of the box around the body's nodes at rest in
    /// m, the same on any number of ranks. Collective.
    std::pair<dealii::Point<3>, dealii::Point<3>>
    bounding_box() const;

    const dealii::FESystem<3> &
    finite_element() const
    {
      return fe;
    }

    /// deal.II's mapping of straight cells.
    const dealii::MappingFE<3> &
    mapping() const
    {
      return linear_mapping;
    }

    /// A DoFHandler for deal.II's tools; its numbering is the one described
    /// above. It is made, like its triangulation, at the first call, which is
    /// collective.
    const dealii::DoFHandler<3> &
    dof_handler() const;

  private:
    /// Puts all cells of the LocalMesh into the order of Nodes.
    void
    order_cells(const LocalNodes &nodes);
    /// Puts nearby cells of the same kind, curved or straight, side by side, so
    /// that no register has cells of both kinds.
    void
    gather_curved(std::vector<unsigned int> &cells);
    /// The global numbers of the nodes.
    std::vector<dealii::types::global_dof_index>
    number_nodes(const LocalNodes &nodes);
    void
    make_partitioner(
      const LocalNodes                                   &nodes,
      const std::vector<dealii::types::global_dof_index> &numbers);
    void
    set_up_cells();
    /// Computes the positions of the nodes of curved cells.
    void
    curve_positions();
    /// Computes the geometries of curved cells, and the numbers for kernels.
    void
    set_up_curved_cells();

    const Mesh          *mesh_pointer;
    dealii::FESystem<3>  fe;
    dealii::MappingFE<3> linear_mapping;

    std::vector<unsigned int> local_mesh_cells;
    /// Geometries by local cell, set for curved cells only; empty if there are
    /// none.
    std::vector<CellGeometry> curved_geometries;
    std::vector<BoundaryFace> surface;
    std::vector<BoundaryFace> surface_of_ghosts;
    /// The surface's faces by boundary.
    std::map<unsigned int, std::vector<BoundaryFace>> faces_of_boundaries;
    Vector                                            positions;
    double                                            body_volume = 0;
    /// Whether each local cell is curved; empty if no cell of any rank is.
    std::vector<unsigned char> curved_cells;

    mutable std::unique_ptr<dealii::DoFHandler<3>> dofs;
  };
} // namespace corotet

#endif
