// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_node_numbers_h
#define corotet_operators_node_numbers_h

#include <mpi.h>

#include <utility>
#include <vector>

namespace corotet
{
  /**
   * Global numbers of nodes: each rank owns a contiguous range of them, in
   * ascending order; it may be empty. Local numbers are those of the owned
   * nodes, then those of ghosts, which are nodes of other ranks that are known
   * here, both in the order of their global numbers.
   */
  class NodeNumbers
  {
  public:
    NodeNumbers() = default;

    /// Numbers without ghosts. Collective.
    NodeNumbers(const MPI_Comm comm, const int n_owned);

    /// Sets the ghosts: the nodes of other ranks among @p nodes, which has
    /// global numbers in any order, perhaps repeated.
    void
    set_ghosts(const std::vector<int> &nodes);

    /// Global numbers of the ghosts, ascending.
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

    /// Number of owned nodes and ghosts.
    int
    n_local() const
    {
      return n_owned() + static_cast<int>(the_ghosts.size());
    }

    /// Number of nodes on all ranks.
    int
    n_global() const
    {
      return first_nodes.back();
    }

    /// Global number of the first owned node.
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

    /// Local number of a node that is owned or a ghost.
    int
    local_node(const int global) const;

  private:
    bool
    owns(const int global) const
    {
      return global >= first && global < end;
    }

    /// The first node of each rank; the last entry is the number of all nodes.
    std::vector<int> first_nodes{0};
    int              first = 0, end = 0;
    std::vector<int> the_ghosts;
  };
} // namespace corotet

#endif
