// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "mesh_statistics.h"

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>

namespace corotet
{
  MeshStatistics::MeshStatistics(const MeshCells   &part,
                                 const double       least_determinant,
                                 const unsigned int element_degree,
                                 const MPI_Comm     comm)
    : quality(mesh_quality(part, comm))
    , n_cells(dealii::Utilities::MPI::sum(part.cells.size(), comm))
    , geometry_degree(part.geometry_degree)
    , element_degree(element_degree)
    , least_determinant(least_determinant)
  {
    if (geometry_degree > 1)
      n_curved = dealii::Utilities::MPI::sum(part.curved_nodes.size() /
                                               part.n_map_nodes(),
                                             comm);
  }



  void
  MeshStatistics::log_lines(const std::uint64_t n_vertices, Log &log) const
  {
    log.line(fmt::format("Mesh: {} cells, {} vertices, volume {:.6g} m^3",
                         n_cells,
                         n_vertices,
                         quality.volume));
    log.line(fmt::format(
      "  smallest dihedral angle {:.2f} degrees, worst aspect ratio {:.2f} "
      "(longest edge over 2 sqrt(6) inradius; regular tetrahedron: 70.53 "
      "and 1)",
      quality.smallest_dihedral_angle,
      quality.worst_aspect_ratio));
    if (geometry_degree > 1)
      log.line(fmt::format(
        "  {} curved cells of degree {}, {}",
        n_curved,
        geometry_degree,
        element_degree == 1 ?
          "taken as straight ones by elements of degree 1" :
          fmt::format("{}smallest Jacobian determinant {:.3g} times its mean "
                      "in the cell",
                      geometry_degree > element_degree ?
                        fmt::format("taken as ones of degree {0} by elements "
                                    "of degree {0}, ",
                                    element_degree) :
                        "",
                      least_determinant)));
    if (quality.smallest_dihedral_angle < 2)
      log.warning("the mesh has almost flat cells; solvers will need many "
                  "iterations");
  }



  std::uint64_t
  number_of_vertices(const LocalMesh &mesh)
  {
    // Each vertex belongs to the rank of the first cell that has it.
    std::uint64_t first = mesh.n_global_cells, end = 0;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.is_owned(c))
        {
          first = std::min(first, mesh.numbers[c]);
          end   = mesh.numbers[c] + 1;
        }
    const auto n =
      std::count_if(mesh.vertex_numbers.begin(),
                    mesh.vertex_numbers.end(),
                    [&](const std::uint64_t number) {
                      return number / 4 >= first && number / 4 < end;
                    });
    return dealii::Utilities::MPI::sum(std::uint64_t(n), mesh.communicator);
  }

} // namespace corotet
