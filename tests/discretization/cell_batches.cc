// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// What sweeps ask for ahead.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "../body.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  struct CubicBox
  {
    explicit CubicBox(const std::string &cells)
      : log(MPI_COMM_WORLD, true)
      , mesh(box("1, 1, 1", cells), 0, 1., MPI_COMM_WORLD, log)
      , discretization(mesh, Element(3))
    {}

    const CellBatches &
    batches() const
    {
      return discretization.batches();
    }

    /// Distinct nodes of batches [first, end).
    std::set<unsigned int>
    nodes(const unsigned int first, const unsigned int end) const
    {
      return {batches().nodes(first), batches().nodes(end)};
    }

    Log            log;
    Mesh           mesh;
    Discretization discretization;
  };
} // namespace

TEST(CellBatches, SmallBodiesStayInTheCaches)
{
  const CubicBox body("3, 3, 3");
  EXPECT_FALSE(body.batches().exceed_caches<double>());
  EXPECT_FALSE(body.batches().exceed_caches<float>());
}

// Each node of a batch is among those of the 16 batches (8 in machines whose
// registers of floats are registers of doubles) before it, or is asked for,
// once; and only those are.
TEST(CellBatches, NodesThatAreFarAwayAreAskedFor)
{
  // 148,000 nodes, on one rank 8 MiB of vectors.
  const CubicBox     body("18, 18, 18");
  const CellBatches &batches = body.batches();
  ASSERT_TRUE(batches.exceed_caches<double>());
  const unsigned int window      = 8 * floats_per_batch;
  std::size_t        n_asked_for = 0;
  for (unsigned int b = 0; b < batches.n_batches(); ++b)
    {
      const auto present = body.nodes(b - std::min(b, window), b);
      std::vector<unsigned int> far_away;
      for (const unsigned int n : body.nodes(b, b + 1))
        if (!present.contains(n))
          far_away.push_back(n);
      const auto                asked_for = batches.nodes_to_fetch(b, b + 1);
      std::vector<unsigned int> sorted(asked_for.begin(), asked_for.end());
      std::sort(sorted.begin(), sorted.end());
      ASSERT_EQ(sorted, far_away) << "batch " << b;
      n_asked_for += sorted.size();
    }
  EXPECT_EQ(batches
              .nodes_to_fetch(batches.n_batches(),
                              batches.n_batches() + floats_per_batch)
              .size(),
            0u);
  // Along the curve few nodes are left and met again.
  EXPECT_GE(n_asked_for, body.discretization.n_local_nodes());
  EXPECT_LE(n_asked_for, 2u * body.discretization.n_local_nodes());
}
