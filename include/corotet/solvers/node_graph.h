// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_node_graph_h
#define corotet_solvers_node_graph_h

#include <Epetra_CrsGraph.h>
#include <Epetra_CrsMatrix.h>
#include <mpi.h>

#include <array>
#include <cstddef>
#include <functional>
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
   * Reads the owned rows of a matrix that is full of 3 x 3 blocks. Its columns
   * count the owned nodes first, then the ghosts: nodes of other ranks.
   */
  class NodeRows
  {
  public:
    NodeRows() = default;

    explicit NodeRows(const Epetra_CrsGraph &graph);

    /// The three rows of a node, in the order of graph(), three entries per
    /// column. Valid until the next call.
    std::array<const double *, 3>
    rows(const Epetra_CrsMatrix &A, const int node) const;

    const NodeGraph &
    graph() const
    {
      return nodes;
    }

    /// Their numbers in the matrix, ascending.
    const std::vector<int> &
    ghosts() const
    {
      return ghost_nodes;
    }

  private:
    NodeGraph        nodes;
    std::vector<int> ghost_nodes;
    /// Where a row of A has its entries, in our order: from the first ghost on,
    /// Epetra's order is any.
    NodeGraph                   ghost_places;
    mutable std::vector<double> buffer;
  };

  /**
   * Brings what owned nodes have to the ranks where they are ghosts.
   */
  class GhostExchange
  {
  public:
    /// Without ghosts.
    GhostExchange() = default;

    /// For nodes as NodeRows counts them. Collective.
    GhostExchange(const Epetra_CrsGraph &graph, const std::vector<int> &ghosts);

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

  NodeGraph
  transpose(const NodeGraph &graph, const int n_columns);

  /// The pattern of the product of two matrices.
  NodeGraph
  product(const NodeGraph &a, const NodeGraph &b, const int n_columns);

  /**
   * Disjoint aggregates of neighbouring nodes that cover all (Vanek, Mandel,
   * Brezina 1996): nodes whose strong neighbours are all free take these, in
   * the order of their numbers; who is left joins the aggregate that it has the
   * most strong neighbours in, or is alone. @p is_strong(k): whether entry k of
   * the graph counts. Returns the aggregate of each node.
   */
  std::vector<int>
  aggregate(const NodeGraph &graph, const std::function<bool(int)> &is_strong);
} // namespace corotet

#endif
