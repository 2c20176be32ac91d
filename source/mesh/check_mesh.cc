// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/check_names.h>
#include <corotet/mesh/check_surface.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/face_neighbors.h>
#include <corotet/mesh/mesh_quality.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace corotet
{
  namespace
  {
    // More cells would exceed the 32-bit numbers of deal.II's unknowns at
    // degree 3.
    constexpr double max_n_cells = 3e8;

    // A cell is flat if its volume is below this many cubes of its longest
    // edge: the round-off of the volume. Needles and slivers are allowed.
    constexpr double flat = 1e-14;



    // The number of cells without a positive volume, and the first of them.
    struct WrongVolumes
    {
      std::size_t                     n_cells    = 0;
      unsigned int                    first_cell = 0;
      std::array<dealii::Point<3>, 4> first;
      double                          first_volume = 0;
    };



    WrongVolumes
    find_wrong_volumes(const MeshCells &mesh)
    {
      WrongVolumes wrong;
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        {
          const auto   p      = cell_vertices(mesh, mesh.cells[c]);
          const double volume = signed_volume(p);
          const double edge_2 = square_of_longest_edge(p);
          const bool   is_flat =
            std::abs(volume) <= flat * edge_2 * std::sqrt(edge_2);
          if (volume > 0 && !is_flat)
            continue;
          if (wrong.n_cells++ == 0)
            {
              wrong.first_cell   = c;
              wrong.first        = p;
              wrong.first_volume = is_flat ? 0 : volume;
            }
        }
      return wrong;
    }



    void
    check_finite(const std::vector<dealii::Point<3>> &points,
                 const std::string                   &what,
                 const std::string                   &origin)
    {
      for (const dealii::Point<3> &p : points)
        if (!std::isfinite(p.norm_square()))
          refuse_mesh(origin,
                      fmt::format("a {} has the coordinates {}; they must be "
                                  "finite numbers",
                                  what,
                                  position(p)));
    }



    // @p number gives the number of a cell in the mesh of all ranks.
    void
    check_volumes(const MeshCells                                  &mesh,
                  const std::function<std::uint64_t(unsigned int)> &number,
                  const std::string                                &origin,
                  const MPI_Comm                                    comm)
    {
      const WrongVolumes wrong  = find_wrong_volumes(mesh);
      namespace MPI             = dealii::Utilities::MPI;
      const std::size_t n_wrong = MPI::sum(wrong.n_cells, comm);
      if (n_wrong == 0)
        return;
      const std::size_t   n_cells      = MPI::sum(mesh.cells.size(), comm);
      const std::uint64_t first        = wrong.n_cells == 0 ?
                                           std::numeric_limits<std::uint64_t>::max() :
                                           number(wrong.first_cell);
      const std::uint64_t first_of_all = MPI::min(first, comm);
      on_all_ranks(comm, [&] {
        if (first > first_of_all)
          return;
        const auto &p = wrong.first;
        refuse_mesh(
          origin,
          fmt::format(
            "{} of {} cells {} no positive volume: found {} with the corners {}, "
            "{}, {}, {}; the last must see the others counter-clockwise",
            n_wrong,
            n_cells,
            n_wrong == 1 ? "has" : "have",
            wrong.first_volume == 0 ?
              "a flat one (zero volume)" :
              fmt::format("{:.6g} (inverted)", wrong.first_volume),
            position(p[0]),
            position(p[1]),
            position(p[2]),
            position(p[3])));
      });
    }
  } // namespace



  std::string
  position(const dealii::Point<3> &p)
  {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]);
  }



  void
  refuse_mesh(const std::string &origin, const std::string &message)
  {
    if (origin.empty())
      throw InputError("Mesh/Type", message);
    throw InputError("", origin + ": " + message);
  }



  dealii::Point<3>
  centre(const MeshCells &mesh, const Triangle &triangle)
  {
    dealii::Point<3> sum;
    for (const unsigned int v : triangle)
      sum += mesh.vertices[v];
    return sum / 3.;
  }



  std::string
  boundary_name(const SerialMesh &mesh, const unsigned int id)
  {
    const std::string name = MeshNames("boundary", mesh.boundaries).name(id);
    return name == std::to_string(id) ? name : "'" + name + "'";
  }



  double
  largest_number_of_cells(const unsigned int n_refinements)
  {
    return max_n_cells / std::pow(8., n_refinements);
  }



  void
  check_number_of_cells(const std::size_t  n_cells,
                        const unsigned int n_refinements)
  {
    const double n_refined = n_cells * std::pow(8., n_refinements);
    if (n_refined > max_n_cells)
      throw InputError("Mesh/Refinements",
                       fmt::format("too many cells: found {} refinements, "
                                   "which make {:.3g} cells of {}; at most "
                                   "{:.3g} are allowed",
                                   n_refinements,
                                   n_refined,
                                   n_cells,
                                   max_n_cells));
  }



  void
  check_vertices(const SerialMesh &mesh)
  {
    if (mesh.cells.empty())
      refuse_mesh(mesh.origin, "the mesh has no tetrahedra");
    check_finite(mesh.vertices, "vertex", mesh.origin);

    // @p what names the wrong part; it is called for errors only, as it is
    // slow.
    const auto check = [&](const auto &vertices, const auto &what) {
      for (const unsigned int v : vertices)
        if (v >= mesh.vertices.size())
          refuse_mesh(mesh.origin,
                      fmt::format("a {} has the vertex {}; there are only "
                                  "the vertices 0 to {}",
                                  what(),
                                  v,
                                  mesh.vertices.size() - 1));
    };
    // The highest of all numbers tells quickly whether one is wrong.
    unsigned int highest = 0;
    for (const SerialMesh::Cell &cell : mesh.cells)
      for (const unsigned int v : cell.vertices)
        highest = std::max(highest, v);
    if (highest >= mesh.vertices.size())
      for (const SerialMesh::Cell &cell : mesh.cells)
        check(cell.vertices, [] { return "cell"; });
    for (const SerialMesh::Face &face : mesh.faces)
      check(face.vertices, [&] {
        return "face of boundary " + boundary_name(mesh, face.boundary);
      });
    for (const SerialMesh::Edge &edge : mesh.edges)
      check(edge.vertices, [] { return "named edge"; });
    for (const SerialMesh::Corner &corner : mesh.corners)
      check(std::array<unsigned int, 1>{{corner.vertex}},
            [] { return "named corner"; });
    check_curves(mesh, mesh.origin);
  }



  void
  check_curves(const MeshCells &mesh, const std::string &origin)
  {
    check_finite(mesh.curved_nodes, "node of a curved cell", origin);
    if (mesh.geometry_degree < 1 || mesh.geometry_degree > 3)
      refuse_mesh(origin,
                  fmt::format("curved cells have the degree {}; allowed are "
                              "2 and 3",
                              mesh.geometry_degree));
    std::size_t n_curved = 0;
    for (const MeshCells::Cell &cell : mesh.cells)
      n_curved += cell.curve != MeshCells::straight;
    const std::size_t n_maps = mesh.curved_nodes.size() / mesh.n_map_nodes();
    if ((n_curved > 0 && mesh.geometry_degree == 1) || n_maps != n_curved ||
        mesh.curved_nodes.size() % mesh.n_map_nodes() != 0)
      refuse_mesh(origin,
                  fmt::format("{} curved cells of degree {} have {} nodes; "
                              "they need {} each",
                              n_curved,
                              mesh.geometry_degree,
                              mesh.curved_nodes.size(),
                              mesh.n_map_nodes()));
    std::vector<bool> is_used(n_maps);
    for (const MeshCells::Cell &cell : mesh.cells)
      {
        if (cell.curve == MeshCells::straight)
          continue;
        if (cell.curve >= n_maps || is_used[cell.curve])
          refuse_mesh(
            origin,
            fmt::format("a curved cell has the number {} among {}; each must "
                        "have one of its own, from 0 on",
                        cell.curve,
                        n_maps));
        is_used[cell.curve] = true;
        const auto   p      = cell_vertices(mesh, cell);
        const double edge   = std::sqrt(square_of_longest_edge(p));
        for (unsigned int v = 0; v < 4; ++v)
          if (!(curved_nodes(mesh, cell)[v].distance(p[v]) <=
                1e-10 * edge + 1e-14 * p[v].norm()))
            refuse_mesh(
              origin,
              fmt::format("a curved cell has the node {} for its vertex {}; "
                          "the first four nodes must be the vertices",
                          position(curved_nodes(mesh, cell)[v]),
                          position(p[v])));
      }
  }



  double
  check_cells_on_ranks(const MeshPart    &part,
                       const std::string &origin,
                       const unsigned int element_degree,
                       const MPI_Comm     comm)
  {
    check_volumes(
      part,
      [&](const unsigned int c) { return part.numbers[c]; },
      origin,
      comm);
    return check_curved_cells(part, origin, element_degree, comm);
  }



  void
  check_mesh(SerialMesh &mesh, const unsigned int element_degree)
  {
    const std::string &origin = mesh.origin;
    check_vertices(mesh);
    check_volumes(
      mesh, [](const unsigned int c) { return c; }, origin, MPI_COMM_SELF);
    check_curved_cells(mesh, origin, element_degree, MPI_COMM_SELF);
    if (element_degree > 1)
      check_common_nodes(mesh, origin);
    constexpr unsigned int none     = dealii::numbers::invalid_unsigned_int;
    const auto             is_owned = [](const unsigned int) { return true; };
    check_surface(cell_surface(mesh,
                               find_neighbors(mesh, none, origin, is_owned),
                               none,
                               is_owned,
                               [](const unsigned int v) { return v; }),
                  origin);
    check_names(mesh);
  }
} // namespace corotet
