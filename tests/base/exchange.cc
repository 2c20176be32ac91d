// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Each rank gets what others have for it, and nothing else, however many
// exchanges follow each other.

#include <corotet/base/exchange.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cstdint>

using namespace corotet;

namespace
{
  unsigned int
  number_of_ranks()
  {
    return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  }

  unsigned int
  own_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }

  using Arrays = std::map<unsigned int, std::vector<std::uint64_t>>;
} // namespace

// Each rank sends arrays of different lengths, some of them empty, to all
// ranks, itself included. Ranks are not in step: odd ones have much more to
// send.
TEST(Exchange, AllToAll)
{
  for (unsigned int round = 0; round < 50; ++round)
    {
      const auto array = [&](const unsigned int from, const unsigned int to) {
        return std::vector<std::uint64_t>(std::size_t(round) *
                                            (to + 5000 * (from % 2)),
                                          100 * round + 10 * from + to);
      };
      Arrays sent, expected;
      for (unsigned int rank = 0; rank < number_of_ranks(); ++rank)
        {
          sent[rank]     = array(own_rank(), rank);
          expected[rank] = array(rank, own_rank());
        }
      EXPECT_EQ(exchange_arrays(sent, MPI_COMM_WORLD), expected);
    }
}

// A rank gets no entry from ranks that have sent it nothing.
TEST(Exchange, OnlyWhoIsMeant)
{
  Arrays sent, expected;
  sent[0] = {own_rank()};
  if (own_rank() == 0)
    for (unsigned int rank = 0; rank < number_of_ranks(); ++rank)
      expected[rank] = {rank};
  EXPECT_EQ(exchange_arrays(sent, MPI_COMM_WORLD), expected);
  EXPECT_EQ(exchange_arrays(Arrays(), MPI_COMM_WORLD), Arrays());
}
