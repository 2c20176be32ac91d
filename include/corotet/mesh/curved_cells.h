// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_curved_cells_h
#define corotet_mesh_curved_cells_h

#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/serial_mesh.h>

#include <deal.II/base/table.h>
#include <deal.II/fe/fe.h>

#include <cstdint>
#include <string>
#include <vector>

namespace corotet
{
  /// The element FE_SimplexP(@p degree), for degrees 1, 2, 3. Each is made once
  /// and lives as long as the program, as making it takes longer than many of
  /// its uses.
  const dealii::FiniteElement<3> &
  map_element(const unsigned int degree);

  /**
   * Polynomial maps x(xi) of one degree q, at fixed points of the reference
   * tetrahedron. A map is given by its nodes: the images of the support points
   * of FE_SimplexP(q).
   */
  class MapAtPoints
  {
  public:
    MapAtPoints(const unsigned int                   degree,
                const std::vector<dealii::Point<3>> &points);

    unsigned int
    n_nodes() const
    {
      return values.size(1);
    }

    unsigned int
    n_points() const
    {
      return values.size(0);
    }

    /// The position x at point @p q.
    dealii::Point<3>
    position(const dealii::Point<3> *nodes, const unsigned int q) const
    {
      dealii::Point<3> x;
      for (unsigned int i = 0; i < n_nodes(); ++i)
        x += values[q][i] * nodes[i];
      return x;
    }

    /// The Jacobian dx_a / dxi_k at point @p q.
    dealii::Tensor<2, 3>
    jacobian(const dealii::Point<3> *nodes, const unsigned int q) const
    {
      dealii::Tensor<2, 3> J;
      for (unsigned int i = 0; i < n_nodes(); ++i)
        J += outer_product(nodes[i], gradients[q][i]);
      return J;
    }

  private:
    dealii::Table<2, double>               values;
    dealii::Table<2, dealii::Tensor<1, 3>> gradients;
  };

  /// The support points of FE_SimplexP(@p degree): the vertices come first.
  std::vector<dealii::Point<3>>
  map_points(const unsigned int degree);

  /// The nodes of the map of a curved cell of @p mesh.
  const dealii::Point<3> *
  curved_nodes(const MeshCells &mesh, const MeshCells::Cell &cell);

  /// Removes the maps of cells that are straight up to round-off.
  void
  remove_straight_maps(MeshCells &mesh);

  /// Like remove_straight_maps(), for coordinates from a file, which may have
  /// few digits: cells that are straight up to these digits become straight.
  /// Returns a remark if few digits were the reason, or an empty text.
  std::string
  remove_written_straight_maps(MeshCells &mesh);

  /// To be called before @p nodes of a file are moved, which changes their
  /// digits: moves the nodes of those of @p cells that are straight up to the
  /// digits of the file to their straight positions. Each cell has the nodes of
  /// a map of degree @p degree. Returns a remark like
  /// remove_written_straight_maps().
  std::string
  straighten_written_cells(std::vector<dealii::Point<3>>    &nodes,
                           const std::vector<std::uint32_t> &cells,
                           const unsigned int                degree);

  /**
   * The smallest determinant of the Jacobian of curved cells divided by its
   * mean in the cell [-]: 1 for a straight cell; infinity if no cell is curved.
   * Throws InputError, as check_mesh() does, unless it is positive. Checks the
   * points with barycentric coordinates i / 6, for the interpolants of the map
   * (and the map itself) with degrees from 2 to @p element_degree: elements use
   * no other maps, and those of degree 1 none. The result is for the cells of
   * all ranks. Collective.
   */
  double
  check_curved_cells(const MeshCells   &mesh,
                     const std::string &origin,
                     const unsigned int element_degree,
                     const MPI_Comm     comm);

  /// Throws InputError, as check_mesh() does, if cells that share an edge or a
  /// face have different nodes on it. Looks at the cells of @p mesh only.
  void
  check_common_nodes(const MeshCells &mesh, const std::string &origin);

  /// The sum of the volumes of curved cells minus those of the straight cells
  /// with the same vertices [m^3]. Exact.
  double
  volume_by_curvature(const MeshCells &mesh);
} // namespace corotet

#endif
