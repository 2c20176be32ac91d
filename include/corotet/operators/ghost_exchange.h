// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_ghost_exchange_h
#define corotet_operators_ghost_exchange_h

#include <mpi.h>

#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * The pattern of a sparse matrix of blocks: the columns of row i are
   * columns[starts[i]], .., columns[starts[i + 1] - 1], in ascending order.
   */
  struct NodeGraph
  {
    std::vector<int> starts{0};
    std::vector<int> columns;

    int
    n_rows() const
    {
      return starts.size() - 1;
    }
  };

  /**
   * Numbers of nodes through all ranks, which own contiguous ranges of them, in
   * ascending order; a rank may own none. Local numbers are those of the owned
   * nodes, then those of ghosts, nodes of other ranks that are known here, both
   * in the order of their global numbers.
   */
  class NodeNumbers
  {
  public:
    NodeNumbers() = default;

    /// Without ghosts. Collective.
    NodeNumbers(const MPI_Comm comm, const int n_owned);

    /// Those of other ranks among @p nodes, global numbers in any order, also
    /// repeated, become the ghosts.
    void
    set_ghosts(const std::vector<int> &nodes);

    /// Global numbers, ascending.
    const std::vector<int> &
    ghosts() const
    {
      return the_ghosts;
    }

    int
    n_owned() const
    {
      return end - first;
    }

    /// Owned nodes and ghosts.
    int
    n_local() const
    {
      return n_owned() + static_cast<int>(the_ghosts.size());
    }

    /// Nodes of all ranks.
    int
    n_global() const
    {
      return first_nodes.back();
    }

    /// A global number.
    int
    first_owned() const
    {
      return first;
    }

    int
    n_ranks() const
    {
      return first_nodes.size() - 1;
    }

    /// The owner of a node, and its number among those of the owner.
    std::pair<int, int>
    owner(const int global) const;

    int
    global_node(const int local) const
    {
      return local < n_owned() ? first + local : the_ghosts[local - n_owned()];
    }

    /// Of a node that is owned or a ghost.
    int
    local_node(const int global) const;

  private:
    bool
    owns(const int global) const
    {
      return global >= first && global < end;
    }

    /// Of each rank; the last entry is the number of all nodes.
    std::vector<int> first_nodes{0};
    int              first = 0, end = 0;
    std::vector<int> the_ghosts;
  };

  /**
   * Brings what owned nodes have to the ranks where they are ghosts, and back.
   */
  class GhostExchange
  {
  public:
    /// Without ghosts.
    GhostExchange() = default;

    /// Collective.
    GhostExchange(const MPI_Comm comm, const NodeNumbers &numbers);

    /// Gives @p graph, which has the rows of owned nodes, those of the ghosts.
    /// Returns the exchange of what its entries have. Collective.
    GhostExchange
    append_rows(NodeGraph &graph) const;

    /// Nodes, owned and ghosts.
    int
    n_items() const
    {
      return n_owned + n_ghosts;
    }

    /// Overwrites the values of ghosts; @p values has n per node. Allocates
    /// only where one node has had less before. Collective.
    template <typename T>
    void
    update(T *values, const int n = 1) const
    {
      exchange(reinterpret_cast<char *>(values), n * sizeof(T));
    }

    /// Adds the values of ghosts to those of the nodes at their owners; @p
    /// values has n per node. Collective.
    template <typename T>
    void
    add(T *values, const int n = 1) const
    {
      return_ghosts(reinterpret_cast<const char *>(values), n * sizeof(T));
      const char *next = buffer.data();
      for (const int node : sent)
        for (int k = 0; k < n; ++k, next += sizeof(T))
          {
            T value;
            std::memcpy(&value, next, sizeof(T));
            values[static_cast<std::ptrdiff_t>(node) * n + k] += value;
          }
    }

  private:
    /// Consecutive items that are sent to a rank, and ghosts that it owns.
    struct Neighbour
    {
      int rank;
      int send_begin, send_end;
      int ghost_begin, ghost_end;
    };

    void
    exchange(char *values, const std::size_t size) const;
    /// Into the buffer, in the order of @p sent.
    void
    return_ghosts(const char *values, const std::size_t size) const;

    MPI_Comm                         comm     = MPI_COMM_SELF;
    int                              n_owned  = 0;
    int                              n_ghosts = 0;
    std::vector<Neighbour>           neighbours;
    std::vector<int>                 sent;
    mutable std::vector<char>        buffer;
    mutable std::vector<MPI_Request> requests;
  };
} // namespace corotet

#endif
