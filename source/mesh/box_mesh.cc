// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>
#include <corotet/mesh/box_mesh.h>

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



    std::vector<dealii::Point<3>>
    vertices(const std::array<double, 3>       &origin,
             const std::array<double, 3>       &size,
             const std::array<unsigned int, 3> &n_cuboids)
    {
      std::vector<dealii::Point<3>> result;
      result.reserve((n_cuboids[0] + 1ul) * (n_cuboids[1] + 1ul) *
                     (n_cuboids[2] + 1ul));
      for (unsigned int k = 0; k <= n_cuboids[2]; ++k)
        for (unsigned int j = 0; j <= n_cuboids[1]; ++j)
          for (unsigned int i = 0; i <= n_cuboids[0]; ++i)
            result.emplace_back(origin[0] + size[0] / n_cuboids[0] * i,
                                origin[1] + size[1] / n_cuboids[1] * j,
                                origin[2] + size[2] / n_cuboids[2] * k);
      return result;
    }



    // Adds the faces of a cell on the sides of the box: they have three corners
    // of the cell on that side of its cuboid.
    void
    add_faces(SerialMesh                        &mesh,
              const SerialMesh::Cell            &cell,
              const std::array<unsigned int, 4> &corners,
              const std::array<unsigned int, 3> &cuboid,
              const std::array<unsigned int, 3> &n_cuboids)
    {
      for (unsigned int d = 0; d < 3; ++d)
        for (const unsigned int side : {0, 1})
          {
            if (cuboid[d] != (side == 0 ? 0 : n_cuboids[d] - 1))
              continue;
            std::array<unsigned int, 4> on_side{};
            unsigned int                n_on_side = 0;
            for (unsigned int i = 0; i < 4; ++i)
              if ((corners[i] >> d) % 2 == side)
                on_side[n_on_side++] = cell.vertices[i];
            if (n_on_side == 3)
              mesh.faces.push_back(
                {{{on_side[0], on_side[1], on_side[2]}}, 2 * d + side});
          }
    }



    // Adds cells and faces; the vertices of the box are numbered with x
    // fastest.
    void
    add_cells(SerialMesh &mesh, const std::array<unsigned int, 3> &n_cuboids)
    {
      // So are those of a cuboid. Neighbours are mirrored: their diagonals
      // meet.
      using Tetrahedra          = std::array<std::array<unsigned int, 4>, 5>;
      constexpr Tetrahedra even = {{{{0, 1, 2, 4}},
                                    {{2, 1, 3, 7}},
                                    {{1, 4, 5, 7}},
                                    {{2, 4, 7, 6}},
                                    {{1, 2, 4, 7}}}};
      constexpr Tetrahedra odd  = {{{{0, 1, 3, 5}},
                                    {{0, 3, 2, 6}},
                                    {{0, 4, 5, 6}},
                                    {{3, 5, 7, 6}},
                                    {{0, 3, 6, 5}}}};

      mesh.cells.reserve(5ul * n_cuboids[0] * n_cuboids[1] * n_cuboids[2]);
      std::array<unsigned int, 3> cuboid;
      auto &[i, j, k] = cuboid;
      for (k = 0; k < n_cuboids[2]; ++k)
        for (j = 0; j < n_cuboids[1]; ++j)
          for (i = 0; i < n_cuboids[0]; ++i)
            for (const auto &corners : (i + j + k) % 2 == 0 ? even : odd)
              {
                SerialMesh::Cell &cell = mesh.cells.emplace_back();
                cell.region            = 0;
                for (unsigned int v = 0; v < 4; ++v)
                  cell.vertices[v] =
                    ((k + corners[v] / 4) * (n_cuboids[1] + 1) + j +
                     corners[v] / 2 % 2) *
                      (n_cuboids[0] + 1) +
                    i + corners[v] % 2;
                add_faces(mesh, cell, corners, cuboid, n_cuboids);
              }
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

    SerialMesh mesh;
    mesh.vertices = vertices(origin, size, n_cells);
    add_cells(mesh, n_cells);
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
