// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/disjoint_sets.h>
#include <corotet/discretization/connected_parts.h>
#include <corotet/mesh/ghost_cells.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <tuple>

namespace corotet
{
  using dealii::numbers::invalid_unsigned_int;

  std::set<std::pair<unsigned int, unsigned int>>
  of_all_ranks(const std::set<std::pair<unsigned int, unsigned int>> &pairs,
               const MPI_Comm                                         comm)
  {
    std::vector<unsigned int> numbers;
    for (const auto &[a, b] : pairs)
      numbers.insert(numbers.end(), {a, b});
    std::set<std::pair<unsigned int, unsigned int>> result;
    for (const auto &own : dealii::Utilities::MPI::all_gather(comm, numbers))
      for (std::size_t i = 0; i < own.size(); i += 2)
        result.insert({own[i], own[i + 1]});
    return result;
  }

  ConnectedParts::ConnectedParts(const Discretization &discretization)
    : part_of_node(discretization.n_owned_nodes(), invalid_unsigned_int)
  {
    const std::vector<unsigned int> parts = number_parts(discretization);
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      part_of_cell.push_back(parts[discretization.cell_in_local_mesh(c)]);
    find_joints(discretization, parts);
    measure(discretization);
  }

  namespace
  {
    using Pairs = std::set<std::pair<unsigned int, unsigned int>>;

    // The number of each owned cell's part, counted on this rank in the order
    // of first cells, and the number of parts. Ghost cells get no number.
    std::pair<std::vector<unsigned int>, unsigned int>
    own_parts(const LocalMesh &mesh)
    {
      std::vector<unsigned int> parts(mesh.cells.size(), invalid_unsigned_int);
      std::vector<unsigned int> open;
      unsigned int              n_parts = 0;
      const auto                add     = [&](const unsigned int c) {
        if (mesh.is_owned(c) && parts[c] == invalid_unsigned_int)
          {
            parts[c] = n_parts;
            open.push_back(c);
          }
      };
      for (unsigned int c = 0; c < parts.size(); ++c)
        {
          add(c);
          if (open.empty())
            continue;
          while (!open.empty())
            {
              const unsigned int member = open.back();
              open.pop_back();
              for (const unsigned int neighbor : mesh.neighbors[member])
                if (neighbor != LocalMesh::no_cell)
                  add(neighbor);
            }
          ++n_parts;
        }
      return {parts, n_parts};
    }



    // A label for each owned and ghost cell, the same for all cells of a part
    // on one rank and different for different parts; pairs of labels that mean
    // the same part; and the number of labels.
    std::tuple<std::vector<unsigned int>, Pairs, unsigned int>
    labels_by_rank(const LocalMesh &mesh)
    {
      const MPI_Comm comm  = mesh.communicator;
      auto [labels, n_own] = own_parts(mesh);
      unsigned int first   = 0;
      MPI_Exscan(&n_own, &first, 1, MPI_UNSIGNED, MPI_SUM, comm);
      for (unsigned int &label : labels)
        if (label != invalid_unsigned_int)
          label += first;
      GhostCells(mesh).update(labels);

      Pairs pairs;
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        if (mesh.is_owned(c))
          for (const unsigned int neighbor : mesh.neighbors[c])
            if (neighbor != LocalMesh::no_cell && !mesh.is_owned(neighbor))
              pairs.insert({labels[c], labels[neighbor]});
      return {labels,
              of_all_ranks(pairs, comm),
              dealii::Utilities::MPI::sum(n_own, comm)};
    }
  } // namespace

