// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/base/text.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/mesh.h>
#include <corotet/mesh/mesh_quality.h>
#include <corotet/mesh/mesh_sources.h>
#include <corotet/mesh/triangulation.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <cmath>

namespace corotet
{
  namespace
  {
    using Names = std::map<unsigned int, std::string>;

    // More would exceed the 32-bit numbers of deal.II's unknowns at degree 3.
    constexpr double max_n_cells = 3e8;



    SerialMesh
    create_on_root(const MeshParameters &parameters,
                   const std::string    &folder,
                   const MPI_Comm        comm)
    {
      SerialMesh mesh;
      on_root(comm,
              [&] { mesh = parameters.source.selected().create(folder); });
      return mesh;
    }



    void
    check_size(const SerialMesh  &mesh,
               const unsigned int n_refinements,
               const unsigned int n_ranks)
    {
      const double n_cells = mesh.cells.size() * std::pow(8., n_refinements);
      if (n_cells > max_n_cells)
        throw InputError("Mesh/Refinements",
                         fmt::format("too many cells: found {} refinements, "
                                     "which make {:.3g} cells of {}; at most "
                                     "{:.3g} are allowed",
                                     n_refinements,
                                     n_cells,
                                     mesh.cells.size(),
                                     max_n_cells));
      if (n_cells < n_ranks)
        refuse_mesh(mesh,
                    fmt::format("too few cells: found {} for {} ranks; each "
                                "needs at least one",
                                n_cells,
                                n_ranks));
    }



    // Names of the ids that occur in the mesh.
    Names
    names_in_use(const Names &names, const std::vector<unsigned int> &ids)
    {
      Names in_use;
      for (const unsigned int id : ids)
        if (const auto name = names.find(id); name != names.end())
          in_use.insert(*name);
        else
          in_use.emplace(id, "");
      return in_use;
    }



    Names
    regions_of(const SerialMesh &mesh)
    {
      std::vector<unsigned int> ids;
      ids.reserve(mesh.cells.size());
      for (const SerialMesh::Cell &cell : mesh.cells)
        ids.push_back(cell.region);
      return names_in_use(mesh.region_names, ids);
    }



    Names
    boundaries_of(const SerialMesh &mesh)
    {
      std::vector<unsigned int> ids;
      ids.reserve(mesh.faces.size());
      for (const SerialMesh::Face &face : mesh.faces)
        ids.push_back(face.boundary);
      return names_in_use(mesh.boundary_names, ids);
    }



    std::string
    list(const MeshNames &names)
    {
      std::vector<std::string> words;
      for (const auto &[id, name] : names.all())
        words.push_back(names.name(id));
      return words.empty() ? "none" : join(words);
    }



    void
    log_quality(const SerialMesh &mesh, Log &log)
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
                      "How often every tetrahedron is cut into eight [-].",
                      dealii::Patterns::Integer(0, 9));
    prm.add_parameter("Scale",
                      scale,
                      "Factor on all coordinates [-]: 0.001 for a mesh in mm.",
                      dealii::Patterns::Double(1e-30, 1e30));
  }



  Mesh::Mesh(const MeshParameters &parameters,
             const std::string    &folder,
             const MPI_Comm        comm,
             Log                  &log)
    : Mesh(create_on_root(parameters, folder, comm),
           parameters.n_refinements,
           parameters.scale,
           comm,
           log)
  {}



  Mesh::Mesh(SerialMesh         mesh,
             const unsigned int n_refinements,
             const double       scale,
             const MPI_Comm     comm,
             Log               &log)
    : tria(comm)
    , region_names("region", {})
    , boundary_names("boundary", {})
  {
    Names regions, boundaries;
    on_root(comm, [&] {
      check_mesh(mesh);
      check_size(mesh,
                 n_refinements,
                 dealii::Utilities::MPI::n_mpi_processes(comm));
      refine_uniformly(mesh, n_refinements);
      for (dealii::Point<3> &vertex : mesh.vertices)
        vertex *= scale;
      sort_along_curve(mesh);

      log_quality(mesh, log);
      for (const std::string &remark : mesh.remarks)
        log.line("  " + remark);
      regions    = regions_of(mesh);
      boundaries = boundaries_of(mesh);
    });

    using dealii::Utilities::MPI::broadcast;
    region_names   = MeshNames("region", broadcast(comm, regions, 0));
    boundary_names = MeshNames("boundary", broadcast(comm, boundaries, 0));
    log.line("  regions: " + list(region_names) +
             "; boundaries: " + list(boundary_names));
    distribute(mesh, tria);
  }
} // namespace corotet
