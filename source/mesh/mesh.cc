// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>
#include <corotet/base/mpi.h>
#include <corotet/base/named_values.h>
#include <corotet/base/timing.h>
#include <corotet/mesh/cell_order.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/check_names.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/distributed_triangulation.h>
#include <corotet/mesh/graph_partition.h>
#include <corotet/mesh/mesh.h>
#include <corotet/mesh/mesh_quality.h>
#include <corotet/mesh/mesh_sources.h>
#include <corotet/mesh/refinement.h>
#include <corotet/mesh/spread_mesh.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "mesh_statistics.h"

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
        double seconds = 0;
        {
          ScopedTimer timer(seconds);
          mesh = parameters.source.selected().create(folder,
                                                     parameters.n_refinements);
        }
        mesh.read_time = seconds;
        if (mesh.is_in_millimetres && parameters.scale == 1)
          mesh.remarks.emplace_back(
            "coordinates are in millimetres and taken for metres: "
            "\"Mesh/Scale\" is 1; 0.001 makes metres of them");
      });
      return mesh;
    }



    void
    check_size(const std::string  &origin,
               const std::uint64_t n_coarse_cells,
               const unsigned int  n_refinements,
               const unsigned int  element_degree,
               const unsigned int  n_ranks)
    {
      check_number_of_cells(n_coarse_cells, n_refinements);
      const double n_cells = n_coarse_cells * std::pow(8., n_refinements);
      // Half of the memory that was measured for a body at rest, without
      // solvers [byte]. With several ranks it is not checked, as they may be on
      // several machines.
      constexpr double bytes_per_cell[] = {350, 600, 1500};
      if (n_ranks == 1)
        check_memory(n_cells * bytes_per_cell[element_degree - 1],
                     fmt::format("{:.4g} cells of degree {}",
                                 n_cells,
                                 element_degree),
                     "fewer cells, a lower Discretization/Degree or ranks on "
                     "more machines need less");
      if (n_cells < n_ranks)
        refuse_mesh(origin,
                    fmt::format("too few cells: found {} for {} ranks; each "
                                "needs at least one",
                                n_cells,
                                n_ranks));
    }



    std::string
    list(const MeshNames &names)
    {
      const std::string words = list_of_names(names.known());
      return words.empty() ? "none" : words;
    }



    void
    multiply(MeshCells &mesh, const double scale)
    {
      for (auto *points : {&mesh.vertices, &mesh.curved_nodes})
        for (dealii::Point<3> &point : *points)
          point *= scale;
    }



    void
    log_remarks(const std::vector<std::string> &remarks, Log &log)
    {
      for (const std::string &remark : remarks)
        {
          log.line("  " + remark);
          if (remark.starts_with("warning"))
            log.count("warning", "warnings");
        }
    }



    void
    log_names(const MeshNames &regions, const PlaceNames &places, Log &log)
    {
      std::string names = "  regions: " + list(regions) +
                          "; boundaries: " + list(places.boundaries);
      if (!places.edges.all().empty())
        names += "; edges: " + list(places.edges);
      if (!places.corners.all().empty())
        names += "; corners: " + list(places.corners);
      log.line(names);
    }



    // Distributes a mesh that rank 0 has. @p n_refinements becomes the number
    // of refinements that are still to be made.
    SpreadMesh
    scattered(SerialMesh         mesh,
              unsigned int      &n_refinements,
              const MPI_Comm     comm,
              const unsigned int element_degree)
    {
      namespace MPI = dealii::Utilities::MPI;
      SpreadMesh result;
      {
        ScopedTimer timer(result.scatter_time);
        NamedParts  named;
        on_root(comm, [&] {
          if (mesh.n_refinements > n_refinements)
            refuse_mesh(mesh.origin,
                        fmt::format("found {} refinements by the source of the "
                                    "mesh; allowed: at most {}, the number "
                                    "that was asked for",
                                    mesh.n_refinements,
                                    n_refinements));
          n_refinements -= mesh.n_refinements;
          check_vertices(mesh);
          check_size(mesh.origin,
                     mesh.cells.size(),
                     n_refinements,
                     element_degree,
                     MPI::n_mpi_processes(comm));
          named        = check_names(mesh);
          result.names = UsedNames(mesh);
        });
        n_refinements    = MPI::broadcast(comm, n_refinements, 0);
        result.origin    = MPI::broadcast(comm, mesh.origin, 0);
        result.read_time = mesh.read_time;
        result.remarks   = mesh.remarks;
        result.names.broadcast(comm);
        result.part = scatter(whole_part(mesh, std::move(named)), comm);
      }
      return result;
    }
  } // namespace



  MeshParameters::MeshParameters()
    : source(mesh_sources(), "box")
  {}



  void
  MeshParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    source.declare_parameters(
      prm,
      "Source of the mesh: 'box', a cuboid that the program meshes; 'file', a "
      "file with a mesh or a geometry; 'gmsh', the former name of 'file'. The "
      "parameters of each are in the subsection of its name.");
    prm.add_parameter("Refinements",
                      n_refinements,
                      "Number of uniform refinements [-], each of which cuts "
                      "every tetrahedron into eight. New vertices of a mesh "
                      "that is made of a geometry lie on that (.geo, STEP, "
                      "IGES, BREP; on a surface of triangles not always). "
                      "Curved cells of a mesh are cut along their curved "
                      "shape.",
                      dealii::Patterns::Integer(0, 9));
    prm.add_parameter("Scale",
                      scale,
                      "Factor on all coordinates [-]: 0.001 for a mesh in mm.",
                      dealii::Patterns::Double(1e-30, 1e30));
    add_enumeration(prm,
                    "Partitioner",
                    partitioner,
                    partitioners(),
                    "How cells are distributed to ranks, with equal work for "
                    "each: 'Hilbert curve', each rank gets a piece of the "
                    "space-filling curve along which cells are sorted, at no "
                    "cost; 'PT-Scotch', a graph partitioner makes parts with "
                    "few faces between them, if corotet was built with it. "
                    "Results are the same but for round-off.");
  }



  Mesh::Mesh(const MeshParameters &parameters,
             const std::string    &folder,
             const MPI_Comm        comm,
             Log                  &log,
             const unsigned int    element_degree)
    : region_names("region", {})
    , place_names({})
  {
    const MeshSource           &source        = parameters.source.selected();
    unsigned int                n_refinements = parameters.n_refinements;
    std::shared_ptr<SpreadMesh> mesh = source.create_spread(folder, comm);
    if (mesh)
      {
        on_all_ranks(comm, [&] { check_curves(mesh->part, mesh->origin); });
        check_size(mesh->origin,
                   dealii::Utilities::MPI::sum(mesh->part.cells.size(), comm),
                   n_refinements,
                   element_degree,
                   dealii::Utilities::MPI::n_mpi_processes(comm));
      }
    else
      mesh = std::make_shared<SpreadMesh>(
        scattered(create_on_root(parameters, folder, comm),
                  n_refinements,
                  comm,
                  element_degree));
    set_up(
      std::move(*mesh), n_refinements, parameters, comm, log, element_degree);
  }



  Mesh::Mesh(SerialMesh         mesh,
             const unsigned int n_refinements,
             const double       scale,
             const MPI_Comm     comm,
             Log               &log,
             const unsigned int element_degree)
    : region_names("region", {})
    , place_names({})
  {
    unsigned int   n_left = n_refinements;
    MeshParameters parameters;
    parameters.scale = scale;
    SpreadMesh spread =
      scattered(std::move(mesh), n_left, comm, element_degree);
    set_up(std::move(spread), n_left, parameters, comm, log, element_degree);
  }



  void
  Mesh::set_up(SpreadMesh          &&mesh,
               const unsigned int    n_refinements,
               const MeshParameters &parameters,
               const MPI_Comm        comm,
               Log                  &log,
               const unsigned int    element_degree)
  {
    seconds_read          = mesh.read_time;
    seconds_partition     = mesh.scatter_time;
    const auto take_names = [&] {
      region_names = MeshNames("region", mesh.names.regions);
      place_names =
        PlaceNames(mesh.names.boundaries, mesh.names.edges, mesh.names.corners);
    };
    take_names();

    ScopedTimer timer(seconds_partition);
    MeshPart   &part = mesh.part;
    double      least_determinant =
      check_cells_on_ranks(part, mesh.origin, element_degree, comm);
    sort_along_curve(part, comm);
    const auto spread_out = [&] {
      MeshStatistics statistics(part, least_determinant, element_degree, comm);
      local_mesh = with_cells_beside(std::move(part), mesh.origin, comm);
      return statistics;
    };
    MeshStatistics statistics = spread_out();
    // Refinements follow the curves at any degree.
    if (element_degree > 1 || n_refinements > 0)
      on_all_ranks(comm, [&] { check_common_nodes(local_mesh, mesh.origin); });
    check_surface_on_ranks(local_mesh, mesh.origin);
    check_boundaries(mesh.origin);
    if (n_refinements > 0)
      {
        part       = owned_part(local_mesh);
        local_mesh = {};
        refine_uniformly(part, n_refinements, comm);
        // Refinement has moved vertices onto the curves.
        least_determinant =
          check_cells_on_ranks(part, mesh.origin, element_degree, comm);
        sort_along_curve(part, comm);
        statistics = spread_out();
      }
    const double scale = parameters.scale;
    multiply(local_mesh, scale);
    statistics.quality.volume *= scale * scale * scale;
    statistics.log_lines(number_of_vertices(local_mesh), log);
    log_remarks(mesh.remarks, log);

    select(local_mesh, mesh.names, parameters.selections, log);
    take_names();
    log_names(region_names, place_names, log);
    if (parameters.partitioner == Partitioner::pt_scotch)
      share_out_by_graph(mesh.origin, log);
  }



  void
  Mesh::share_out_by_graph(const std::string &origin, Log &log)
  {
    const MPI_Comm comm = communicator();
    if (dealii::Utilities::MPI::n_mpi_processes(comm) == 1)
      return;
    const std::uint64_t before = n_faces_between_ranks(local_mesh);
    MeshPart            part   = partition_graph(local_mesh);
    local_mesh                 = {};
    local_mesh = with_cells_beside(std::move(part), origin, comm);
    log.line(fmt::format("  PT-Scotch: {} faces between ranks, along the curve "
                         "{}",
                         n_faces_between_ranks(local_mesh),
                         before));
  }



  void
  Mesh::check_boundaries(const std::string &origin) const
  {
    on_all_ranks(communicator(), [&] {
      for (const auto &[cell, face, boundary] : local_mesh.faces)
        if (local_mesh.is_owned(cell) &&
            local_mesh.neighbors[cell][face] != LocalMesh::no_cell)
          refuse_mesh(
            origin,
            fmt::format(
              "the boundary '{}' has a face inside of the "
              "body, of a cell with a vertex at {}",
              boundaries().name(boundary),
              position(
                local_mesh.vertices[local_mesh.cells[cell].vertices[0]])));
    });
  }



  const dealii::parallel::fullydistributed::Triangulation<3> &
  Mesh::triangulation() const
  {
    if (!tria)
      tria = std::make_unique<const DistributedTriangulation>(local_mesh);
    return *tria;
  }
} // namespace corotet