  std::vector<unsigned int>
  ConnectedParts::number_parts(const Discretization &discretization)
  {
    const LocalMesh &mesh          = discretization.mesh().local();
    const MPI_Comm   comm          = mesh.communicator;
    auto [labels, pairs, n_labels] = labels_by_rank(mesh);

    // Unites parts that are connected across ranks.
    DisjointSets sets(n_labels);
    for (const auto &[a, b] : pairs)
      sets.unite(a, b);
    std::vector<unsigned int> parts;
    std::tie(parts, n_parts) = sets.numbers();
    Pairs                                 part_regions;
    std::pair<unsigned int, unsigned int> last(invalid_unsigned_int, 0);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        labels[c] = parts[labels[c]];
        const std::pair<unsigned int, unsigned int> pair(labels[c],
                                                         mesh.cells[c].region);
        if (!mesh.is_owned(c) || pair == last)
          continue;
        part_regions.insert(pair);
        last = pair;
      }
    regions.resize(n_parts);
    for (const auto &[part, region] : of_all_ranks(part_regions, comm))
      regions[part].insert(region);
    return labels;
  }

  void
  ConnectedParts::find_joints(const Discretization            &discretization,
                              const std::vector<unsigned int> &part_of_cell)
  {
    if (n_parts == 1)
      {
        std::fill(part_of_node.begin(), part_of_node.end(), 0u);
        return;
      }
    // Cells in the order of the mesh: a node belongs to the part of its first
    // cell.
    std::vector<unsigned int> cells(discretization.n_local_cells());
    for (unsigned int c = 0; c < cells.size(); ++c)
      cells[discretization.cell_in_local_mesh(c)] = c;
    std::set<std::pair<unsigned int, unsigned int>> others;
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (const unsigned int node : discretization.cell_nodes(cells[c]))
        if (node < part_of_node.size())
          {
            if (part_of_node[node] == invalid_unsigned_int)
              part_of_node[node] = part_of_cell[c];
            else if (part_of_node[node] != part_of_cell[c])
              others.insert({node, part_of_cell[c]});
          }
    for (const auto &[node, part] : others)
      joints.push_back({node, part_of_node[node], part});
  }

  std::pair<std::vector<unsigned int>, unsigned int>
  ConnectedParts::bodies(const MPI_Comm comm) const
  {
    Pairs pairs;
    for (const Joint &joint : joints)
      pairs.insert({joint.part, joint.other});
    DisjointSets sets(n_parts);
    for (const auto &[a, b] : of_all_ranks(pairs, comm))
      sets.unite(a, b);
    return sets.numbers();
  }

  std::vector<unsigned int>
  ConnectedParts::colours(const MPI_Comm comm) const
  {
    // Joints of a node follow each other, and name the node's first part.
    Pairs neighbors;
    for (auto joint = joints.begin(); joint != joints.end(); ++joint)
      {
        neighbors.insert(std::minmax(joint->part, joint->other));
        for (auto next = joint + 1;
             next != joints.end() && next->node == joint->node;
             ++next)
          neighbors.insert(std::minmax(joint->other, next->other));
      }
    std::vector<std::set<unsigned int>> of_lower(n_parts);
    std::vector<unsigned int>           result(n_parts);
    // The pairs come in the order of their lower part, whose colour is known
    // when its pairs are reached.
    const Pairs all  = of_all_ranks(neighbors, comm);
    auto        pair = all.begin();
    for (unsigned int part = 0; part < n_parts; ++part)
      {
        while (of_lower[part].contains(result[part]))
          ++result[part];
        for (; pair != all.end() && pair->first == part; ++pair)
          of_lower[pair->second].insert(result[part]);
      }
    return result;
  }

  void
  ConnectedParts::measure(const Discretization &discretization)
  {
    using namespace dealii::Utilities;
    const MPI_Comm comm     = discretization.communicator();
    const auto     for_each = [&](const auto &action) {
      for (unsigned int n = 0; n < part_of_node.size(); ++n)
        action(part_of_node[n], discretization.node_position(n));
      for (const Joint &joint : joints)
        action(joint.other, discretization.node_position(joint.node));
    };
    std::vector<double> sums(std::size_t(4) * n_parts);
    for_each([&](const unsigned int part, const dealii::Point<3> &x) {
      for (unsigned int a = 0; a < 3; ++a)
        sums[4 * part + a] += x[a];
      ++sums[4 * part + 3];
    });
    MPI::sum(sums, comm, sums);
    for (unsigned int part = 0; part < n_parts; ++part)
      {
        const double *sum = &sums[std::size_t(4) * part];
        centres.emplace_back(sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]);
      }
    radii.resize(n_parts);
    for_each([&](const unsigned int part, const dealii::Point<3> &x) {
      radii[part] = std::max(radii[part], (x - centres[part]).norm());
    });
    MPI::max(radii, comm, radii);
  }
} // namespace corotet
