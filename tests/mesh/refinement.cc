// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Uniform refinement: the cells are those of deal.II, in the same order, and on
// all ranks together the same as on one rank.

#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/local_mesh.h>
#include <corotet/mesh/refinement.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "mesh/dealii_mesh.h"
#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // A box whose vertices are moved at random, so that each of the three
  // diagonals is the shortest somewhere.
  SerialMesh
  shaken_box()
  {
    SerialMesh   mesh = box_of_2_by_half_by_1("4, 2, 2");
    std::mt19937 random(1);
    std::uniform_real_distribution<double> shift(-0.05, 0.05);
    for (dealii::Point<3> &x : mesh.vertices)
      for (unsigned int d = 0; d < 3; ++d)
        x[d] += shift(random);
    return mesh;
  }

  std::array<std::array<double, 3>, 4>
  places(const MeshCells &mesh, const MeshCells::Cell &cell)
  {
    std::array<std::array<double, 3>, 4> result;
    for (unsigned int k = 0; k < 4; ++k)
      for (unsigned int d = 0; d < 3; ++d)
        result[k][d] = mesh.vertices[cell.vertices[k]][d];
    return result;
  }

  using NamedFaces =
    std::multiset<std::pair<std::set<std::array<double, 3>>, unsigned int>>;

  NamedFaces
  named_faces_of(const SerialMesh &mesh)
  {
    NamedFaces faces;
    for (const SerialMesh::Face &face : mesh.faces)
      {
        std::set<std::array<double, 3>> corners;
        for (const unsigned int v : face.vertices)
          corners.insert(std::array<double, 3>{
            {mesh.vertices[v][0], mesh.vertices[v][1], mesh.vertices[v][2]}});
        faces.emplace(corners, face.boundary);
      }
    return faces;
  }
} // namespace

TEST(Refinement, IsDealIIs)
{
  SerialMesh mesh = shaken_box();
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    mesh.cells[c].region = c % 3;
  dealii::Triangulation<3> tria;
  make_triangulation(mesh, tria);
  tria.refine_global(2);
  const SerialMesh expected = make_serial_mesh(tria);
  refine_uniformly(mesh, 2);
  ASSERT_EQ(mesh.cells.size(), expected.cells.size());
  EXPECT_EQ(mesh.vertices.size(), expected.vertices.size());
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    {
      // Both compute the middles of edges by the same sums, so they are equal.
      EXPECT_EQ(places(mesh, mesh.cells[c]),
                places(expected, expected.cells[c]))
        << c;
      EXPECT_EQ(mesh.cells[c].region, expected.cells[c].region);
    }
  EXPECT_EQ(named_faces_of(mesh), named_faces_of(expected));
}

// Boxes have cells with diagonals of equal lengths, between which round-off
// must not choose: in other units and at another place they are cut alike.
TEST(Refinement, OfBoxesAlikeInAllUnits)
{
  const auto cells_of = [](const std::string &size, const std::string &origin) {
    BoxMesh                  source;
    dealii::ParameterHandler prm;
    source.declare_parameters(prm);
    prm.set("Size", size);
    prm.set("Cells", "4, 2, 1");
    prm.set("Origin", origin);
    SerialMesh mesh = source.create("");
    refine_uniformly(mesh, 2);
    std::vector<unsigned int> vertices;
    for (const MeshCells::Cell &cell : mesh.cells)
      vertices.insert(vertices.end(),
                      cell.vertices.begin(),
                      cell.vertices.end());
    return vertices;
  };
  const std::string               size = "0.8, 0.4, 0.3", origin = "0, 0, 0";
  const std::vector<unsigned int> expected = cells_of(size, origin);
  EXPECT_EQ(cells_of("800, 400, 300", origin), expected);
  EXPECT_EQ(cells_of("0.8, 0.4000000000001, 0.3", origin), expected);
  EXPECT_EQ(cells_of(size, "3, 0, 0"), expected);
  EXPECT_EQ(cells_of(size, "0, -2, 0"), expected);
}

