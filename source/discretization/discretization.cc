// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/discretization.h>
#include <corotet/discretization/finite_element.h>
#include <corotet/mesh/triangulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <algorithm>
#include <limits>

namespace corotet
{
  using dealii::numbers::invalid_dof_index;
  using dealii::types::global_dof_index;

  Discretization::Discretization(const Mesh &mesh, const Element element)
    : Nodes(element)
    , mesh_pointer(&mesh)
    , fe(corotet::finite_element(element), 3)
    , linear_mapping(corotet::finite_element(Element(1)))
    , dofs(mesh.triangulation())
  {
    dofs.distribute_dofs(fe);
    const std::vector<CellIterator> cells = order_cells();
    renumber_nodes(cells);
    vector_partitioner =
      std::make_shared<const dealii::Utilities::MPI::Partitioner>(
        dofs.locally_owned_dofs(),
        dealii::DoFTools::extract_locally_relevant_dofs(dofs),
        mesh.communicator());
    set_up_cells(cells);
  }

  std::vector<Discretization::CellIterator>
  Discretization::order_cells()
  {
    const dealii::IndexSet       &owned = dofs.locally_owned_dofs();
    std::vector<CellIterator>     inner, ghosted, ghosts;
    std::vector<global_dof_index> cell_dofs(fe.dofs_per_cell);
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_ghost())
        ghosts.push_back(cell);
      else if (cell->is_locally_owned())
        {
          cell->get_dof_indices(cell_dofs);
          const bool all_owned =
            std::all_of(cell_dofs.begin(),
                        cell_dofs.end(),
                        [&](const auto dof) { return owned.is_element(dof); });
          (all_owned ? inner : ghosted).push_back(cell);
        }
    n_owned       = inner.size() + ghosted.size();
    ghosted_cells = {inner.size() / 2, inner.size() / 2 + ghosted.size()};
    inner.insert(inner.begin() + ghosted_cells.first,
                 ghosted.begin(),
                 ghosted.end());
    if (mesh_pointer->geometry_degree() > 1 && degree() > 1)
      gather_curved(inner);
    inner.insert(inner.end(), ghosts.begin(), ghosts.end());
    return inner;
  }

  void
  Discretization::renumber_nodes(const std::vector<CellIterator> &cells)
  {
    const dealii::IndexSet        owned = dofs.locally_owned_dofs();
    std::vector<global_dof_index> new_numbers(owned.n_elements(),
                                              invalid_dof_index);
    std::vector<global_dof_index> cell_dofs(fe.dofs_per_cell);
    global_dof_index              next =
      owned.is_empty() ? 0 : *owned.begin() + owned.n_elements();
    // Going backwards, a node's number is taken where the sweep needs it last.
    const auto number_backwards = [&](const unsigned int begin,
                                      const unsigned int end) {
      for (unsigned int c = end; c-- > begin;)
        {
          cells[c]->get_dof_indices(cell_dofs);
          for (unsigned int i = n_cell_nodes; i-- > 0;)
            for (unsigned int a = 3; a-- > 0;)
              {
                const global_dof_index dof =
                  cell_dofs[fe.component_to_system_index(a, i)];
                if (!owned.is_element(dof))
                  continue;
                global_dof_index &number =
                  new_numbers[owned.index_within_set(dof)];
                if (number == invalid_dof_index)
                  number = --next;
              }
        }
    };
    number_backwards(n_owned, cells.size());
    first_shared = owned.is_empty() ? 0 : (next - *owned.begin()) / 3;
    number_backwards(0, n_owned);
    dofs.renumber_dofs(new_numbers);
  }

  void
  Discretization::set_up_cells(const std::vector<CellIterator> &cells)
  {
    initialize_vector(positions);
    std::vector<global_dof_index>        cell_dofs(fe.dofs_per_cell);
    const std::vector<dealii::Point<3>> &unit_points =
      fe.base_element(0).get_unit_support_points();
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const CellIterator &cell = cells[c];
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              const BoundaryFace face{c, f, cell->face(f)->boundary_id()};
              if (c < n_owned)
                surface.push_back(face);
              else if (face.boundary != unnamed_boundary)
                // The others may be inside of the body, where the known part
                // of the mesh ends.
                surface_of_ghosts.push_back(face);
            }

        active_indices.push_back(cell->active_cell_index());
        mesh_cells.push_back(cell->id().get_coarse_cell_id());

        dealii::Tensor<2, 3> jacobian;
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int a = 0; a < 3; ++a)
            jacobian[a][k] = cell->vertex(k + 1)[a] - cell->vertex(0)[a];
        geometries.push_back(
          {invert(jacobian), determinant(jacobian) / 6, cell->material_id()});

        cell->get_dof_indices(cell_dofs);
        for (unsigned int i = 0; i < n_cell_nodes; ++i)
          {
            const unsigned int dof = vector_partitioner->global_to_local(
              cell_dofs[fe.component_to_system_index(0, i)]);
            nodes_of_cells.push_back(dof / 3);
            const dealii::Tensor<1, 3> x =
              cell->vertex(0) + jacobian * unit_points[i];
            for (unsigned int a = 0; a < 3; ++a)
              positions.local_element(dof + a) = x[a];
          }
      }
    positions.set_ghost_state(true);
    make_batches();
    if (mesh_pointer->geometry_degree() > 1 && degree() > 1)
      {
        curve_positions(cells);
        set_up_curved_cells();
      }
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
