// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A distributed matrix of blocks: the owners of nodes, ghosts and columns,
// their exchange, and the matrix-vector product, on any number of ranks.

#include <corotet/operators/block_matrix.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace corotet;

namespace
{
  constexpr int n_nodes = 23;

  /// Whether the matrix has a block: the pattern is no band and not symmetric.
  bool
  has_block(const int i, const int j)
  {
    return i == j || (5 * i + 3 * j) % 7 < 2;
  }

  double
  entry(const int row, const int column)
  {
    return std::sin(3. * row + column);
  }

  /// A matrix; if there are several ranks, the first one owns no nodes.
  struct Example
  {
    explicit Example(const MPI_Comm comm)
    {
      const int rank    = dealii::Utilities::MPI::this_mpi_process(comm);
      const int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
      first =
        n_ranks == 1 ? 0 : n_nodes * std::max(rank - 1, 0) / (n_ranks - 1);
      end = n_ranks == 1 ? n_nodes : n_nodes * rank / (n_ranks - 1);
      NodeGraph rows;
      for (int i = first; i < end; ++i)
        {
          // Columns may be given in any order.
          for (int j = n_nodes; j-- > 0;)
            if (has_block(i, j))
              rows.columns.push_back(j);
          rows.starts.push_back(rows.columns.size());
        }
      pattern = std::make_shared<const BlockPattern>(rows, comm);
      matrix  = std::make_unique<BlockMatrix>(pattern);
      for (int i = first; i < end; ++i)
        for (int j = 0; j < n_nodes; ++j)
          if (has_block(i, j))
            {
              const int place =
                pattern->place(i - first, pattern->nodes().local_node(j));
              for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b)
                  matrix->row(i - first, a)[3 * place + b] =
                    entry(3 * i + a, 3 * j + b);
            }
    }

    int                                 first, end;
    std::shared_ptr<const BlockPattern> pattern;
    std::unique_ptr<BlockMatrix>        matrix;
  };

  void
  check_ghosts(const Example &example)
  {
    const BlockPattern &pattern = *example.pattern;
    const MPI_Comm      comm    = pattern.communicator();
    // Every ghost gets the number of its node.
    std::vector<int> numbers(pattern.exchange().n_items(), -1);
    for (int i = 0; i < pattern.n_owned(); ++i)
      numbers[i] = example.first + i;
    pattern.exchange().update(numbers.data());
    for (int i = 0; i < pattern.exchange().n_items(); ++i)
      EXPECT_EQ(numbers[i], pattern.nodes().global_node(i));

    // Each node gets its number from all ranks where it is a ghost.
    std::vector<int> here(n_nodes), everywhere(n_nodes);
    for (int i = 0; i < pattern.nodes().n_local(); ++i)
      here[pattern.nodes().global_node(i)] = 1;
    MPI_Allreduce(
      here.data(), everywhere.data(), n_nodes, MPI_INT, MPI_SUM, comm);
    std::vector<int> twice;
    for (const int number : numbers)
      twice.insert(twice.end(), {number, -number});
    pattern.exchange().add(twice.data(), 2);
    for (int i = 0; i < pattern.n_owned(); ++i)
      {
        const int node = example.first + i;
        EXPECT_EQ(twice[std::size_t(2) * i], node * everywhere[node]);
        EXPECT_EQ(twice[std::size_t(2) * i + 1], -node * everywhere[node]);
        EXPECT_EQ(pattern.nodes().owner(node),
                  std::pair(static_cast<int>(
                              dealii::Utilities::MPI::this_mpi_process(comm)),
                            i));
      }
    for (const int ghost : pattern.nodes().ghosts())
      EXPECT_NE(pattern.nodes().owner(ghost).first,
                static_cast<int>(
                  dealii::Utilities::MPI::this_mpi_process(comm)));
  }

  void
  check(const MPI_Comm comm)
  {
    Example             example(comm);
    const BlockPattern &pattern = *example.pattern;
    EXPECT_EQ(pattern.nodes().n_global(), n_nodes);
    EXPECT_EQ(pattern.n_owned(), example.end - example.first);
    EXPECT_EQ(pattern.nodes().first_owned(), example.first);

    // Local numbers lead back to the nodes; columns ascend.
    EXPECT_TRUE(std::is_sorted(pattern.nodes().ghosts().begin(),
                               pattern.nodes().ghosts().end()));
    const NodeGraph &graph = pattern.graph();
    for (int i = 0; i < pattern.n_owned(); ++i)
      {
        std::vector<int> found, expected;
        for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
          {
            found.push_back(pattern.nodes().global_node(graph.columns[k]));
            EXPECT_TRUE(k == graph.starts[i] ||
                        graph.columns[k - 1] < graph.columns[k]);
          }
        std::sort(found.begin(), found.end());
        for (int j = 0; j < n_nodes; ++j)
          if (has_block(example.first + i, j))
            expected.push_back(j);
        EXPECT_EQ(found, expected);
      }

    check_ghosts(example);

    // The product is checked entry by entry: sums of up to 69 numbers below
    // one.
    dealii::IndexSet owned(3 * n_nodes);
    owned.add_range(3 * example.first, 3 * example.end);
    Vector x(owned, comm), y(x);
    for (int i = 3 * example.first; i < 3 * example.end; ++i)
      x.local_element(i - 3 * example.first) = std::cos(i);
    double factor = 1;
    for (unsigned int round = 0; round < 2; ++round)
      {
        example.matrix->vmult(y, x);
        for (int i = 3 * example.first; i < 3 * example.end; ++i)
          {
            double expected = 0;
            for (int j = 0; j < 3 * n_nodes; ++j)
              if (has_block(i / 3, j / 3))
                expected += entry(i, j) * std::cos(j);
            EXPECT_NEAR(y.local_element(i - 3 * example.first),
                        factor * expected,
                        1e-13);
            EXPECT_EQ(example.matrix->diagonal(i - 3 * example.first),
                      factor * entry(i, i));
          }
        factor = -0.5;
        example.matrix->scale(factor);
      }
    example.matrix->set_zero();
    EXPECT_EQ(example.matrix->largest_value(), 0.);
    example.matrix->vmult(y, x);
    EXPECT_EQ(y.linfty_norm(), 0.);
  }
} // namespace

TEST(BlockMatrix, AllRanks)
{
  check(MPI_COMM_WORLD);
}

TEST(BlockMatrix, OneRank)
{
  check(MPI_COMM_SELF);
}
