// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>
#include <corotet/base/mpi.h>
#include <corotet/base/timing.h>
#include <corotet/mesh/box_mesh.h>
#include <corotet/mesh/edges.h>
#include <corotet/mesh/mesh_part.h>
#include <corotet/mesh/spread_mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>

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
    // The memory for making the mesh on one rank [byte]; measurements gave a
    // bit more.
    constexpr double bytes_per_cell = 300;



    void
    check_resolution(const std::array<double, 3>       &origin,
                     const std::array<double, 3>       &size,
                     const std::array<unsigned int, 3> &n_cells)
    {
      // The smallest size of cells relative to coordinates, which have 16
      // digits: then six digits of the cells' shapes are right.
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



    constexpr unsigned int cells_per_cuboid = 5;

    // The corners of the cells of a cuboid, whose vertices are numbered with x
    // fastest. Neighbouring cuboids are mirror images, so their diagonals meet.
    using Tetrahedra = std::array<std::array<unsigned int, 4>, 5>;
    constexpr Tetrahedra even_cuboid = {{{{0, 1, 2, 4}},
                                         {{2, 1, 3, 7}},
                                         {{1, 4, 5, 7}},
                                         {{2, 4, 7, 6}},
                                         {{1, 2, 4, 7}}}};
    constexpr Tetrahedra odd_cuboid  = {{{{0, 1, 3, 5}},
                                         {{0, 3, 2, 6}},
                                         {{0, 4, 5, 6}},
                                         {{3, 5, 7, 6}},
                                         {{0, 3, 6, 5}}}};



    // The cuboids and the vertices of a box, each numbered with x fastest.
    class Grid
    {
    public:
      using Place = std::array<unsigned int, 3>;

      Grid(const std::array<double, 3>       &origin,
           const std::array<double, 3>       &size,
           const std::array<unsigned int, 3> &n_cuboids)
        : origin(origin)
        , size(size)
        , n(n_cuboids)
      {}

      Place
      cuboid(const std::uint64_t number) const
      {
        return place(number, n[0], n[1]);
      }

      std::uint64_t
      vertex(const Place &cuboid, const unsigned int corner) const
      {
        return ((cuboid[2] + corner / 4) * (n[1] + 1ul) + cuboid[1] +
                corner / 2 % 2) *
                 (n[0] + 1ul) +
               cuboid[0] + corner % 2;
      }

      dealii::Point<3>
      position(const std::uint64_t vertex) const
      {
        const Place      at = place(vertex, n[0] + 1, n[1] + 1);
        dealii::Point<3> result;
        for (unsigned int d = 0; d < 3; ++d)
          result[d] = origin[d] + size[d] / n[d] * at[d];
        return result;
      }

      // The side of the box that a face lies on, given by its corners in a
      // cuboid.
      std::optional<unsigned int>
      side(const Place &cuboid, const std::array<unsigned int, 3> &face) const
      {
        for (unsigned int d = 0; d < 3; ++d)
          for (const unsigned int side : {0, 1})
            if (cuboid[d] == (side == 0 ? 0 : n[d] - 1) &&
                std::all_of(face.begin(),
                            face.end(),
                            [&](const unsigned int corner) {
                              return (corner >> d) % 2 == side;
                            }))
              return 2 * d + side;
        return {};
      }

    private:
      static Place
      place(const std::uint64_t number,
            const std::uint64_t n_x,
            const std::uint64_t n_y)
      {
        return {{static_cast<unsigned int>(number % n_x),
                 static_cast<unsigned int>(number / n_x % n_y),
                 static_cast<unsigned int>(number / n_x / n_y)}};
      }

      const std::array<double, 3>       origin, size;
      const std::array<unsigned int, 3> n;
    };



    // The cells [first, end) in the order of cuboids, with their vertices in
    // the order in which the cells use them.
    MeshPart
    cells_between(const Grid         &grid,
                  const std::uint64_t first,
                  const std::uint64_t end)
    {
      MeshPart part;
      part.cells.reserve(end - first);
      part.numbers.reserve(end - first);
      // Local numbers of the vertices, which are counted from the lowest global
      // number.
      std::vector<unsigned int> known;
      const std::uint64_t       lowest =
        first == end ? 0 :
                             grid.vertex(grid.cuboid(first / cells_per_cuboid), 0);
      const auto vertex = [&](const std::uint64_t number) {
        const std::size_t k = number - lowest;
        if (k >= known.size())
          known.resize(k + 1, dealii::numbers::invalid_unsigned_int);
        if (known[k] == dealii::numbers::invalid_unsigned_int)
          {
            known[k] = part.vertices.size();
            part.vertices.push_back(grid.position(number));
            part.vertex_numbers.push_back(number);
          }
        return known[k];
      };
      for (std::uint64_t number = first; number < end; ++number)
        {
          const Grid::Place cuboid = grid.cuboid(number / cells_per_cuboid);
          const Tetrahedra &tetrahedra =
            (cuboid[0] + cuboid[1] + cuboid[2]) % 2 == 0 ? even_cuboid :
                                                           odd_cuboid;
          const auto        &corners = tetrahedra[number % cells_per_cuboid];
          const unsigned int name    = part.cells.size();
          SerialMesh::Cell  &cell    = part.cells.emplace_back();
          cell.region                = 0;
          part.numbers.push_back(number);
          for (unsigned int v = 0; v < 4; ++v)
            cell.vertices[v] = vertex(grid.vertex(cuboid, corners[v]));
          for (unsigned int f = 0; f < 4; ++f)
            {
              const auto [a, b, c] = corners_of_faces[f];
              if (const auto side =
                    grid.side(cuboid, {{corners[a], corners[b], corners[c]}}))
                part.faces.push_back({name, f, *side});
            }
        }
      return part;
    }



    std::map<unsigned int, std::string>
    regions()
    {
      return {{0, "body"}};
    }



    std::map<unsigned int, std::string>
    sides()
    {
      return {{0, "x-min"},
              {1, "x-max"},
              {2, "y-min"},
              {3, "y-max"},
              {4, "z-min"},
              {5, "z-max"}};
    }
  } // namespace



  void
  BoxMesh::check(const unsigned int n_ranks) const
  {
    const double n_tetrahedra =
      1. * cells_per_cuboid * n_cells[0] * n_cells[1] * n_cells[2];
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
    check_memory(bytes_per_cell * n_tetrahedra / n_ranks,
                 fmt::format("a mesh of {} x {} x {} cuboids",
                             n_cells[0],
                             n_cells[1],
                             n_cells[2]),
                 "fewer Mesh/box/Cells need less");
    check_resolution(origin, size, n_cells);
  }



  MeshPart
  BoxMesh::piece(const unsigned int rank, const unsigned int n_ranks) const
  {
    const std::uint64_t n =
      std::uint64_t(cells_per_cuboid) * n_cells[0] * n_cells[1] * n_cells[2];
    return cells_between(Grid(origin, size, n_cells),
                         n * rank / n_ranks,
                         n * (rank + 1) / n_ranks);
  }



  SerialMesh
  BoxMesh::create(const std::string & /*folder*/,
                  const unsigned int /*n_refinements*/) const
  {
    check(1);
    MeshPart whole = piece(0, 1);
    sort_vertices(whole);
    SerialMesh mesh       = serial_mesh(std::move(whole));
    mesh.regions.names    = regions();
    mesh.boundaries.names = sides();
    return mesh;
  }



  std::shared_ptr<SpreadMesh>
  BoxMesh::create_spread(const std::string & /*folder*/,
                         const MPI_Comm comm) const
  {
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
    auto               mesh    = std::make_shared<SpreadMesh>();
    on_all_ranks(comm, [&] {
      ScopedTimer timer(mesh->read_time);
      check(n_ranks);
      mesh->part =
        piece(dealii::Utilities::MPI::this_mpi_process(comm), n_ranks);
      mesh->names.regions.names    = regions();
      mesh->names.boundaries.names = sides();
    });
    return mesh;
  }
} // namespace corotet
