// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/discretization.h>
#include <corotet/discretization/finite_element.h>
#include <corotet/discretization/local_nodes.h>
#include <corotet/mesh/ghost_cells.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <algorithm>
#include <limits>

namespace corotet
{
  using dealii::numbers::invalid_dof_index;
  using dealii::types::global_dof_index;

  namespace
  {
    // The Jacobian dx / dxi of a cell with straight edges.
    dealii::Tensor<2, 3>
    straight_jacobian(const LocalMesh &mesh, const unsigned int cell)
    {
      const auto             &vertices = mesh.cells[cell].vertices;
      const dealii::Point<3> &origin   = mesh.vertices[vertices[0]];
      dealii::Tensor<2, 3>    jacobian;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int a = 0; a < 3; ++a)
          jacobian[a][k] = mesh.vertices[vertices[k + 1]][a] - origin[a];
      return jacobian;
    }
  } // namespace



  Discretization::Discretization(const Mesh &mesh, const Element element)
    : Nodes(element)
    , mesh_pointer(&mesh)
    , fe(corotet::finite_element(element), 3)
    , linear_mapping(corotet::finite_element(Element(1)))
  {
    const LocalNodes nodes(mesh.local(), element);
    order_cells(nodes);
    make_partitioner(nodes, number_nodes(nodes));
    set_up_cells();
  }



  void
  Discretization::order_cells(const LocalNodes &nodes)
  {
    const LocalMesh          &mesh = mesh_pointer->local();
    std::vector<unsigned int> inner, ghosted, ghosts;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (!mesh.is_owned(c))
        ghosts.push_back(c);
      else
        {
          bool all_owned = true;
          for (unsigned int i = 0; i < n_cell_nodes; ++i)
            all_owned &= nodes.owners[nodes.node(c, i)] == mesh.rank;
          (all_owned ? inner : ghosted).push_back(c);
        }
    n_owned       = inner.size() + ghosted.size();
    ghosted_cells = {inner.size() / 2, inner.size() / 2 + ghosted.size()};
    inner.insert(inner.begin() + ghosted_cells.first,
                 ghosted.begin(),
                 ghosted.end());
    inner.insert(inner.end(), ghosts.begin(), ghosts.end());
    if (mesh_pointer->geometry_degree() > 1 && degree() > 1)
      gather_curved(inner);
    local_mesh_cells = std::move(inner);
  }



  std::vector<global_dof_index>
  Discretization::number_nodes(const LocalNodes &nodes)
  {
    const LocalMesh   &mesh = mesh_pointer->local();
    const unsigned int n_owned_nodes =
      std::count(nodes.owners.begin(), nodes.owners.end(), mesh.rank);
    const auto [first, n_nodes] = dealii::Utilities::MPI::partial_and_total_sum(
      static_cast<global_dof_index>(n_owned_nodes), mesh.communicator);

    std::vector<global_dof_index> numbers(nodes.owners.size(),
                                          invalid_dof_index);
    global_dof_index              next = first + n_owned_nodes;
    // Numbers decrease from the last cell to the first, so a node gets its
    // number where the sweep needs it last.
    const auto number_backwards = [&](const unsigned int begin,
                                      const unsigned int end) {
      for (unsigned int c = end; c-- > begin;)
        for (unsigned int i = n_cell_nodes; i-- > 0;)
          {
            const unsigned int node = nodes.node(local_mesh_cells[c], i);
            if (nodes.owners[node] == mesh.rank &&
                numbers[node] == invalid_dof_index)
              numbers[node] = --next;
          }
    };
    number_backwards(n_owned, local_mesh_cells.size());
    first_shared = next - first;
    number_backwards(0, n_owned);

    if (n_owned == mesh.cells.size())
      return numbers;
    // The owner of a node has a cell with it, which is a ghost cell on all
    // ranks that have the node. The first round gives owned cells the numbers
    // of all their nodes, the second one sends these to the ranks that have
    // them as ghost cells.
    const GhostCells ghosts(mesh);
    for (unsigned int round = 0; round < 2; ++round)
      ghosts.send<global_dof_index>(
        n_cell_nodes,
        [&](const unsigned int c, global_dof_index *const sent) {
          for (unsigned int i = 0; i < n_cell_nodes; ++i)
            sent[i] = numbers[nodes.node(c, i)];
        },
        [&](const unsigned int c, const global_dof_index *const received) {
          for (unsigned int i = 0; i < n_cell_nodes; ++i)
            if (received[i] != invalid_dof_index)
              numbers[nodes.node(c, i)] = received[i];
        });
    return numbers;
  }



  void
  Discretization::make_partitioner(const LocalNodes                    &nodes,
                                   const std::vector<global_dof_index> &numbers)
  {
    const LocalMesh              &mesh = mesh_pointer->local();
    std::vector<global_dof_index> own, others;
    for (unsigned int node = 0; node < numbers.size(); ++node)
      (nodes.owners[node] == mesh.rank ? own : others).push_back(numbers[node]);
    const global_dof_index n_global =
      dealii::Utilities::MPI::sum(static_cast<global_dof_index>(own.size()),
                                  mesh.communicator);
    dealii::IndexSet owned(3 * n_global), ghosts(3 * n_global);
    if (!own.empty())
      {
        const auto first = *std::min_element(own.begin(), own.end());
        owned.add_range(3 * first, 3 * (first + own.size()));
      }
    std::sort(others.begin(), others.end());
    std::vector<global_dof_index> unknowns;
    for (const global_dof_index node : others)
      for (unsigned int a = 0; a < 3; ++a)
        unknowns.push_back(3 * node + a);
    ghosts.add_indices(unknowns.begin(), unknowns.end());
    vector_partitioner =
      std::make_shared<const dealii::Utilities::MPI::Partitioner>(
        owned, ghosts, mesh.communicator);

    std::vector<unsigned int> local_numbers(numbers.size());
    for (unsigned int node = 0; node < numbers.size(); ++node)
      local_numbers[node] =
        vector_partitioner->global_to_local(3 * numbers[node]) / 3;
    n_local = local_mesh_cells.size();
    nodes_of_cells.reserve(std::size_t(n_cell_nodes) * local_mesh_cells.size());
    for (const unsigned int cell : local_mesh_cells)
      for (unsigned int i = 0; i < n_cell_nodes; ++i)
        nodes_of_cells.push_back(local_numbers[nodes.node(cell, i)]);
  }



  CellGeometry
  Discretization::geometry(const unsigned int cell) const
  {
    if (is_curved(cell))
      return curved_geometries[cell];
    const dealii::Tensor<2, 3> J =
      straight_jacobian(mesh_pointer->local(), local_mesh_cells[cell]);
    return {invert(J), determinant(J) / 6, region(cell)};
  }



  void
  Discretization::set_up_cells()
  {
    const LocalMesh &mesh = mesh_pointer->local();
    initialize_vector(positions);
    const std::vector<dealii::Point<3>> &unit_points =
      fe.base_element(0).get_unit_support_points();
    std::vector<std::array<unsigned int, 4>> boundaries(mesh.cells.size(),
                                                        {{unnamed_boundary,
                                                          unnamed_boundary,
                                                          unnamed_boundary,
                                                          unnamed_boundary}});
    for (const auto &[cell, face, boundary] : mesh.faces)
      boundaries[cell][face] = boundary;
    // All cells around a vertex of an own cell are known.
    std::vector<unsigned char> is_of_own_cell(mesh.vertices.size());
    for (unsigned int c = 0; c < n_owned; ++c)
      for (const unsigned int v : mesh.cells[local_mesh_cells[c]].vertices)
        is_of_own_cell[v] = 1;
    const auto is_beside_own_cell = [&](const unsigned int cell,
                                        const unsigned int face) {
      return std::any_of(
        corners_of_faces[face].begin(),
        corners_of_faces[face].end(),
        [&](const unsigned int corner) {
          return is_of_own_cell[mesh.cells[cell].vertices[corner]] != 0;
        });
    };
    double volume = 0;
    for (unsigned int c = 0; c < local_mesh_cells.size(); ++c)
      {
        const unsigned int in_mesh = local_mesh_cells[c];
        for (unsigned int f = 0; f < 4; ++f)
          if (mesh.neighbors[in_mesh][f] == LocalMesh::no_cell)
            {
              const BoundaryFace face{c, f, boundaries[in_mesh][f]};
              if (c < n_owned)
                {
                  surface.push_back(face);
                  faces_of_boundaries[face.boundary].push_back(face);
                }
              else if (face.boundary != unnamed_boundary ||
                       is_beside_own_cell(in_mesh, f))
                // Other faces of ghost cells may be inside of the body, where
                // the known part of the mesh ends.
                surface_of_ghosts.push_back(face);
            }

        const dealii::Point<3> &origin =
          mesh.vertices[mesh.cells[in_mesh].vertices[0]];
        const dealii::Tensor<2, 3> J = straight_jacobian(mesh, in_mesh);
        if (c < n_owned)
          volume += determinant(J) / 6;
        for (unsigned int i = 0; i < n_cell_nodes; ++i)
          {
            const dealii::Tensor<1, 3> x = origin + J * unit_points[i];
            for (unsigned int a = 0; a < 3; ++a)
              positions.local_element(3 * cell_nodes(c)[i] + a) = x[a];
          }
      }
    // The last digit of a position depends on the cell that it was computed
    // from.
    positions.update_ghost_values();
    make_batches();
    if (mesh_pointer->geometry_degree() > 1 && degree() > 1)
      {
        curve_positions();
        positions.update_ghost_values();
        set_up_curved_cells();
        volume = 0;
        for (unsigned int c = 0; c < n_owned; ++c)
          volume += geometry(c).volume;
      }
    body_volume = dealii::Utilities::MPI::sum(volume, communicator());
  }



  const dealii::DoFHandler<3> &
  Discretization::dof_handler() const
  {
    if (dofs)
      return *dofs;
    const auto &tria = mesh_pointer->triangulation();
    dofs             = std::make_unique<dealii::DoFHandler<3>>(tria);
    dofs->distribute_dofs(fe);
    // Both numberings give nodes that ranks share to the lowest of these ranks.
    const dealii::IndexSet        owned = dofs->locally_owned_dofs();
    std::vector<global_dof_index> numbers(owned.n_elements());
    std::vector<global_dof_index> cell_dofs(fe.dofs_per_cell);
    for (unsigned int c = 0; c < n_owned; ++c)
      {
        dealii::DoFHandler<3>::active_cell_iterator(&tria,
                                                    0,
                                                    local_mesh_cells[c],
                                                    dofs.get())
          ->get_dof_indices(cell_dofs);
        for (unsigned int i = 0; i < n_cell_nodes; ++i)
          for (unsigned int a = 0; a < 3; ++a)
            {
              const auto dof = cell_dofs[fe.component_to_system_index(a, i)];
              if (owned.is_element(dof))
                numbers[owned.index_within_set(dof)] =
                  3 * global_node(cell_nodes(c)[i]) + a;
            }
      }
    dofs->renumber_dofs(numbers);
    return *dofs;
  }



  std::pair<dealii::Point<3>, dealii::Point<3>>
  Discretization::bounding_box() const
  {
    std::pair<dealii::Point<3>, dealii::Point<3>> box;
    for (unsigned int a = 0; a < 3; ++a)
      {
        double lower = std::numeric_limits<double>::max();
        double upper = std::numeric_limits<double>::lowest();
        for (unsigned int n = 0; n < n_owned_nodes(); ++n)
          {
            lower = std::min(lower, node_position(n)[a]);
            upper = std::max(upper, node_position(n)[a]);
          }
        box.first[a]  = dealii::Utilities::MPI::min(lower, communicator());
        box.second[a] = dealii::Utilities::MPI::max(upper, communicator());
      }
    return box;
  }
} // namespace corotet
