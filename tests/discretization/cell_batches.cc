// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The plan of a sweep: chunks, the numbers of nodes in them, and where sums of
// nodes that chunks share are kept.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

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

    Log            log;
    Mesh           mesh;
    Discretization discretization;
  };

  // The local nodes of a chunk in the order of their numbers there.
  std::vector<unsigned int>
  nodes_of(const CellBatches &batches, const CellBatches::Chunk &chunk)
  {
    std::vector<unsigned int> result;
    for (unsigned int n = chunk.first_node; n < chunk.n_final; ++n)
      result.push_back(n);
    for (const PartialSum &open : batches.open_nodes(chunk))
      result.push_back(open.node);
    return result;
  }
} // namespace

TEST(CellBatches, SmallBodiesStayInTheCaches)
{
  const CubicBox body("3, 3, 3");
  EXPECT_FALSE(body.batches().exceed_caches<double>());
  EXPECT_FALSE(body.batches().exceed_caches<float>());
}

// Chunks follow each other without gaps. The numbers in a batch are those of
// its cells' nodes; each node has one number in a chunk, and each number
// belongs to a cell.
TEST(CellBatches, ChunksNumberTheNodesOfTheirCells)
{
  // The body has 148,000 nodes, enough for several chunks.
  const CubicBox     body("18, 18, 18");
  const CellBatches &batches = body.batches();
  EXPECT_TRUE(batches.exceed_caches<double>());
  EXPECT_GT(batches.chunks().size(), 3u);
  unsigned int next_batch = 0;
  for (const auto *const chunks :
       {&batches.chunks(), &batches.chunks_of_ghosts()})
    for (const CellBatches::Chunk &chunk : *chunks)
      {
        EXPECT_EQ(chunk.first, next_batch);
        next_batch                            = chunk.end;
        const std::vector<unsigned int> nodes = nodes_of(batches, chunk);
        EXPECT_EQ(std::set<unsigned int>(nodes.begin(), nodes.end()).size(),
                  nodes.size());
        EXPECT_LE(nodes.size(), batches.max_chunk_nodes());
        std::set<unsigned int> met;
        for (unsigned int b = chunk.first; b < chunk.end; ++b)
          {
            const auto [first, n_cells] = batches.cells(b);
            for (unsigned int lane = 0; lane < n_cells; ++lane)
              {
                const CellNodes cell =
                  body.discretization.cell_nodes(first + lane);
                for (unsigned int i = 0; i < cell.size(); ++i)
                  {
                    const unsigned int k =
                      batches.nodes(b)[i * batch_size + lane];
                    ASSERT_LT(k, nodes.size());
                    ASSERT_EQ(nodes[k], cell[i]);
                    met.insert(k);
                  }
              }
          }
        EXPECT_EQ(met.size(), nodes.size());
      }
  EXPECT_EQ(next_batch, batches.n_batches());
}

// A sweep over owned cells keeps sums in slots: each slot is empty when a node
// gets it, a node finds the sum of earlier chunks, and at the end of a chunk
// every final node has had all its cells on this rank.
TEST(CellBatches, SumsAreCompleteWhenTheyAreTaken)
{
  const CubicBox                       body("18, 18, 18");
  const CellBatches                   &batches = body.batches();
  const Discretization                &d       = body.discretization;
  std::map<unsigned int, unsigned int> n_cells_of_node, n_met;
  std::map<unsigned int, unsigned int> node_in_slot;
  std::vector<unsigned int>            n_in_slot(batches.n_slots());
  for (unsigned int c = 0; c < d.n_owned_cells(); ++c)
    for (const unsigned int n : d.cell_nodes(c))
      ++n_cells_of_node[n];
  unsigned int next_node = 0;
  for (const CellBatches::Chunk &chunk : batches.chunks())
    {
      ASSERT_EQ(chunk.first_node, next_node);
      next_node = chunk.n_final;
      std::map<unsigned int, unsigned int> met;
      for (unsigned int b = chunk.first; b < chunk.end; ++b)
        {
          const auto [first, n] = batches.cells(b);
          for (unsigned int c = first; c < first + n; ++c)
            for (const unsigned int node : d.cell_nodes(c))
              ++met[node];
        }
      for (const PartialSum &open : batches.open_nodes(chunk))
        {
          const auto [place, is_new] =
            node_in_slot.try_emplace(open.slot, open.node);
          ASSERT_EQ(place->second, open.node);
          n_in_slot[open.slot] += met[open.node];
        }
      for (const PartialSum &continued : batches.continued_nodes(chunk))
        {
          const unsigned int node = chunk.first_node + continued.node;
          ASSERT_EQ(node_in_slot.at(continued.slot), node);
          met[node] += n_in_slot[continued.slot];
          n_in_slot[continued.slot] = 0;
          node_in_slot.erase(continued.slot);
        }
      for (unsigned int n = chunk.first_node; n < chunk.n_final; ++n)
        ASSERT_EQ(met[n], n_cells_of_node[n]);
    }
  EXPECT_EQ(next_node, d.first_shared_node());
  // The remaining slots belong to nodes that other ranks have, in their order.
  for (unsigned int n = d.first_shared_node(); n < d.n_local_nodes(); ++n)
    EXPECT_EQ(n_in_slot[n - d.first_shared_node()], n_cells_of_node[n]);
  // Slots of all other nodes are used more than once.
  std::size_t n_continued = 0;
  for (const CellBatches::Chunk &chunk : batches.chunks())
    n_continued += batches.continued_nodes(chunk).size();
  EXPECT_LT(batches.n_slots() - (d.n_local_nodes() - d.first_shared_node()),
            n_continued);
}
