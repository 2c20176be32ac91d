// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_ghost_exchange_h
#define corotet_operators_ghost_exchange_h

#include <mpi.h>

#include <cstddef>
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
   * Brings what owned nodes have to the ranks where they are ghosts.
   */
  class GhostExchange
  {
  public:
    /// Without ghosts.
    GhostExchange() = default;

    /// Rank r owns the nodes @p first_nodes[r], .., @p first_nodes[r + 1] - 1;
    /// the last entry is the number of all. @p ghosts: nodes of other ranks, in
    /// ascending order. Here, owned nodes come first, then ghosts. Collective.
    GhostExchange(const MPI_Comm          comm,
                  const std::vector<int> &first_nodes,
                  const std::vector<int> &ghosts);

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
