// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/discretization/connected_parts.h>
#include <corotet/operators/material_nodes.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace corotet
{
  using dealii::types::global_dof_index;

  namespace
  {
    // All nodes of local cells with their groups, sorted.
    std::vector<MaterialNodes::Copy>
    copies_in(const Discretization            &discretization,
              const std::vector<unsigned int> &group_of_cell)
    {
      // Nearly all nodes have one group only, which is stored here.
      constexpr unsigned int    none = dealii::numbers::invalid_unsigned_int;
      std::vector<unsigned int> first(discretization.n_local_nodes(), none);
      std::vector<MaterialNodes::Copy> result;
      for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
        {
          const unsigned int group = group_of_cell[c];
          for (const unsigned int node : discretization.cell_nodes(c))
            if (first[node] == none)
              first[node] = group;
            else if (first[node] != group)
              result.push_back({node, group});
        }
      for (unsigned int node = 0; node < first.size(); ++node)
        if (first[node] != none)
          result.push_back({node, first[node]});
      std::sort(result.begin(), result.end());
      result.erase(std::unique(result.begin(), result.end()), result.end());
      return result;
    }
  } // namespace

  void
  MaterialNodes::check_number(const std::uint64_t n_copies)
  {
    constexpr std::uint64_t most =
      std::numeric_limits<global_dof_index>::max() / 6;
    if (n_copies > most)
      throw InputError(
        "Output/Stress",
        fmt::format("found {} nodes, for each material of a node "
                    "one; allowed are up to {} for recovered "
                    "stress, whose numbers deal.II counts by {} "
                    "bits here",
                    n_copies,
                    most,
                    8 * sizeof(global_dof_index)));
  }

  MaterialNodes::MaterialNodes(
    const Discretization                                  &discretization,
    const unsigned int                                     n_materials,
    const std::function<unsigned int(const unsigned int)> &material_of_cell)
    : discretization(discretization)
  {
    const MPI_Comm                  comm = discretization.communicator();
    const ConnectedParts            parts(discretization);
    const std::vector<unsigned int> colours = parts.colours(comm);
    n_colours = 1 + *std::max_element(colours.begin(), colours.end());
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      group_of_cell.push_back(n_colours * material_of_cell(c) +
                              colours[parts.part_of_cell[c]]);
    // All cells of an owned node are local, so all its groups are known.
    const std::vector<Copy> found   = copies_in(discretization, group_of_cell);
    unsigned int            n_owned = 0;
    while (n_owned < found.size() &&
           found[n_owned].node < discretization.n_owned_nodes())
      ++n_owned;

    const auto [n_before, n_all] =
      dealii::Utilities::MPI::partial_and_total_sum<std::uint64_t>(n_owned,
                                                                   comm);
    check_number(n_all);
    const auto first    = static_cast<global_dof_index>(n_before);
    const auto n_global = static_cast<global_dof_index>(n_all);
    // Global numbers of ghosts, group by group, travel in a vector of
    // the discretization; doubles hold them exactly.
    std::vector<global_dof_index> global(found.size());
    Vector                        numbers;
    discretization.initialize_vector(numbers);
    for (unsigned int g = 0; g < n_materials * n_colours; ++g)
      {
        numbers = 0;
        for (unsigned int i = 0; i < n_owned; ++i)
          if (found[i].group == g)
            {
              global[i]                                = first + i;
              numbers.local_element(3 * found[i].node) = first + i;
            }
        numbers.update_ghost_values();
        for (unsigned int i = n_owned; i < found.size(); ++i)
          if (found[i].group == g)
            global[i] = static_cast<global_dof_index>(
              numbers.local_element(3 * found[i].node));
        numbers.zero_out_ghost_values();
      }

    dealii::IndexSet owned(6 * n_global), ghosts(6 * n_global);
    owned.add_range(6 * first, 6 * (first + n_owned));
    for (unsigned int i = n_owned; i < found.size(); ++i)
      ghosts.add_range(6 * global[i], 6 * global[i] + 6);
    ghosts.compress();
    partitioner =
      std::make_shared<const dealii::Utilities::MPI::Partitioner>(owned,
                                                                  ghosts,
                                                                  comm);

    // The partitioner determines the numbers of ghosts.
    copies.resize(found.size());
    std::vector<unsigned int> number(found.size());
    for (unsigned int i = 0; i < found.size(); ++i)
      {
        number[i]         = partitioner->global_to_local(6 * global[i]) / 6;
        copies[number[i]] = found[i];
      }
    nodes_of_cells.reserve(
      static_cast<std::size_t>(discretization.n_local_cells()) *
      discretization.n_nodes_per_cell());
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      for (const unsigned int node : discretization.cell_nodes(c))
        {
          const Copy wanted{node, group_of_cell[c]};
          nodes_of_cells.push_back(
            number[std::lower_bound(found.begin(), found.end(), wanted) -
                   found.begin()]);
        }
  }

  NodeNumbers
  MaterialNodes::numbers() const
  {
    AssertThrow(partitioner->size() / 6 <=
                  static_cast<std::size_t>(std::numeric_limits<int>::max()),
                dealii::ExcMessage("There are too many nodes."));
    NodeNumbers      result(discretization.communicator(), n_owned());
    std::vector<int> ghosts;
    for (unsigned int n = n_owned(); n < copies.size(); ++n)
      ghosts.push_back(partitioner->local_to_global(6 * n) / 6);
    result.set_ghosts(ghosts);
    return result;
  }
} // namespace corotet
