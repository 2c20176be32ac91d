// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_stress_samples_h
#define corotet_operators_stress_samples_h

#include <corotet/discretization/reference_element.h>
#include <corotet/operators/material_nodes.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <map>
#include <span>
#include <vector>

namespace corotet
{
  /**
   * The samples to which polynomials are fitted: the points of the stiffness
   * rule in the local cells, and in cells that are fetched from other ranks.
   * Cells are numbered: local ones as in the discretization, then those
   * fetched.
   *
   * @p discretization and @p nodes must outlive this object.
   */
  class StressSamples
  {
  public:
    StressSamples(const Discretization   &discretization,
                  const ReferenceElement &reference,
                  const MaterialNodes    &nodes);

    /// Fetches the samples of all cells around some ghost vertices (numbers of
    /// the discretization) that are not local. To be called once. Collective.
    void
    fetch_cells_around(const std::vector<unsigned int> &ghost_vertices);

    /// Cells of a group around a local vertex, in ascending order. They are
    /// complete if the vertex is owned or cells around it were fetched.
    std::vector<unsigned int>
    cells_around(const unsigned int vertex, const unsigned int group) const;

    /// Number of the first point of a cell; the others follow.
    std::size_t
    first_point(const unsigned int cell) const
    {
      return static_cast<std::size_t>(cell) * n_points;
    }

    /// Positions at rest of a cell's points [m].
    std::span<const dealii::Point<3>>
    points(const unsigned int cell) const
    {
      return {&positions[first_point(cell)], n_points};
    }

    /// Positions at rest of a cell's vertices [m].
    const std::array<dealii::Point<3>, 4> &
    corners(const unsigned int cell) const
    {
      return corners_of_cells[cell];
    }

    /// Appends the stress at the points of the cells that were fetched to that
    /// of the local cells, cell by cell. Collective.
    void
    complete(std::vector<dealii::SymmetricTensor<2, 3>> &stresses) const;

    /// Local cells whose stress other ranks get from complete(); some occur
    /// several times.
    std::vector<unsigned int>
    cells_for_others() const;

  private:
    /// A cell of a group at one of its vertices.
    struct Incidence
    {
      unsigned int vertex;
      unsigned int group;
      unsigned int cell;

      auto
      operator<=>(const Incidence &) const = default;
    };

    using Key = std::array<dealii::types::global_dof_index, 4>;

    /// Global numbers of the vertices, by which all ranks identify a cell.
    Key
    key(const unsigned int local_cell) const;
    /// Adds a cell of another rank, given by global numbers of its vertices,
    /// its group, and positions of vertices and points.
    void
    add_cell(const Key &vertices, const unsigned int group, const double *x);

    const Discretization &discretization;
    const MaterialNodes  &nodes;
    const unsigned int    n_points;

    std::vector<dealii::Point<3>>                positions;
    std::vector<std::array<dealii::Point<3>, 4>> corners_of_cells;
    std::vector<Incidence>                       incidences;

    /// For each rank: local cells whose stress is sent to it, and cells whose
    /// stress it sends (numbers of this object, in the order in which they
    /// come).
    std::map<unsigned int, std::vector<unsigned int>> sent, received;
  };
} // namespace corotet

#endif
