// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>
#include <corotet/base/mpi.h>
#include <corotet/base/text.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/mesh.h>
#include <corotet/mesh/mesh_quality.h>
#include <corotet/mesh/mesh_sources.h>
#include <corotet/mesh/triangulation.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  namespace
  {
    SerialMesh
    create_on_root(const MeshParameters &parameters,
                   const std::string    &folder,
                   const MPI_Comm        comm)
    {
      SerialMesh mesh;
      on_root(comm, [&] {
        mesh =
          parameters.source.selected().create(folder, parameters.n_refinements);
      });
      return mesh;
    }



    void
    check_size(const SerialMesh  &mesh,
               const unsigned int n_refinements,
               const unsigned int element_degree,
               const unsigned int n_ranks)
    {
      check_number_of_cells(mesh.cells.size(), n_refinements);
      const double n_cells = mesh.cells.size() * std::pow(8., n_refinements);
      // Half of what was measured for a body at rest, solvers not included
      // [byte]. Several ranks may be on several machines.
      constexpr double bytes_per_cell[] = {350, 600, 1500};
      if (n_ranks == 1)
        check_memory(n_cells * bytes_per_cell[element_degree - 1],
                     fmt::format("{:.4g} cells of degree {}",
                                 n_cells,
                                 element_degree),
                     "fewer cells, a lower Discretization/Degree or ranks on "
                     "more machines need less");
      if (n_cells < n_ranks)
        refuse_mesh(mesh,
                    fmt::format("too few cells: found {} for {} ranks; each "
                                "needs at least one",
                                n_cells,
                                n_ranks));
    }



    NamedSets
    regions_of(const SerialMesh &mesh)
    {
      std::vector<unsigned int> ids;
      ids.reserve(mesh.cells.size());
      for (const SerialMesh::Cell &cell : mesh.cells)
        ids.push_back(cell.region);
      NamedSets regions = mesh.regions;
      regions.restrict_to(ids);
      return regions;
    }



    NamedSets
    boundaries_of(const SerialMesh &mesh)
    {
      std::vector<unsigned int> ids;
      ids.reserve(mesh.faces.size());
      for (const SerialMesh::Face &face : mesh.faces)
        ids.push_back(face.boundary);
      NamedSets boundaries = mesh.boundaries;
      boundaries.restrict_to(ids);
      return boundaries;
    }



    // Of edges or of corners.
    template <typename Part>
    NamedSets
    used_names(NamedSets named, const std::vector<Part> &parts)
    {
      std::vector<unsigned int> ids;
      ids.reserve(parts.size());
      for (const Part &part : parts)
        ids.push_back(part.id);
      named.restrict_to(ids);
      return named;
    }



    std::string
    list(const MeshNames &names)
    {
      const std::vector<std::string> words = names.known();
      return words.empty() ? "none" : join(words);
    }



    void
    log_quality(const SerialMesh  &mesh,
                const unsigned int element_degree,
                Log               &log)
    {
      const MeshQuality quality = mesh_quality(mesh);
      log.line(fmt::format("Mesh: {} cells, {} vertices, volume {:.6g} m^3",
                           mesh.cells.size(),
                           mesh.vertices.size(),
                           quality.volume));
      log.line(fmt::format("  smallest dihedral angle {:.2f} degrees, worst "
                           "aspect ratio {:.2f} (longest edge over 2 sqrt(6) "
                           "inradius; regular tetrahedron: 70.53 and 1)",
                           quality.smallest_dihedral_angle,
                           quality.worst_aspect_ratio));
      if (mesh.geometry_degree > 1)
        log.line(fmt::format(
          "  {} curved cells of degree {}, {}",
          std::count_if(mesh.cells.begin(),
                        mesh.cells.end(),
                        [](const SerialMesh::Cell &cell) {
                          return cell.curve != SerialMesh::straight;
                        }),
          mesh.geometry_degree,
          element_degree == 1 ?
            "taken as straight ones by elements of degree 1" :
            fmt::format("smallest Jacobian determinant {:.3g} times its mean "
                        "in the cell",
                        check_curved_cells(mesh, element_degree))));
      if (quality.smallest_dihedral_angle < 2)
        log.warning("the mesh has almost flat cells; solvers will need many "
                    "iterations");
    }
  } // namespace



  MeshParameters::MeshParameters()
    : source(mesh_sources(), "box")
  {}



  void
  MeshParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    source.declare_parameters(prm, "Where the mesh comes from.");
    prm.add_parameter("Refinements",
                      n_refinements,
                      "How often every tetrahedron is cut into eight [-]. Of a "
                      ".geo, new vertices lie on the geometry; parts of "
                      "curved cells lie on these.",
                      dealii::Patterns::Integer(0, 9));
    prm.add_parameter("Scale",
                      scale,
                      "Factor on all coordinates [-]: 0.001 for a mesh in mm.",
                      dealii::Patterns::Double(1e-30, 1e30));
  }



  Mesh::Mesh(const MeshParameters &parameters,
             const std::string    &folder,
             const MPI_Comm        comm,
             Log                  &log,
             const unsigned int    element_degree)
    : Mesh(create_on_root(parameters, folder, comm),
           parameters.n_refinements,
           parameters.scale,
           comm,
           log,
           element_degree,
           parameters.selections)
  {}



  Mesh::Mesh(SerialMesh                 mesh,
             const unsigned int         n_refinements,
             const double               scale,
             const MPI_Comm             comm,
             Log                       &log,
             const unsigned int         element_degree,
             const SelectionParameters &selections)
    : tria(comm)
    , region_names("region", {})
    , place_names({})
  {
    NamedSets regions, boundaries, edges, corners;
    on_root(comm, [&] {
      check_mesh(mesh, element_degree);
      const unsigned int n_left = n_refinements - mesh.n_refinements;
      check_size(mesh,
                 n_left,
                 element_degree,
                 dealii::Utilities::MPI::n_mpi_processes(comm));
      refine_uniformly(mesh, n_left);
      if (n_left > 0 && mesh.geometry_degree > 1)
        // Vertices have moved to where the curves have them.
        check_cells(mesh, element_degree);
      for (auto *points : {&mesh.vertices, &mesh.curved_nodes})
        for (dealii::Point<3> &point : *points)
          point *= scale;
      sort_along_curve(mesh);

      log_quality(mesh, element_degree, log);
      for (const std::string &remark : mesh.remarks)
        log.line("  " + remark);
      select(mesh, selections, log);
      regions    = regions_of(mesh);
      boundaries = boundaries_of(mesh);
      edges      = used_names(mesh.edge_names, mesh.edges);
      corners    = used_names(mesh.corner_names, mesh.corners);
    });

    const auto broadcast = [](const MPI_Comm comm, const NamedSets &named) {
      using dealii::Utilities::MPI::broadcast;
      return NamedSets{broadcast(comm, named.names, 0),
                       broadcast(comm, named.sets, 0)};
    };
    region_names      = MeshNames("region", broadcast(comm, regions));
    boundaries        = broadcast(comm, boundaries);
    edges             = broadcast(comm, edges);
    corners           = broadcast(comm, corners);
    place_names       = PlaceNames(boundaries, edges, corners);
    std::string names = "  regions: " + list(region_names) +
                        "; boundaries: " + list(place_names.boundaries);
    if (!edges.names.empty())
      names += "; edges: " + list(place_names.edges);
    if (!corners.names.empty())
      names += "; corners: " + list(place_names.corners);
    log.line(names);
    distribute(mesh, tria);
    distribute_curved_nodes(mesh);
    if (!edges.names.empty() || !corners.names.empty())
      distribute_edges_and_corners(mesh);
  }



  void
  Mesh::distribute_curved_nodes(const SerialMesh &mesh)
  {
    using namespace dealii::Utilities;
    const MPI_Comm comm = communicator();
    curve_degree        = MPI::broadcast(comm, mesh.geometry_degree, 0);
    if (curve_degree == 1)
      return;
    // Cells are numbered on rank 0, and known by these numbers elsewhere.
    std::vector<unsigned int> cells;
    for (const auto &cell : tria.active_cell_iterators())
      if (!cell->is_artificial())
        cells.push_back(cell->id().get_coarse_cell_id());
    std::vector<std::vector<double>> nodes_of_ranks;
    const unsigned int               n = n_curved_nodes();
    for (const auto &cells_of_rank : MPI::gather(comm, cells))
      {
        // Of each cell whether it is curved, and then its nodes.
        std::vector<double> &nodes = nodes_of_ranks.emplace_back();
        for (const unsigned int c : cells_of_rank)
          {
            const bool is_curved = mesh.cells[c].curve != SerialMesh::straight;
            nodes.push_back(is_curved);
            for (unsigned int i = 0; is_curved && i < n; ++i)
              for (unsigned int a = 0; a < 3; ++a)
                nodes.push_back(
                  corotet::curved_nodes(mesh, mesh.cells[c])[i][a]);
          }
      }
    const std::vector<double> nodes = MPI::scatter(comm, nodes_of_ranks);
    const double             *next  = nodes.data();
    curves.resize(tria.n_active_cells(), SerialMesh::straight);
    for (const auto &cell : tria.active_cell_iterators())
      if (!cell->is_artificial() && *next++ != 0)
        {
          curves[cell->active_cell_index()] = nodes_of_curves.size() / n;
          for (unsigned int i = 0; i < n; ++i, next += 3)
            nodes_of_curves.emplace_back(next[0], next[1], next[2]);
        }
  }



  void
  Mesh::distribute_edges_and_corners(const SerialMesh &mesh)
  {
    using namespace dealii::Utilities;
    const MPI_Comm comm = communicator();
    // Cells are numbered on rank 0, and known by these numbers elsewhere.
    std::vector<unsigned int> cells, active_indices;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cells.push_back(cell->id().get_coarse_cell_id());
          active_indices.push_back(cell->active_cell_index());
        }
    // Of each rank those of edges and those of corners, three numbers each.
    std::vector<std::vector<std::vector<unsigned int>>> parts_of_ranks;
    const PartsOfCells                                  parts(mesh);
    for (const auto &cells_of_rank : MPI::gather(comm, cells))
      {
        std::vector<CellPart> edges, corners;
        for (unsigned int c = 0; c < cells_of_rank.size(); ++c)
          {
            const SerialMesh::Cell &cell = mesh.cells[cells_of_rank[c]];
            parts.add_edges(edges, cell, c);
            parts.add_corners(corners, cell, c);
          }
        auto &numbers = parts_of_ranks.emplace_back();
        for (const auto *found : {&edges, &corners})
          {
            numbers.emplace_back();
            for (const auto &[cell, number, id] : *found)
              numbers.back().insert(numbers.back().end(), {cell, number, id});
          }
      }
    const auto received = MPI::scatter(comm, parts_of_ranks);
    for (const auto &[numbers, result] :
         {std::pair(&received[0], &edges_of_cells),
          std::pair(&received[1], &corners_of_cells)})
      for (std::size_t i = 0; i + 3 <= numbers->size(); i += 3)
        result->push_back({active_indices[(*numbers)[i]],
                           (*numbers)[i + 1],
                           (*numbers)[i + 2]});
  }
} // namespace corotet
