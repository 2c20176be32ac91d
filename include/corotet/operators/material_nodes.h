// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_material_nodes_h
#define corotet_operators_material_nodes_h

#include <corotet/base/vector.h>
#include <corotet/discretization/discretization.h>
#include <corotet/operators/node_numbers.h>

#include <deal.II/base/array_view.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace corotet
{
  /**
   * The nodes of a discretization, with a copy for each group of cells that
   * meets there: the cells of one material that belong to one of the
   * ConnectedParts. They are for functions that are continuous within each
   * group and jump from one to the next, as stress does from material to
   * material, and between parts that only a hinge connects. Numbers are local:
   * owned copies first, then ghosts. A copy has the owner of its node.
   *
   * @p discretization must outlive this object.
   */
  class MaterialNodes
  {
  public:
    /// @p material_of_cell gives the material of a local cell, a number below
    /// @p n_materials, which is the same on all ranks. Collective.
    MaterialNodes(
      const Discretization                                  &discretization,
      const unsigned int                                     n_materials,
      const std::function<unsigned int(const unsigned int)> &material_of_cell);

    /// Throws InputError if @p n_copies nodes of all ranks, one for each group,
    /// with six numbers each, exceed the range of deal.II's index
    /// type.
    static void
    check_number(const std::uint64_t n_copies);

    /// Local numbers of the nodes of a local cell, for its group.
    dealii::ArrayView<const unsigned int>
    cell_nodes(const unsigned int cell) const
    {
      const std::size_t n = discretization.n_nodes_per_cell();
      return {nodes_of_cells.data() + cell * n, n};
    }

    unsigned int
    n_owned() const
    {
      return partitioner->locally_owned_size() / 6;
    }

    /// Number of owned copies and ghosts.
    unsigned int
    n_local() const
    {
      return copies.size();
    }

    /// The numbers of these nodes on all ranks; local ones are the same.
    /// Collective.
    NodeNumbers
    numbers() const;

    /// The group of a local cell. Groups with a node in common have different
    /// numbers, which are the same on all ranks.
    unsigned int
    group(const unsigned int cell) const
    {
      return group_of_cell[cell];
    }

    /// The material of a group.
    unsigned int
    material(const unsigned int group) const
    {
      return group / n_colours;
    }

    /// The discretization's node and the group of each copy, with ghosts.
    struct Copy
    {
      unsigned int node;
      unsigned int group;

      auto
      operator<=>(const Copy &) const = default;
    };

    const Copy &
    copy(const unsigned int n) const
    {
      return copies[n];
    }

    /// Gives @p vector six numbers for each of these nodes (with ghost
    /// entries), all zero.
    void
    initialize_vector(Vector &vector) const
    {
      vector.reinit(partitioner);
    }

  private:
    const Discretization                                      &discretization;
    unsigned int                                               n_colours;
    std::vector<unsigned int>                                  group_of_cell;
    std::vector<unsigned int>                                  nodes_of_cells;
    std::vector<Copy>                                          copies;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
  };
} // namespace corotet

#endif
