// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Numbering and geometry of the discretization, against deal.II's own tools.

#include <deal.II/dofs/dof_tools.h>

#include <gtest/gtest.h>

#include "../body.h"

using namespace corotet;
using namespace corotet::tests;

class DiscretizationTest : public testing::TestWithParam<Element>
{
protected:
  DiscretizationTest()
    : log(MPI_COMM_WORLD, true)
    , mesh(box("2, 1, 1", "4, 2, 3", 0.2), 0, 1., MPI_COMM_WORLD, log)
    , discretization(mesh, GetParam())
  {}

  Log            log;
  Mesh           mesh;
  Discretization discretization;
};

// The unknowns of node n are 3n, 3n+1, 3n+2 in deal.II's numbering too, and
// lie where deal.II has their support points.
TEST_P(DiscretizationTest, NumberingIsDealIIs)
{
  const auto points =
    dealii::DoFTools::map_dofs_to_support_points(discretization.mapping(),
                                                 discretization.dof_handler());
  const auto &fe = discretization.finite_element();
  std::vector<dealii::types::global_dof_index> dofs(fe.dofs_per_cell);
  // Cells have another order than deal.II's: they are found by their vertices.
  std::map<std::array<dealii::types::global_dof_index, 4>, unsigned int> cells;
  const auto key = [&](const auto &first_unknown) {
    return std::array<dealii::types::global_dof_index, 4>{
      {first_unknown(0), first_unknown(1), first_unknown(2), first_unknown(3)}};
  };
  for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
    cells[key([&](const unsigned int v) {
      return 3 * discretization.global_node(discretization.cell_nodes(c)[v]);
    })] = c;
  EXPECT_EQ(cells.size(), discretization.n_owned_cells());
  unsigned int n_found = 0;
  for (const auto &c : discretization.dof_handler().active_cell_iterators())
    if (c->is_locally_owned())
      {
        c->get_dof_indices(dofs);
        const auto found = cells.find(key([&](const unsigned int v) {
          return dofs[fe.component_to_system_index(0, v)];
        }));
        ASSERT_TRUE(found != cells.end());
        ++n_found;
        const auto nodes = discretization.cell_nodes(found->second);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          for (unsigned int a = 0; a < 3; ++a)
            {
              const auto dof = dofs[fe.component_to_system_index(a, i)];
              EXPECT_EQ(dof, 3 * discretization.global_node(nodes[i]) + a);
              // The round-off of positions of O(1).
              EXPECT_LE(points.at(dof).distance(
                          discretization.node_position(nodes[i])),
                        1e-14);
            }
      }
  EXPECT_EQ(n_found, discretization.n_owned_cells());
  EXPECT_EQ(3 * discretization.n_global_nodes(),
            discretization.dof_handler().n_dofs());
}

// Every cell that touches an owned node is a local cell: the volume of the
// local cells around each node, summed without communication, equals the sum
// over the owned cells of all ranks with that node.
TEST_P(DiscretizationTest, GhostCellsCompleteOwnedNodes)
{
  Vector with_ghosts, communicated;
  discretization.initialize_vector(with_ghosts);
  discretization.initialize_vector(communicated);
  for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
    for (const unsigned int n : discretization.cell_nodes(c))
      {
        const double volume = discretization.geometry(c).volume;
        with_ghosts.local_element(3 * n) += volume;
        if (c < discretization.n_owned_cells())
          communicated.local_element(3 * n) += volume;
      }
  communicated.compress(dealii::VectorOperation::add);
  EXPECT_LE(largest_difference(with_ghosts, communicated), 1e-14);
}

// The box has the volume 2 and the surface area 10, over all ranks.
TEST_P(DiscretizationTest, VolumeAndSurface)
{
  double volume_of_cells = 0, area = 0;
  for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
    volume_of_cells += discretization.geometry(c).volume;
  const ReferenceElement reference(GetParam());
  for (const BoundaryFace &face : discretization.boundary_faces())
    {
      const auto J =
        invert(discretization.geometry(face.cell).inverse_jacobian);
      area += cross_product_3d(J * reference.face_tangents[face.face][0],
                               J * reference.face_tangents[face.face][1])
                .norm() /
              2;
    }
  EXPECT_NEAR(dealii::Utilities::MPI::sum(volume_of_cells, MPI_COMM_WORLD),
              2,
              1e-13);
  EXPECT_NEAR(discretization.volume(), 2, 1e-13);
  EXPECT_NEAR(dealii::Utilities::MPI::sum(area, MPI_COMM_WORLD), 10, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Elements,
                         DiscretizationTest,
                         testing::Values(Element(1),
                                         Element(2),
                                         Element(3),
                                         Element::quadratic_with_bubbles()));
