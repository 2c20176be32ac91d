// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Selections on several ranks name the same parts of the same cells, with the
// same ids, as on one rank that has all cells; the numbers in the log are the
// same, too.

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // A box mesh bent to a helix of nearly one turn with a square cross section:
  // its four smooth sides reach all ranks, and the names of the box remain.
  SerialMesh
  helix()
  {
    SerialMesh mesh = box_of_2_by_half_by_1("24, 2, 3");
    for (dealii::Point<3> &x : mesh.vertices)
      {
        const double angle  = x[0] * 0.9 * std::numbers::pi;
        const double radius = 1 + x[2];
        x                   = dealii::Point<3>(radius * std::cos(angle),
                             x[1] + 0.2 * angle,
                             radius * std::sin(angle));
      }
    // Two names on lines are added: along an edge of the surface, and inside of
    // the body.
    std::set<std::array<unsigned int, 2>> along, inside;
    for (const SerialMesh::Cell &cell : mesh.cells)
      for (const auto &[i, j] : ends_of_edges)
        {
          const auto ends  = ascending_ends(cell.vertices[i], cell.vertices[j]);
          const auto is_at = [&](const double radius, const double height) {
            for (const unsigned int v : ends)
              {
                const dealii::Point<3> &x     = mesh.vertices[v];
                const double            angle = std::atan2(x[2], x[0]);
                const double            turn =
                  0.2 * (angle < -1e-6 ? angle + 2 * std::numbers::pi : angle);
                if (std::abs(std::hypot(x[0], x[2]) - radius) > 1e-6 ||
                    std::abs(x[1] - turn - height) > 1e-6)
                  return false;
              }
            return true;
          };
          if (is_at(2, 0.5))
            along.insert(ends);
          if (is_at(4. / 3, 0.25))
            inside.insert(ends);
        }
    for (const auto &ends : along)
      mesh.edges.push_back({ends, 0});
    for (const auto &ends : inside)
      mesh.edges.push_back({ends, 1});
    mesh.edge_names.names = {{0, "outer line"}, {1, "inner line"}};
    for (unsigned int v = 0; v < mesh.vertices.size(); v += 7)
      mesh.corners.push_back({v, 5});
    mesh.corner_names.names = {{5, "every seventh"}};
    return mesh;
  }

  // The named parts of a rank: numbers of cells, of parts of these, and ids.
  using Parts = std::vector<std::array<std::uint64_t, 3>>;
  struct Named
  {
    Parts                  regions, faces, edges, corners;
    std::vector<NamedSets> names;
    std::string            log;
  };

  // Parts of the cells that @p is_wanted is true of.
  template <typename IsWanted>
  Parts
  of_cells(const LocalMesh             &mesh,
           const std::vector<CellPart> &list,
           const IsWanted              &is_wanted)
  {
    Parts result;
    for (const auto &[c, number, id] : list)
      if (is_wanted(mesh.numbers[c]))
        result.push_back({{mesh.numbers[c], number, id}});
    std::sort(result.begin(), result.end());
    return result;
  }

  template <typename IsThere, typename IsOwned>
  Named
  named(const LocalMesh &mesh,
        const UsedNames &names,
        const IsThere   &is_there,
        const IsOwned   &is_owned)
  {
    std::vector<CellPart> regions;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      regions.push_back({c, 0, mesh.cells[c].region});
    return {of_cells(mesh, regions, is_there),
            of_cells(mesh, mesh.faces, is_there),
            of_cells(mesh, mesh.edges, is_owned),
            of_cells(mesh, mesh.corners, is_owned),
            {names.regions, names.boundaries, names.edges, names.corners},
            ""};
  }

  // The mesh on the ranks of @p comm with all selections, and the log.
  std::pair<LocalMesh, std::string>
  selected(const SelectionParameters &parameters,
           const MPI_Comm             comm,
           UsedNames                 &names)
  {
    const TemporaryFolder folder;
    const SerialMesh      whole = helix();
    LocalMesh             mesh  = distribute(whole, comm);
    names                       = UsedNames(whole);
    Log log(comm, true);
    log.open(folder / "log.txt");
    select(mesh, names, parameters, log);
    log.size();
    std::ifstream file(folder / "log.txt");
    return {std::move(mesh),
            std::string(std::istreambuf_iterator<char>(file), {})};
  }

  void
  expect_same(const SelectionParameters &parameters)
  {
    UsedNames names, names_alone;
    const auto [mesh, log] = selected(parameters, MPI_COMM_WORLD, names);
    const auto [alone, log_alone] =
      selected(parameters, MPI_COMM_SELF, names_alone);
    std::set<std::uint64_t> local(mesh.numbers.begin(), mesh.numbers.end());
    std::set<std::uint64_t> owned;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.is_owned(c))
        owned.insert(mesh.numbers[c]);
    const auto is_there = [&](const std::uint64_t n) {
      return local.contains(n);
    };
    const auto is_owned = [&](const std::uint64_t n) {
      return owned.contains(n);
    };
    const Named found    = named(mesh, names, is_there, is_owned);
    const Named expected = named(alone, names_alone, is_there, is_owned);
    EXPECT_EQ(found.regions, expected.regions);
    EXPECT_EQ(found.faces, expected.faces);
    EXPECT_EQ(found.edges, expected.edges);
    EXPECT_EQ(found.corners, expected.corners);
    for (unsigned int i = 0; i < 4; ++i)
      {
        EXPECT_EQ(found.names[i].names, expected.names[i].names);
        EXPECT_EQ(found.names[i].sets, expected.names[i].sets);
      }
    if (mesh.rank == 0)
      {
        EXPECT_EQ(log, log_alone);
        EXPECT_NE(log.find("selection '"), std::string::npos) << log;
      }
  }

  SelectionParameters
  of_boundaries(const std::string &text)
  {
    SelectionParameters parameters;
    parameters.boundaries = text;
    return parameters;
  }

  std::string
  refused(const SelectionParameters &parameters, const MPI_Comm comm)
  {
    UsedNames names;
    return refusal([&] { selected(parameters, comm, names); });
  }
} // namespace

