// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>
#include <corotet/base/mpi.h>
#include <corotet/base/text.h>
#include <corotet/base/timing.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/distributed_triangulation.h>
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
        double seconds = 0;
        {
          ScopedTimer timer(seconds);
          mesh = parameters.source.selected().create(folder,
                                                     parameters.n_refinements);
        }
        mesh.read_time = seconds;
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
    : region_names("region", {})
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
      {
        ScopedTimer timer(seconds_partition);
        sort_along_curve(mesh);
      }

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

    seconds_read = mesh.read_time;
    ScopedTimer timer(seconds_partition);
    local_mesh = distribute(mesh, comm);
  }



  const dealii::parallel::fullydistributed::Triangulation<3> &
  Mesh::triangulation() const
  {
    if (!tria)
      tria = std::make_unique<const DistributedTriangulation>(local_mesh);
    return *tria;
  }
} // namespace corotet
