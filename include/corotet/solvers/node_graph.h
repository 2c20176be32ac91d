// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_node_graph_h
#define corotet_solvers_node_graph_h

#include <corotet/operators/ghost_exchange.h>

#include <functional>
#include <vector>

namespace corotet
{
  NodeGraph
  transpose(const NodeGraph &graph, const int n_columns);

  /// The pattern of the product of two matrices.
  NodeGraph
  product(const NodeGraph &a, const NodeGraph &b, const int n_columns);

  /**
   * Disjoint aggregates of neighbouring nodes that cover all nodes (Vanek,
   * Mandel, Brezina 1996): in the order of their numbers, nodes whose strong
   * neighbours are all free take these; each node that is left joins the
   * aggregate with most of its strong neighbours, or stays alone.
   * @p is_strong(k) tells whether entry k of the graph is strong. Returns the
   * aggregate of each node.
   */
  std::vector<int>
  aggregate(const NodeGraph &graph, const std::function<bool(int)> &is_strong);

  /**
   * Larger aggregates: in the order of their numbers, each free aggregate takes
   * the free one that most entries of the graph connect it with, until @p most
   * are together or none is left. @p aggregates has the aggregate of each row;
   * columns beyond the rows do not count. Returns the new aggregate of each
   * row.
   */
  std::vector<int>
  join(const NodeGraph        &graph,
       const std::vector<int> &aggregates,
       const unsigned int      most);
} // namespace corotet

#endif
