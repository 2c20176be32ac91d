// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>
#include <corotet/mesh/box_mesh.h>
#include <corotet/mesh/triangulation.h>

#include <deal.II/grid/grid_generator.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  void
  BoxMesh::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Origin",
                      origin,
                      "The corner with the smallest x, y and z [m, before "
                      "scaling].",
                      List(Double(), 3, 3));
    // The upper limits keep a typing error from becoming overflow.
    prm.add_parameter("Size",
                      size,
                      "Lengths in x, y and z [m, before scaling].",
                      List(Double(1e-30, 1e30), 3, 3));
    prm.add_parameter("Cells",
                      n_cells,
                      "Numbers of cuboids in x, y and z. Each is cut into five "
                      "tetrahedra.",
                      List(Integer(1, 100000), 3, 3));
  }



  namespace
  {
    // Of what makes the mesh, on one rank [byte]; measured are some more.
    constexpr double bytes_per_cell = 300;



    void
    check_resolution(const std::array<double, 3>       &origin,
                     const std::array<double, 3>       &size,
                     const std::array<unsigned int, 3> &n_cells)
    {
      // Coordinates have 16 digits: with this many of them for the edges of
      // cells, shapes have six that are right.
      constexpr double least    = 1e-10;
      double           shortest = std::numeric_limits<double>::infinity();
      double           farthest = 0;
      for (unsigned int d = 0; d < 3; ++d)
        {
          shortest = std::min(shortest, size[d] / n_cells[d]);
          farthest = std::max(
            {farthest, std::abs(origin[d]), std::abs(origin[d] + size[d])});
        }
      if (!(shortest >= least * farthest))
        throw InputError(
          "Mesh/box/Origin",
          fmt::format("cells are lost in the round-off of coordinates: found "
                      "cells with edges of {:.3g} m and coordinates up to "
                      "{:.3g} m; allowed are coordinates up to 1e10 times the "
                      "shortest edge",
                      shortest,
                      farthest));
    }
  } // namespace



  SerialMesh
  BoxMesh::create(const std::string & /*folder*/,
                  const unsigned int /*n_refinements*/) const
  {
    const double n_tetrahedra = 5. * n_cells[0] * n_cells[1] * n_cells[2];
    if (n_tetrahedra > 1e8)
      throw InputError("Mesh/box/Cells",
                       fmt::format("too many cells: found {} x {} x {}, which "
                                   "makes {:.3g} tetrahedra and, with elements "
                                   "of degree 1, {:.3g} unknowns; at most 1e8 "
                                   "tetrahedra are allowed",
                                   n_cells[0],
                                   n_cells[1],
                                   n_cells[2],
                                   n_tetrahedra,
                                   3. * (n_cells[0] + 1.) * (n_cells[1] + 1.) *
                                     (n_cells[2] + 1.)));
    check_memory(bytes_per_cell * n_tetrahedra,
                 fmt::format("a mesh of {} x {} x {} cuboids",
                             n_cells[0],
                             n_cells[1],
                             n_cells[2]),
                 "fewer Mesh/box/Cells need less");

    check_resolution(origin, size, n_cells);

    dealii::Point<3> lower, upper;
    for (unsigned int d = 0; d < 3; ++d)
      {
        lower[d] = origin[d];
        upper[d] = origin[d] + size[d];
      }
    dealii::Triangulation<3> tria;
    dealii::GridGenerator::subdivided_hyper_rectangle_with_simplices(
      tria, {n_cells.begin(), n_cells.end()}, lower, upper, true);

    SerialMesh mesh = make_serial_mesh(tria);
    // deal.II numbers the octants.
    for (SerialMesh::Cell &cell : mesh.cells)
      cell.region = 0;
    mesh.regions.names    = {{0, "body"}};
    mesh.boundaries.names = {{0, "x-min"},
                             {1, "x-max"},
                             {2, "y-min"},
                             {3, "y-max"},
                             {4, "z-min"},
                             {5, "z-max"}};
    return mesh;
  }
} // namespace corotet
