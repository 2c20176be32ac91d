// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The part of a mesh that each rank has, compared with the whole mesh, which
// every rank has in these tests, and with deal.II's triangulation.

#include <corotet/mesh/cell_order.h>
#include <corotet/mesh/distributed_triangulation.h>
#include <corotet/mesh/ghost_cells.h>
#include <corotet/mesh/mesh_part.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // A box with its cells in the order that they have in a run.
  SerialMesh
  sorted_box(const std::string &cells)
  {
    SerialMesh      mesh           = box_of_2_by_half_by_1(cells);
    const LocalMesh whole          = distribute(mesh, MPI_COMM_SELF);
    static_cast<MeshCells &>(mesh) = static_cast<const MeshCells &>(whole);
    mesh.faces.clear();
    for (const auto &[c, f, id] : whole.faces)
      {
        const auto &v        = whole.cells[c].vertices;
        const auto [i, j, k] = corners_of_faces[f];
        mesh.faces.push_back({{{v[i], v[j], v[k]}}, id});
      }
    return mesh;
  }
} // namespace

// Each cell has one owner, and owners are in the order of the cells. Apart from
// its own cells, a rank has exactly the cells that share a vertex with these.
// All data of a cell are those of the whole mesh.
TEST(LocalMesh, CellsOfTheMesh)
{
  const SerialMesh   whole = sorted_box("4, 3, 3");
  const unsigned int n_ranks =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const LocalMesh mesh = distribute(whole, MPI_COMM_WORLD);
  EXPECT_EQ(mesh.n_global_cells, whole.cells.size());
  EXPECT_TRUE(std::is_sorted(mesh.numbers.begin(), mesh.numbers.end()));

  std::vector<unsigned int> n_owners(whole.cells.size(), 0);
  std::set<unsigned int>    own_vertices, expected;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    if (mesh.is_owned(c))
      {
        ++n_owners[mesh.numbers[c]];
        const auto &vertices = whole.cells[mesh.numbers[c]].vertices;
        own_vertices.insert(vertices.begin(), vertices.end());
      }
  const unsigned int n_own = std::count(n_owners.begin(), n_owners.end(), 1u);
  EXPECT_NEAR(n_own, double(whole.cells.size()) / n_ranks, 1);
  dealii::Utilities::MPI::sum(n_owners, MPI_COMM_WORLD, n_owners);
  EXPECT_EQ(std::count(n_owners.begin(), n_owners.end(), 1u),
            std::ptrdiff_t(whole.cells.size()));
  EXPECT_TRUE(std::is_sorted(mesh.owners.begin(), mesh.owners.end()));

  for (unsigned int c = 0; c < whole.cells.size(); ++c)
    for (const unsigned int v : whole.cells[c].vertices)
      if (own_vertices.contains(v))
        expected.insert(c);
  EXPECT_TRUE(std::equal(mesh.numbers.begin(),
                         mesh.numbers.end(),
                         expected.begin(),
                         expected.end()));
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    {
      const SerialMesh::Cell &cell = whole.cells[mesh.numbers[c]];
      EXPECT_EQ(mesh.cells[c].region, cell.region);
      for (unsigned int v = 0; v < 4; ++v)
        EXPECT_EQ(mesh.vertices[mesh.cells[c].vertices[v]],
                  whole.vertices[cell.vertices[v]]);
    }
}

// Only rank 0 has the mesh, and the other ranks get their parts from it.
TEST(LocalMesh, ComesFromRankZero)
{
  const SerialMesh whole = sorted_box("3, 2, 2");
  const bool       is_root =
    dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  const LocalMesh expected = distribute(whole, MPI_COMM_WORLD);
  const LocalMesh mesh =
    distribute(is_root ? whole : SerialMesh(), MPI_COMM_WORLD);
  EXPECT_EQ(mesh.n_global_cells, whole.cells.size());
  EXPECT_EQ(mesh.vertices, expected.vertices);
  EXPECT_EQ(mesh.numbers, expected.numbers);
  EXPECT_EQ(mesh.owners, expected.owners);
  EXPECT_EQ(mesh.neighbors, expected.neighbors);
  ASSERT_EQ(mesh.faces.size(), expected.faces.size());
  for (unsigned int i = 0; i < mesh.faces.size(); ++i)
    EXPECT_EQ(mesh.faces[i].id, expected.faces[i].id);
}

