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
   * Disjoint aggregates of neighbouring nodes that cover all (Vanek, Mandel,
   * Brezina 1996): nodes whose strong neighbours are all free take these, in
   * the order of their numbers; who is left joins the aggregate that it has the
   * most strong neighbours in, or is alone. @p is_strong(k): whether entry k of
   * the graph counts. Returns the aggregate of each node.
   */
  std::vector<int>
  aggregate(const NodeGraph &graph, const std::function<bool(int)> &is_strong);

  /**
   * Larger aggregates: in the order of their numbers, each that is free takes
   * the free one that most entries of the graph join it with, until @p most
   * are together or none is left. @p aggregates: of each row; columns beyond
   * the rows do not count. Returns the new aggregate of each row.
   */
  std::vector<int>
  join(const NodeGraph        &graph,
       const std::vector<int> &aggregates,
       const unsigned int      most);
} // namespace corotet

#endif
