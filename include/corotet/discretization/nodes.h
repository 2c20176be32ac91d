// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_nodes_h
#define corotet_discretization_nodes_h

#include <corotet/base/vector.h>
#include <corotet/discretization/element.h>

#include <deal.II/base/partitioner.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <typeindex>
#include <utility>
#include <vector>

namespace corotet
{
  class CellBatches;

  /**
   * A node that several chunks of cells have, and the slot where their
   * contributions to it are added up (CellBatches).
   */
  struct PartialSum
  {
    unsigned int node;
    unsigned int slot;
  };

  /**
   * The local numbers of the nodes of a cell, in the order of the element. They
   * are kept as a list, or as numbers in a chunk of cells (CellBatches).
   */
  class CellNodes
  {
  public:
    CellNodes(const unsigned int *list, const unsigned int n)
      : list(list)
      , n(n)
    {}

    /// A list of numbers in a chunk. Node i has the number k = numbers[stride
    /// i] there: it is first_node + k if k < @p n_final, open[k - n_final]
    /// otherwise.
    CellNodes(const std::uint16_t *numbers,
              const unsigned int   stride,
              const unsigned int   n,
              const unsigned int   first_node,
              const unsigned int   n_final,
              const PartialSum    *open)
      : numbers(numbers)
      , stride(stride)
      , first_node(first_node)
      , n_final(n_final)
      , open(open)
      , n(n)
    {}

    unsigned int
    size() const
    {
      return n;
    }

    unsigned int
    operator[](const unsigned int i) const
    {
      if (list != nullptr)
        return list[i];
      const unsigned int k = numbers[static_cast<std::size_t>(i) * stride];
      return k < n_final ? first_node + k : open[k - n_final].node;
    }

    /// Iterates over the nodes.
    struct Iterator
    {
      unsigned int
      operator*() const
      {
        return (*nodes)[i];
      }

      Iterator &
      operator++()
      {
        ++i;
        return *this;
      }

      bool
      operator==(const Iterator &other) const
      {
        return i == other.i;
      }

      const CellNodes *nodes;
      unsigned int     i;
    };

    Iterator
    begin() const
    {
      return {this, 0};
    }

    Iterator
    end() const
    {
      return {this, n};
    }

  private:
    const unsigned int  *list       = nullptr;
    const std::uint16_t *numbers    = nullptr;
    unsigned int         stride     = 0;
    unsigned int         first_node = 0;
    unsigned int         n_final    = 0;
    const PartialSum    *open       = nullptr;
    unsigned int         n;
  };
  /**
   * The nodes of an element on a distributed mesh of tetrahedra: the nodes of
   * each cell, their owners, and their unknowns.
   *
   * Cells and nodes are addressed by local numbers. Owned cells come first,
   * then ghost cells (all that share a vertex with an owned one); owned nodes
   * come first, then ghost nodes (all others of local cells). Node n has the
   * unknowns 3n, 3n+1, 3n+2 (x, y, z), in global numbers and in the local ones
   * of vectors made by initialize_vector().
   *
   * The order is made for sweeps over the cells. Neighbouring cells are near
   * each other. Cells with ghost nodes stand together in the middle, so that
   * there is work to do before the values of ghosts arrive and after their
   * contributions are sent. Owned nodes are numbered in the order in which the
   * sweep leaves them for good, so that results can be processed while they are
   * in the cache; nodes with contributions from other ranks are the last.
   */
  class Nodes
  {
  public:
    Element
    element() const
    {
      return cell_element;
    }

    unsigned int
    degree() const
    {
      return cell_element.degree();
    }

    MPI_Comm
    communicator() const
    {
      return vector_partitioner->get_mpi_communicator();
    }

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

    /// The number of owned and ghost cells.
    unsigned int
    n_local_cells() const
    {
      return n_local;
    }

    /// The range of owned cells that may have ghost nodes: [first, second).
    std::pair<unsigned int, unsigned int>
    cells_with_ghosts() const
    {
      return ghosted_cells;
    }

    /// The cells that begin a new register, so that none has both curved and
    /// straight cells: ascending, possibly repeated, and the number of local
    /// cells may be among them. Empty where the mesh has straight cells only,
    /// or the degree is 1.
    const std::vector<unsigned int> &
    first_cells_of_registers() const
    {
      return register_starts;
    }

    /// The nodes of local cell @p cell.
    CellNodes
    cell_nodes(const unsigned int cell) const;

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

    /// The number of owned and ghost nodes.
    unsigned int
    n_local_nodes() const
    {
      return n_owned_nodes() + vector_partitioner->n_ghost_indices() / 3;
    }

    /// The first of the owned nodes that also belong to ghost cells, so that
    /// other ranks contribute to them.
    unsigned int
    first_shared_node() const
    {
      return first_shared;
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

    /// The cells in batches, for kernels.
    const CellBatches &
    batches() const
    {
      return *cell_batches;
    }

    /// Makes @p vector a vector of unknowns with ghost entries for all local
    /// nodes, all zero.
    template <typename Number>
    void
    initialize_vector(
      dealii::LinearAlgebra::distributed::Vector<Number> &vector) const
    {
      vector.reinit(vector_partitioner);
    }

    /// Work space for sweeps over these nodes. All callers with the same type
    /// share one object, which is made at the first call; only one may use it
    /// at a time.
    template <typename Space>
    std::shared_ptr<Space>
    work_space() const
    {
      std::shared_ptr<void> &space = work_spaces[typeid(Space)];
      if (!space)
        space = std::make_shared<Space>(*this);
      return std::static_pointer_cast<Space>(space);
    }

  protected:
    explicit Nodes(const Element element);
    ~Nodes();

    /// Makes the batches, which from then on keep the nodes of the cells. To be
    /// called after everything else is set.
    void
    make_batches();

    Element                               cell_element;
    unsigned int                          n_cell_nodes;
    unsigned int                          n_owned       = 0;
    unsigned int                          n_local       = 0;
    unsigned int                          first_shared  = 0;
    std::pair<unsigned int, unsigned int> ghosted_cells = {0, 0};
    std::vector<unsigned int>             register_starts;
    /// The nodes of all local cells, one cell after another; empty once there
    /// are batches.
    std::vector<unsigned int> nodes_of_cells;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
                                 vector_partitioner;
    std::unique_ptr<CellBatches> cell_batches;

  private:
    mutable std::map<std::type_index, std::shared_ptr<void>> work_spaces;
  };
} // namespace corotet

#endif