// The piece that rank 0 sends to a rank contains nearly all cells that the rank
// will own, so few cells are sent again.
TEST(LocalMesh, PiecesOfTheCurve)
{
  const SerialMesh   whole = sorted_box("24, 12, 16");
  const unsigned int n_ranks =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const LocalMesh mesh = distribute(whole, MPI_COMM_WORLD);
  SerialMesh      copy = whole;
  const auto pieces = pieces_of_curve(whole_part(copy, NamedParts()), n_ranks);
  ASSERT_EQ(pieces.size(), n_ranks);
  std::vector<unsigned int> n_pieces(whole.cells.size(), 0);
  for (const auto &piece : pieces)
    {
      EXPECT_TRUE(std::is_sorted(piece.begin(), piece.end()));
      for (const unsigned int c : piece)
        ++n_pieces[c];
    }
  EXPECT_EQ(n_pieces, std::vector<unsigned int>(whole.cells.size(), 1));

  // Cells are numbered along the curve.
  unsigned int n_own = 0, n_sent_again = 0;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    if (mesh.is_owned(c))
      {
        const auto &piece = pieces[mesh.rank];
        ++n_own;
        n_sent_again +=
          std::binary_search(piece.begin(), piece.end(), mesh.numbers[c]) ? 0 :
                                                                            1;
      }
  // About half a layer of cuboids, with six cells each, around a piece is sent
  // again; its surface is half as large again as that of a cube.
  EXPECT_LT(n_sent_again, 1.5 * 6 * 6 / 2 * std::pow(n_own / 6., 2. / 3));
}

// Neighbours, owners, numbers and boundaries are those that deal.II finds
// itself, or is given.
TEST(LocalMesh, AgreesWithDealII)
{
  const LocalMesh mesh = distribute(sorted_box("4, 3, 2"), MPI_COMM_WORLD);
  const DistributedTriangulation tria(mesh);
  ASSERT_EQ(tria.n_active_cells(), mesh.cells.size());
  EXPECT_EQ(tria.n_global_active_cells(), mesh.n_global_cells);
  std::vector<std::array<unsigned int, 4>> boundaries(
    mesh.cells.size(),
    {{unnamed_boundary, unnamed_boundary, unnamed_boundary, unnamed_boundary}});
  for (const auto &[cell, face, boundary] : mesh.faces)
    boundaries[cell][face] = boundary;
  unsigned int n_on_surface = 0;
  for (const auto &cell : tria.active_cell_iterators())
    {
      const unsigned int c = cell->active_cell_index();
      EXPECT_EQ(cell->subdomain_id(), mesh.owners[c]);
      EXPECT_EQ(cell->id().get_coarse_cell_id(), mesh.numbers[c]);
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          {
            EXPECT_EQ(mesh.neighbors[c][f], LocalMesh::no_cell);
            EXPECT_EQ(cell->face(f)->boundary_id(), boundaries[c][f]);
            n_on_surface += mesh.is_owned(c) ? 1 : 0;
          }
        else
          EXPECT_EQ(mesh.neighbors[c][f],
                    cell->neighbor(f)->active_cell_index());
    }
  EXPECT_EQ(dealii::Utilities::MPI::sum(n_on_surface, MPI_COMM_WORLD),
            4u * (4 * 3 + 4 * 2 + 3 * 2));
}

// Ghost cells get the values of their owners, whatever they had before; owned
// cells keep their values.
TEST(LocalMesh, GhostsAreUpdated)
{
  const LocalMesh mesh = distribute(sorted_box("4, 2, 3"), MPI_COMM_WORLD);
  std::vector<std::uint64_t> values;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    for (unsigned int i = 0; i < 3; ++i)
      values.push_back(mesh.is_owned(c) ? 10 * mesh.numbers[c] + i : 7);
  GhostCells(mesh).update(values, 3);
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_EQ(values[3 * c + i], 10 * mesh.numbers[c] + i);
}

// A curved cell counts as two. The cells of the first half of the box are
// curved, so the first of two ranks has a third of all cells. Each rank has a
// cell, though the work of one cell may exceed a rank's share.
TEST(LocalMesh, EqualWork)
{
  const unsigned int n_ranks =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const unsigned int rank =
    dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  SerialMesh        mesh    = sorted_box("4, 3, 3");
  const std::size_t n_cells = mesh.cells.size();
  mesh.geometry_degree      = 2;
  mesh.curved_nodes.resize(10 * (n_cells / 2));
  for (unsigned int c = 0; c < n_cells / 2; ++c)
    {
      mesh.cells[c].curve           = c;
      mesh.curved_nodes[10 * c + 9] = dealii::Point<3>(c, 0, 0);
    }
  const LocalMesh local = distribute(mesh, MPI_COMM_WORLD);
  unsigned int    work = 0, n_curved = 0;
  for (unsigned int c = 0; c < local.cells.size(); ++c)
    {
      const unsigned int curve = local.cells[c].curve;
      EXPECT_EQ(curve == SerialMesh::straight, local.numbers[c] >= n_cells / 2);
      if (local.is_owned(c))
        work += curve == SerialMesh::straight ? 1 : 2;
      if (curve == SerialMesh::straight)
        continue;
      EXPECT_EQ(curve, n_curved++);
      EXPECT_EQ(local.curved_nodes[10 * curve + 9][0], local.numbers[c]);
    }
  EXPECT_NEAR(work, 1.5 * n_cells / n_ranks, 2);

  mesh.cells.resize(n_ranks);
  const LocalMesh few = distribute(mesh, MPI_COMM_WORLD);
  for (unsigned int c = 0; c < few.cells.size(); ++c)
    EXPECT_EQ(few.is_owned(c), few.numbers[c] == rank);
}