// Each rank refines its own cells: together they have those of the whole mesh,
// and know the vertices that they share by the same numbers, which no other
// vertices have.
TEST(Refinement, OnRanks)
{
  const MPI_Comm comm  = MPI_COMM_WORLD;
  SerialMesh     whole = shaken_box();
  MeshPart       part  = owned_part(distribute(whole, comm));
  refine_uniformly(part, 2, comm);
  // On one rank, the cells have the same order.
  MeshPart one = owned_part(distribute(whole, MPI_COMM_SELF));
  refine_uniformly(one, 2, MPI_COMM_SELF);
  const std::size_t n = one.cells.size();

  std::vector<double> sums(n, 0);
  for (unsigned int c = 0; c < part.cells.size(); ++c)
    {
      const std::uint64_t number = part.numbers[c];
      ASSERT_LT(number, n);
      ++sums[number];
      EXPECT_EQ(places(part, part.cells[c]), places(one, one.cells[number]));
    }
  dealii::Utilities::MPI::sum(sums, comm, sums);
  EXPECT_EQ(sums, std::vector<double>(n, 1));

  using Known = std::map<std::uint64_t, std::array<double, 3>>;
  Known known;
  for (unsigned int v = 0; v < part.vertices.size(); ++v)
    known[part.vertex_numbers[v]] = {
      {part.vertices[v][0], part.vertices[v][1], part.vertices[v][2]}};
  EXPECT_EQ(known.size(), part.vertices.size());
  Known                           all;
  std::set<std::array<double, 3>> all_places;
  for (const Known &of_rank : dealii::Utilities::MPI::all_gather(comm, known))
    for (const auto &[number, place] : of_rank)
      {
        EXPECT_EQ(all.emplace(number, place).first->second, place);
        all_places.insert(place);
      }
  EXPECT_EQ(all.size(), one.vertices.size());
  EXPECT_EQ(all_places.size(), one.vertices.size());
}

// A new vertex on a curved edge lies on the curve, at the same position on all
// ranks to the last digit, though only every second cell is curved, and each in
// its own way (so that the mesh has gaps before).
TEST(Refinement, RanksAgreeOnCurves)
{
  SerialMesh whole      = box_of_2_by_half_by_1("3, 2, 2");
  whole.geometry_degree = 2;
  for (unsigned int c = 0; c < whole.cells.size(); c += 2)
    {
      whole.cells[c].curve = c / 2;
      const auto corners   = cell_vertices(whole, whole.cells[c]);
      for (const dealii::Point<3> &xi : map_points(2))
        {
          dealii::Point<3> x = corners[0];
          for (unsigned int k = 0; k < 3; ++k)
            x += xi[k] * (corners[k + 1] - corners[0]);
          // The middles of edges are moved.
          if (std::abs(
                xi.norm_square() +
                dealii::Utilities::fixed_power<2>(1 - xi[0] - xi[1] - xi[2]) -
                0.5) < 0.1)
            x[2] += 0.001 * (1 + c % 7);
          whole.curved_nodes.push_back(x);
        }
    }
  using Places = std::map<std::uint64_t, std::array<double, 3>>;
  // Positions of the vertices of all cells; checks that those of curved cells
  // are nodes of their maps.
  const auto places_on = [&](const MPI_Comm ranks) {
    MeshPart part = owned_part(distribute(whole, ranks));
    refine_uniformly(part, 1, ranks);
    Places own;
    for (unsigned int c = 0; c < part.cells.size(); ++c)
      for (unsigned int k = 0; k < 4; ++k)
        {
          const MeshCells::Cell  &cell = part.cells[c];
          const dealii::Point<3> &x    = part.vertices[cell.vertices[k]];
          own[4 * part.numbers[c] + k] = {{x[0], x[1], x[2]}};
          if (cell.curve != MeshCells::straight)
            {
              EXPECT_EQ(curved_nodes(part, cell)[k], x);
            }
        }
    Places all;
    for (const Places &of_rank : dealii::Utilities::MPI::all_gather(ranks, own))
      all.insert(of_rank.begin(), of_rank.end());
    return all;
  };
  const Places expected = places_on(MPI_COMM_SELF);
  EXPECT_EQ(expected.size(), 4 * 8 * whole.cells.size());
  EXPECT_EQ(places_on(MPI_COMM_WORLD), expected);
}
