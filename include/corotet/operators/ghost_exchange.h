// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_ghost_exchange_h
#define corotet_operators_ghost_exchange_h

#include <corotet/operators/node_numbers.h>

#include <mpi.h>

#include <cstddef>
#include <cstring>
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
   * Brings values of owned nodes to the ranks where they are ghosts, and back.
   */
  class GhostExchange
  {
  public:
    /// An exchange without ghosts.
    GhostExchange() = default;

    /// Collective.
    GhostExchange(const MPI_Comm comm, const NodeNumbers &numbers);

    /// Appends the rows of the ghosts to @p graph, which has the rows of owned
    /// nodes. Returns the exchange for values of its entries. Collective.
    GhostExchange
    append_rows(NodeGraph &graph) const;

    /// Number of owned nodes and ghosts.
    int
    n_items() const
    {
      return n_owned + n_ghosts;
    }

    /// Overwrites the values of ghosts; @p values has n per node. Allocates
    /// memory only where n exceeds that of earlier calls. Collective.
    template <typename T>
    void
    update(T *values, const int n = 1) const
    {
      exchange(reinterpret_cast<char *>(values), n * sizeof(T));
    }

    /// Adds the values of ghosts to those of the nodes at their owners;
    /// @p values has n per node. Collective.
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
    struct Range
    {
      int begin, end;
    };

    /// The items for a rank, as a range of @p sent, and the ghosts that it
    /// owns.
    struct Neighbour
    {
      int   rank;
      Range sent, ghosts;
    };

    void
    exchange(char *values, const std::size_t size) const;
    /// Sends the values of ghosts to their owners, into the buffers there, in
    /// the order of @p sent.
    void
    return_ghosts(const char *values, const std::size_t size) const;
    /// Sends and receives these ranges of items of @p size bytes.
    void
    transfer(const char *source,
             const Range Neighbour::*sent_range,
             char                   *target,
             const Range Neighbour::*received_range,
             const std::size_t       size) const;

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
