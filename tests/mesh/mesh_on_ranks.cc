// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// All ranks together find the same faults of a mesh as one rank that has all of
// it, and report them in the same words; where cells do not fit together at
// several places, they may name another of these.

#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/mesh.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // The message about a mesh that only rank 0 has.
  std::string
  refusal_on_ranks(const SerialMesh &mesh, const unsigned int n_refinements = 0)
  {
    const bool is_root =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    return refusal([&] {
      Log  log(MPI_COMM_WORLD, true);
      Mesh on_ranks(
        is_root ? mesh : SerialMesh(), n_refinements, 1., MPI_COMM_WORLD, log);
    });
  }

  std::string
  refusal_of_whole(SerialMesh mesh)
  {
    return refusal([&] { check_mesh(mesh); });
  }

  SerialMesh
  box(const std::string &cells)
  {
    SerialMesh mesh = box_of_2_by_half_by_1(cells);
    mesh.origin     = "x.msh";
    return mesh;
  }

  // One mesh with the cells of both, without names; the second body is moved.
  SerialMesh
  two_bodies(const SerialMesh           &first,
             const SerialMesh           &second,
             const dealii::Tensor<1, 3> &shift)
  {
    SerialMesh         mesh = first;
    const unsigned int n    = mesh.vertices.size();
    mesh.faces.clear();
    for (const dealii::Point<3> &x : second.vertices)
      mesh.vertices.push_back(x + shift);
    for (SerialMesh::Cell cell : second.cells)
      {
        for (unsigned int &v : cell.vertices)
          v += n;
        mesh.cells.push_back(cell);
      }
    return mesh;
  }

  void
  expect_same_refusal(const SerialMesh &mesh, const std::string &words)
  {
    const std::string found = refusal_on_ranks(mesh);
    EXPECT_NE(found.find(words), std::string::npos) << found;
    EXPECT_EQ(found, refusal_of_whole(mesh));
    // The mesh is checked before it is refined, so the message is the same.
    EXPECT_EQ(found, refusal_on_ranks(mesh, 1));
  }
} // namespace

TEST(MeshOnRanks, GoodMesh)
{
  EXPECT_EQ(refusal_on_ranks(box("6, 2, 3")), "nothing was refused");
  // Two bodies that do not touch are allowed.
  EXPECT_EQ(refusal_on_ranks(two_bodies(box("2, 1, 1"),
                                        box("2, 1, 1"),
                                        dealii::Point<3>(2.1, 0, 0))),
            "nothing was refused");
}

TEST(MeshOnRanks, InvertedCells)
{
  SerialMesh mesh = box("6, 2, 3");
  for (const std::size_t c : {mesh.cells.size() / 3, mesh.cells.size() - 1})
    std::swap(mesh.cells[c].vertices[0], mesh.cells[c].vertices[1]);
  expect_same_refusal(mesh, "2 of 180 cells have no positive volume");
}

TEST(MeshOnRanks, CellTwice)
{
  SerialMesh mesh = box("6, 2, 3");
  // The cell that is repeated has neighbours on all sides; the copy is far
  // behind it in the list.
  mesh.cells.push_back(mesh.cells[4]);
  const std::string found = refusal_on_ranks(mesh);
  EXPECT_NE(found.find("cells overlap: the triangle with the centre"),
            std::string::npos)
    << found;
}

// Two bodies touch with nodes of their own; if each rank has one body, no rank
// sees both among its own cells.
TEST(MeshOnRanks, DuplicateNodes)
{
  const SerialMesh mesh =
    two_bodies(box("4, 2, 2"), box("4, 2, 2"), dealii::Point<3>(2, 0, 0));
  const std::string found = refusal_on_ranks(mesh);
  EXPECT_NE(found.find("duplicate nodes: two vertices are at (2, "),
            std::string::npos)
    << found;
}

TEST(MeshOnRanks, HangingNodes)
{
  const std::string found = refusal_on_ranks(
    two_bodies(box("2, 1, 1"), box("4, 2, 2"), dealii::Point<3>(2, 0, 0)));
  EXPECT_TRUE(found.find("hanging node: the vertex at (2, ") !=
                std::string::npos ||
              found.find("duplicate nodes: two vertices are at (2, ") !=
                std::string::npos)
    << found;
}

TEST(MeshOnRanks, FaceOfNoCell)
{
  SerialMesh mesh           = box("2, 1, 1");
  mesh.faces[0].vertices[0] = mesh.cells.back().vertices[3];
  expect_same_refusal(mesh, "which is no face of a cell");
}

TEST(MeshOnRanks, FoldedCell)
{
  SerialMesh mesh      = box("2, 1, 1");
  mesh.geometry_degree = 2;
  // The middle of an edge is moved beyond the end of that edge.
  for (const unsigned int c : {1u, 7u})
    {
      mesh.cells[c].curve = mesh.curved_nodes.size() / 10;
      const auto corners  = cell_vertices(mesh, mesh.cells[c]);
      for (const dealii::Point<3> &xi : map_points(2))
        {
          dealii::Point<3> x = corners[0];
          for (unsigned int k = 0; k < 3; ++k)
            x += xi[k] * (corners[k + 1] - corners[0]);
          if (xi[0] == 0.5 && xi[1] == 0 && xi[2] == 0)
            x += (0.5 + 0.1 * c) * (corners[1] - corners[0]);
          mesh.curved_nodes.push_back(x);
        }
    }
  expect_same_refusal(mesh, "2 of 2 curved cells are folded");
}
