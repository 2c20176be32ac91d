// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/distributed_triangulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>

namespace corotet
{
  namespace
  {
    using Base = dealii::parallel::fullydistributed::Triangulation<3>;
  }



  DistributedTriangulation::DistributedTriangulation(const LocalMesh &mesh)
    : Base(mesh.communicator)
    , numbers(mesh.numbers.begin(), mesh.numbers.end())
    , owners(mesh.owners)
  {
    // The descriptions of single cells are left empty: they would repeat what
    // is known here.
    dealii::TriangulationDescription::Description<3> description;
    description.comm      = get_communicator();
    description.smoothing = MeshSmoothing::none;
    description.settings =
      dealii::TriangulationDescription::Settings::default_setting;
    description.coarse_cell_vertices = mesh.vertices;
    description.coarse_cells.reserve(mesh.cells.size());
    for (const SerialMesh::Cell &cell : mesh.cells)
      {
        dealii::CellData<3> &data = description.coarse_cells.emplace_back(4);
        data.vertices.assign(cell.vertices.begin(), cell.vertices.end());
        data.material_id = cell.region;
      }
    create_triangulation(description);

    // The far side of the ghost cells, where the known part of the mesh ends,
    // looks like a surface to deal.II, but is not a boundary of the body.
    for (const auto &face : active_face_iterators())
      if (face->at_boundary())
        face->set_boundary_id(unnamed_boundary);
    for (const auto &[c, f, boundary] : mesh.faces)
      cell_iterator(this, 0, c)->face(f)->set_boundary_id(boundary);
  }



  unsigned int
  DistributedTriangulation::coarse_cell_id_to_coarse_cell_index(
    const dealii::types::coarse_cell_id id) const
  {
    const auto place = std::lower_bound(numbers.begin(), numbers.end(), id);
    Assert(place != numbers.end() && *place == id, dealii::ExcInternalError());
    return place - numbers.begin();
  }



  dealii::types::coarse_cell_id
  DistributedTriangulation::coarse_cell_index_to_coarse_cell_id(
    const unsigned int index) const
  {
    AssertIndexRange(index, numbers.size());
    return numbers[index];
  }



  void
  DistributedTriangulation::update_number_cache()
  {
    if (n_levels() > 0)
      for (const auto &cell : active_cell_iterators())
        cell->set_subdomain_id(owners[cell->active_cell_index()]);
    // The parent's function counts coarse cells in a description that it does
    // not have, so the grandparent's is called.
    // NOLINTNEXTLINE(bugprone-parent-virtual-call)
    dealii::parallel::TriangulationBase<3>::update_number_cache();
    if (n_levels() > 0)
      number_cache.number_of_global_coarse_cells =
        dealii::Utilities::MPI::max(numbers.back(), get_communicator()) + 1;
  }
} // namespace corotet
