// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Cells as PT-Scotch distributes them, compared with the pieces of the curve.

#include <corotet/mesh/cell_order.h>
#include <corotet/mesh/distributed_triangulation.h>
#include <corotet/mesh/graph_partition.h>
#include <corotet/mesh/mesh_part.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  const unsigned int curved_from = 100;

  // A box distributed in pieces of the space-filling curve; with @p is_curved
  // the first cells are curved.
  LocalMesh
  along_curve(const std::string &cells, const bool is_curved = false)
  {
    SerialMesh mesh = box_of_2_by_half_by_1(cells);
    if (is_curved)
      {
        mesh.geometry_degree = 2;
        for (SerialMesh::Cell &cell : mesh.cells)
          {
            if (mesh.curved_nodes.size() == 10 * curved_from)
              break;
            cell.curve = mesh.curved_nodes.size() / 10;
            mesh.curved_nodes.resize(10 * (cell.curve + 1));
          }
      }
    return distribute(mesh, MPI_COMM_WORLD);
  }

  LocalMesh
  by_graph(const LocalMesh &mesh)
  {
    return with_cells_beside(partition_graph(mesh), "box", MPI_COMM_WORLD);
  }

  unsigned int
  n_ranks()
  {
    return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  }

  // The vertices of each cell that this rank owns, by the number of the cell.
  std::map<std::uint64_t, std::array<dealii::Point<3>, 4>>
  owned_cells(const LocalMesh &mesh)
  {
    std::map<std::uint64_t, std::array<dealii::Point<3>, 4>> cells;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.is_owned(c))
        for (unsigned int k = 0; k < 4; ++k)
          cells[mesh.numbers[c]][k] = mesh.vertices[mesh.cells[c].vertices[k]];
    return cells;
  }

  // Sums of numbers and positions over the cells of all ranks; they tell
  // whether each cell is there once.
  std::vector<double>
  sums_over_cells(const LocalMesh &mesh)
  {
    std::vector<double> sums(5, 0.);
    for (const auto &[number, corners] : owned_cells(mesh))
      for (const dealii::Point<3> &x : corners)
        {
          sums[0] += 1;
          sums[1] += number;
          for (unsigned int d = 0; d < 3; ++d)
            sums[2 + d] += (1. + number) * x[d];
        }
    dealii::Utilities::MPI::sum(sums, MPI_COMM_WORLD, sums);
    return sums;
  }

  class GraphPartition : public testing::Test
  {
    void
    SetUp() override
    {
      if (partitioners().size() == 1)
        GTEST_SKIP() << "built without PT-Scotch";
    }
  };
} // namespace

// Cells get another owner, but keep their numbers and vertices.
TEST_F(GraphPartition, KeepsCells)
{
  const LocalMesh before = along_curve("9, 3, 5");
  const LocalMesh mesh   = by_graph(before);
  EXPECT_EQ(mesh.n_global_cells, before.n_global_cells);
  EXPECT_TRUE(std::is_sorted(mesh.numbers.begin(), mesh.numbers.end()));
  const std::vector<double> found    = sums_over_cells(mesh);
  const std::vector<double> expected = sums_over_cells(before);
  // The tolerance is the round-off of sums in another order.
  for (unsigned int i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-12 * expected[i]);
}

// The ghost cells, and the neighbours behind faces, are those that deal.II
// finds; boundaries remain.
TEST_F(GraphPartition, AgreesWithDealII)
{
  const LocalMesh                mesh = by_graph(along_curve("5, 4, 3"));
  const DistributedTriangulation tria(mesh);
  ASSERT_EQ(tria.n_active_cells(), mesh.cells.size());
  unsigned int n_on_surface = 0;
  for (const auto &cell : tria.active_cell_iterators())
    {
      const unsigned int c = cell->active_cell_index();
      EXPECT_EQ(cell->id().get_coarse_cell_id(), mesh.numbers[c]);
      EXPECT_EQ(cell->subdomain_id(), mesh.owners[c]);
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          n_on_surface += mesh.is_owned(c) ? 1 : 0;
        else
          EXPECT_EQ(mesh.neighbors[c][f],
                    cell->neighbor(f)->active_cell_index());
    }
  const unsigned int n_named =
    std::count_if(mesh.faces.begin(), mesh.faces.end(), [&](const auto &face) {
      return mesh.is_owned(face.cell);
    });
  // The numbers of faces over all ranks.
  for (const unsigned int n : {n_on_surface, n_named})
    EXPECT_EQ(dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD),
              4u * (5 * 4 + 5 * 3 + 4 * 3));
}

// A rank's work exceeds the mean by at most one percent and the work of one
// curved cell.
TEST_F(GraphPartition, EqualWork)
{
  const LocalMesh mesh = by_graph(along_curve("8, 4, 4", true));
  double          work = 0;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    if (mesh.is_owned(c))
      work += work_of(mesh.cells[c]);
  const double all = dealii::Utilities::MPI::sum(work, MPI_COMM_WORLD);
  EXPECT_EQ(all, mesh.n_global_cells + curved_from);
  EXPECT_LE(work, 1.01 * all / n_ranks() + 2);
}

// The best partition of a long bar has plane cuts across it, with two faces for
// each square. On two ranks the cut of the curve is as good, as its pieces end
// at the middle; on three ranks it is worse.
TEST_F(GraphPartition, FewFacesBetweenRanks)
{
  const LocalMesh     before = along_curve("24, 3, 3");
  const LocalMesh     mesh   = by_graph(before);
  const std::uint64_t least  = 2 * 9 * (n_ranks() - 1);
  EXPECT_GE(n_faces_between_ranks(before), least);
  EXPECT_LE(n_faces_between_ranks(mesh), 1.25 * least);
  EXPECT_LE(n_faces_between_ranks(mesh), n_faces_between_ranks(before));
}

// Each call gives the same partition.
TEST_F(GraphPartition, Repeats)
{
  const LocalMesh before = along_curve("7, 5, 4");
  EXPECT_EQ(partition_graph(before).numbers, partition_graph(before).numbers);
}

// Each rank has a cell.
TEST_F(GraphPartition, AsManyCellsAsRanks)
{
  SerialMesh mesh = box_of_2_by_half_by_1("4, 1, 1");
  mesh.faces.clear();
  mesh.cells.resize(n_ranks());
  const LocalMesh few = by_graph(distribute(mesh, MPI_COMM_WORLD));
  EXPECT_EQ(owned_cells(few).size(), 1);
}
