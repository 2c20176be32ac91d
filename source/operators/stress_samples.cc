// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/point_geometry.h>
#include <corotet/operators/stress_samples.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace corotet
{
  using dealii::Point;
  using dealii::SymmetricTensor;
  using dealii::types::global_dof_index;
  namespace mpi = dealii::Utilities::MPI;

  namespace
  {
    // Global numbers of ghost vertices by the rank that owns them. Ghosts are
    // numbered in the order of their owners.
    std::map<unsigned int, std::vector<global_dof_index>>
    by_owner(const Discretization     &discretization,
             std::vector<unsigned int> ghost_vertices)
    {
      std::sort(ghost_vertices.begin(), ghost_vertices.end());
      std::map<unsigned int, std::vector<global_dof_index>> result;
      unsigned int end  = discretization.n_owned_nodes();
      auto         next = ghost_vertices.begin();
      for (const auto &[rank, n_entries] :
           discretization.partitioner()->ghost_targets())
        {
          end += n_entries / 3;
          for (; next != ghost_vertices.end() && *next < end; ++next)
            result[rank].push_back(discretization.global_node(*next));
        }
      Assert(next == ghost_vertices.end(), dealii::ExcInternalError());
      return result;
    }
  } // namespace

  StressSamples::StressSamples(const Discretization   &discretization,
                               const ReferenceElement &reference,
                               const MaterialNodes    &nodes)
    : discretization(discretization)
    , nodes(nodes)
    , n_points(reference.stiffness_rule.weights.size())
  {
    const unsigned int n_cells = discretization.n_local_cells();
    positions.reserve(static_cast<std::size_t>(n_cells) * n_points);
    corners_of_cells.resize(n_cells);
    incidences.reserve(4 * static_cast<std::size_t>(n_cells));
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        for (unsigned int q = 0; q < n_points; ++q)
          positions.push_back(
            point_position(discretization, reference.stiffness_rule, c, q));
        for (unsigned int k = 0; k < 4; ++k)
          {
            const unsigned int vertex = discretization.cell_nodes(c)[k];
            corners_of_cells[c][k]    = discretization.node_position(vertex);
            incidences.push_back({vertex, nodes.group(c), c});
          }
      }
    std::sort(incidences.begin(), incidences.end());
  }

  std::vector<unsigned int>
  StressSamples::cells_around(const unsigned int vertex,
                              const unsigned int group) const
  {
    std::vector<unsigned int> result;
    for (auto i = std::lower_bound(incidences.begin(),
                                   incidences.end(),
                                   Incidence{vertex, group, 0});
         i != incidences.end() && i->vertex == vertex && i->group == group;
         ++i)
      result.push_back(i->cell);
    return result;
  }

  StressSamples::Key
  StressSamples::key(const unsigned int local_cell) const
  {
    Key result;
    for (unsigned int k = 0; k < 4; ++k)
      result[k] =
        discretization.global_node(discretization.cell_nodes(local_cell)[k]);
    return result;
  }

  void
  StressSamples::add_cell(const Key         &vertices,
                          const unsigned int group,
                          const double      *x)
  {
    const unsigned int cell = corners_of_cells.size();
    corners_of_cells.emplace_back();
    for (unsigned int k = 0; k < 4; ++k, x += 3)
      corners_of_cells[cell][k] = Point<3>(x[0], x[1], x[2]);
    for (unsigned int q = 0; q < n_points; ++q, x += 3)
      positions.emplace_back(x[0], x[1], x[2]);
    const auto &partitioner = *discretization.partitioner();
    for (const global_dof_index vertex : vertices)
      if (partitioner.in_local_range(3 * vertex) ||
          partitioner.is_ghost_entry(3 * vertex))
        incidences.push_back(
          {partitioner.global_to_local(3 * vertex) / 3, group, cell});
  }

  void
  StressSamples::fetch_cells_around(
    const std::vector<unsigned int> &ghost_vertices)
  {
    const MPI_Comm comm = discretization.communicator();
    const auto     requests =
      mpi::some_to_some(comm, by_owner(discretization, ghost_vertices));

    // A cell is described by its four vertices, its group, and positions.
    using Description =
      std::pair<std::vector<global_dof_index>, std::vector<double>>;
    std::map<unsigned int, Description> answers;
    for (const auto &[rank, vertices] : requests)
      {
        std::vector<unsigned int> &cells = sent[rank];
        for (const global_dof_index vertex : vertices)
          {
            const unsigned int local =
              discretization.partitioner()->global_to_local(3 * vertex) / 3;
            for (auto i = std::lower_bound(incidences.begin(),
                                           incidences.end(),
                                           Incidence{local, 0, 0});
                 i != incidences.end() && i->vertex == local;
                 ++i)
              cells.push_back(i->cell);
          }
        std::sort(cells.begin(), cells.end());
        cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
        auto &[numbers, x] = answers[rank];
        for (const unsigned int c : cells)
          {
            const Key vertices_of_cell = key(c);
            numbers.insert(numbers.end(),
                           vertices_of_cell.begin(),
                           vertices_of_cell.end());
            numbers.push_back(nodes.group(c));
            for (const Point<3> &corner : corners(c))
              x.insert(x.end(), {corner[0], corner[1], corner[2]});
            for (const Point<3> &point : points(c))
              x.insert(x.end(), {point[0], point[1], point[2]});
          }
      }

    // The same cell may come from several ranks, or be local.
    std::map<Key, unsigned int> known;
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      known.emplace(key(c), c);
    for (const auto &[rank, description] : mpi::some_to_some(comm, answers))
      {
        const auto &[numbers, x] = description;
        for (std::size_t i = 0; i < numbers.size() / 5; ++i)
          {
            Key vertices;
            std::copy_n(&numbers[5 * i], 4, vertices.begin());
            const auto [place, is_new] =
              known.emplace(vertices, corners_of_cells.size());
            if (is_new)
              add_cell(vertices,
                       numbers[5 * i + 4],
                       &x[i * 3 * (4 + n_points)]);
            received[rank].push_back(place->second);
          }
      }
    std::sort(incidences.begin(), incidences.end());
  }

  void
  StressSamples::complete(std::vector<SymmetricTensor<2, 3>> &stresses) const
  {
    std::map<unsigned int, std::vector<double>> values;
    for (const auto &[rank, cells] : sent)
      for (const unsigned int c : cells)
        for (unsigned int q = 0; q < n_points; ++q)
          {
            const auto &stress = stresses[first_point(c) + q];
            values[rank].insert(values[rank].end(),
                                stress.begin_raw(),
                                stress.end_raw());
          }
    stresses.resize(positions.size());
    for (const auto &[rank, numbers] :
         mpi::some_to_some(discretization.communicator(), values))
      {
        const double *next = numbers.data();
        for (const unsigned int c : received.at(rank))
          for (unsigned int q = 0; q < n_points; ++q, next += 6)
            // Stress of local cells does not change.
            if (c >= discretization.n_local_cells())
              std::copy_n(next, 6, stresses[first_point(c) + q].begin_raw());
      }
  }

  std::vector<unsigned int>
  StressSamples::cells_for_others() const
  {
    std::vector<unsigned int> result;
    for (const auto &[rank, cells] : sent)
      result.insert(result.end(), cells.begin(), cells.end());
    return result;
  }
} // namespace corotet