TEST(SelectionsOnRanks, Boundaries)
{
  expect_same(of_boundaries(
    "a: sphere 0 0 1.5 1, b: patch 0 0.6 2, c: a and not b, outside: patch 3 0 "
    "0 30, d: not (outside or x-min), e: normal 0 -1 0 60, all: not box 9 9 9 "
    "10 10 10, f: all and plane 0 0 0 1 0 0 or cylinder -2 0 0 2 0 0 0.9"));
}

// The patch of each side is all of that side, whichever rank has its point.
TEST(SelectionsOnRanks, PatchesGoPastRanks)
{
  // There are two triangles on each of 24 x 2 quadrilaterals outside and
  // inside, and of 24 x 3 above and below.
  for (const auto &[point, n_faces] :
       std::vector<std::pair<std::string, unsigned int>>{{"0 0.56 2.5", 96},
                                                         {"0 0.56 0.9", 96},
                                                         {"-1.5 1.5 0", 144},
                                                         {"0 0 -1.5", 144}})
    {
      const SelectionParameters parameters =
        of_boundaries("side: patch " + point + " 25");
      expect_same(parameters);
      UsedNames    names;
      const auto   mesh = selected(parameters, MPI_COMM_WORLD, names).first;
      const auto   ids  = names.boundaries.ids("side");
      unsigned int n    = 0;
      for (const auto &[c, f, id] : mesh.faces)
        n += mesh.is_owned(c) && std::count(ids.begin(), ids.end(), id) > 0 ?
               1 :
               0;
      EXPECT_EQ(dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD), n_faces);
    }
}

TEST(SelectionsOnRanks, Regions)
{
  SelectionParameters parameters;
  parameters.regions =
    "half: box -3 -3 -3 0 3 3, other half: not half, ball: sphere 0 0 1.5 0.7, "
    "rest: other half and not ball, everything: body or half";
  expect_same(parameters);
}

TEST(SelectionsOnRanks, EdgesAndCorners)
{
  SelectionParameters parameters;
  parameters.boundaries = "top: patch 0 0.9 1.5";
  parameters.edges =
    "rim: top and sharp, ring: patch 2 0.3 0 30 and top, cut: plane 0 0 0 1 0 "
    "0, old: outer line, both: cut or old, none of them: not (cut or old) and "
    "z-max, flat: normal 0 1 0 30";
  parameters.corners =
    "on line: inner line or outer line, ends: rim and x-min, few: every "
    "seventh and z-max, more: few or sphere 0 0.6 1.5 0.4, within: not (top or "
    "x-min or x-max or y-min or y-max or z-min or z-max), up: normal 0 1 0 40";
  expect_same(parameters);
}

// Messages are the same as on one rank: the nearest face or vertex that they
// name is the nearest one of all ranks.
TEST(SelectionsOnRanks, Refusals)
{
  SelectionParameters edges, corners, regions;
  edges.edges     = "a: plane 0 0.031 0 0 1 0 and x-min";
  corners.corners = "a: sphere 0 9 1.5 0.1";
  regions.regions = "a: sphere 0 0 0 0.5";
  for (const SelectionParameters &parameters :
       {of_boundaries("a: sphere 5 0 0 1 and normal 1 1 1 0.01"),
        of_boundaries("a: x-min and x-max"),
        of_boundaries("a: y-mx"),
        of_boundaries("a: (sphere 0 0 0 1"),
        edges,
        corners,
        regions})
    {
      const std::string found = refused(parameters, MPI_COMM_WORLD);
      EXPECT_EQ(found, refused(parameters, MPI_COMM_SELF));
      EXPECT_EQ(found.find("Selections/"), 0u) << found;
    }
}
