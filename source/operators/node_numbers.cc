// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/node_numbers.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace corotet
{
  NodeNumbers::NodeNumbers(const MPI_Comm comm, const int n_owned)
    : first_nodes(dealii::Utilities::MPI::all_gather(comm, n_owned))
  {
    first_nodes.push_back(0);
    std::exclusive_scan(first_nodes.begin(),
                        first_nodes.end(),
                        first_nodes.begin(),
                        0);
    first = first_nodes[dealii::Utilities::MPI::this_mpi_process(comm)];
    end   = first + n_owned;
  }

  void
  NodeNumbers::set_ghosts(const std::vector<int> &nodes)
  {
    the_ghosts.clear();
    std::copy_if(nodes.begin(),
                 nodes.end(),
                 std::back_inserter(the_ghosts),
                 [this](const int node) { return !owns(node); });
    std::sort(the_ghosts.begin(), the_ghosts.end());
    the_ghosts.erase(std::unique(the_ghosts.begin(), the_ghosts.end()),
                     the_ghosts.end());
    the_ghosts.shrink_to_fit();
  }

  std::pair<int, int>
  NodeNumbers::owner(const int global) const
  {
    // If several ranks begin with the same node, only the last of them has
    // nodes.
    const int rank =
      std::upper_bound(first_nodes.begin(), first_nodes.end(), global) -
      first_nodes.begin() - 1;
    return {rank, global - first_nodes[rank]};
  }

  int
  NodeNumbers::local_node(const int global) const
  {
    if (owns(global))
      return global - first;
    const auto found =
      std::lower_bound(the_ghosts.begin(), the_ghosts.end(), global);
    Assert(found != the_ghosts.end() && *found == global,
           dealii::ExcInternalError());
    return n_owned() + (found - the_ghosts.begin());
  }
} // namespace corotet
