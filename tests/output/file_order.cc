// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The order of cells and nodes in files is the same on any number of ranks.

#include <corotet/base/log.h>
#include <corotet/discretization/coarser_nodes.h>
#include <corotet/output/file_order.h>

#include <gtest/gtest.h>

#include "support.h"

using namespace corotet;
using namespace test_output;

namespace
{
  struct OrderedBody
  {
    OrderedBody(const Element element, const MPI_Comm comm)
      : log(comm, true)
      , mesh(distorted_box(), 0, 1, comm, log)
      , discretization(mesh, element)
    {}

    Log            log;
    Mesh           mesh;
    Discretization discretization;
  };

  // The positions of nodes in the order of files.
  std::vector<double>
  places_of_nodes(const Discretization &discretization,
                  const Nodes          &nodes,
                  const CoarserNodes   *coarser = nullptr)
  {
    std::vector<double> places;
    for (unsigned int n = 0; n < nodes.n_owned_nodes(); ++n)
      for (unsigned int a = 0; a < 3; ++a)
        places.push_back(discretization.node_position(
          coarser != nullptr ? coarser->key(n) : n)[a]);
    return FileOrder::of_nodes(discretization, nodes).to_file(places.data(), 3);
  }

  std::vector<double>
  places_of_cells(const Discretization &discretization)
  {
    std::vector<double> places;
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      for (unsigned int a = 0; a < 3; ++a)
        {
          double sum = 0;
          for (unsigned int v = 0; v < 4; ++v)
            sum +=
              discretization.node_position(discretization.cell_nodes(c)[v])[a];
          places.push_back(sum);
        }
    return FileOrder::of_cells(discretization).to_file(places.data(), 3);
  }

  // Compares the rows of this rank with those of one rank alone, up to the
  // round-off of positions that are computed in another cell.
  void
  compare(const std::vector<double> &rows,
          const std::vector<double> &all_rows,
          const Hdf5Rows            &place)
  {
    ASSERT_EQ(rows.size(), 3 * place.n_rows);
    ASSERT_EQ(all_rows.size(), 3 * place.n_global_rows);
    for (std::size_t i = 0; i < rows.size(); ++i)
      EXPECT_NEAR(rows[i], all_rows[3 * place.first + i], 1e-15);
  }

  const std::vector<Element> elements{Element(1),
                                      Element(2),
                                      Element(3),
                                      Element::quadratic_with_bubbles()};
} // namespace

TEST(FileOrder, DoesNotDependOnTheRanks)
{
  for (const Element &element : elements)
    {
      const OrderedBody     body(element, MPI_COMM_WORLD);
      const OrderedBody     alone(element, MPI_COMM_SELF);
      const Discretization &mine = body.discretization,
                           &all  = alone.discretization;
      compare(places_of_nodes(mine, mine),
              places_of_nodes(all, all),
              FileOrder::of_nodes(mine, mine).rows());
      compare(places_of_cells(mine),
              places_of_cells(all),
              FileOrder::of_cells(mine).rows());
      // Only with bubbles are coarser nodes at the positions of the finer nodes
      // that are their keys.
      if (!element.has_bubbles())
        continue;
      const CoarserNodes coarser(mine), all_coarser(all);
      compare(places_of_nodes(mine, coarser, &coarser),
              places_of_nodes(all, all_coarser, &all_coarser),
              FileOrder::of_nodes(mine, coarser).rows());
    }
}

TEST(FileOrder, ComesBack)
{
  const OrderedBody     body(Element(3), MPI_COMM_WORLD);
  const Discretization &discretization = body.discretization;
  const FileOrder order = FileOrder::of_nodes(discretization, discretization);
  const Vector   &positions      = discretization.node_positions();
  const std::vector<double> rows = order.to_file(positions.begin(), 3);
  Vector                    back;
  discretization.initialize_vector(back);
  order.from_file(rows.data(), back.begin(), 3);
  for (unsigned int i = 0; i < back.locally_owned_size(); ++i)
    EXPECT_EQ(back.local_element(i), positions.local_element(i));

  // Each row belongs to one node.
  const std::vector<std::int64_t> numbers = order.row_numbers();
  std::vector<unsigned int>       found(discretization.n_global_nodes());
  for (const std::int64_t row : numbers)
    ++found.at(row);
  dealii::Utilities::MPI::sum(found, MPI_COMM_WORLD, found);
  for (const unsigned int n : found)
    EXPECT_EQ(n, 1u);
}
