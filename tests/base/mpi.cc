// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Errors on one rank must become errors on all of them, with nothing lost.

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <new>

using namespace corotet;

namespace
{
  unsigned int
  this_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }
} // namespace

TEST(Mpi, OnRootRunsOnRankZeroOnly)
{
  bool ran = false;
  on_root(MPI_COMM_WORLD, [&] { ran = true; });
  EXPECT_EQ(ran, this_rank() == 0);
}

TEST(Mpi, OnRootThrowsOnEveryRank)
{
  try
    {
      on_root(MPI_COMM_WORLD, [] { throw InputError("Mesh/File", "no file"); });
      FAIL() << "nothing was thrown";
    }
  catch (const InputError &error)
    {
      EXPECT_EQ(error.exit_status, 1);
      EXPECT_EQ(error.entry, "Mesh/File");
      EXPECT_STREQ(error.what(), "no file");
    }
}

TEST(Mpi, KindsOfErrorsSurvive)
{
  EXPECT_THROW(on_root(MPI_COMM_WORLD,
                       [] { throw ComputationError("diverged"); }),
               ComputationError);
  EXPECT_THROW(on_root(MPI_COMM_WORLD, [] { throw MachineError("disk full"); }),
               MachineError);
}

TEST(Mpi, FromRootGivesItsValueToEveryRank)
{
  EXPECT_EQ(from_root(MPI_COMM_WORLD,
                      [] { return "of rank " + std::to_string(this_rank()); }),
            "of rank 0");
  EXPECT_THROW(from_root(MPI_COMM_WORLD,
                         []() -> int { throw MachineError("disk full"); }),
               MachineError);
}

// Each rank in turn, and all of them, are short of memory or have no
// permission: all learn the same, and are in step afterwards.
TEST(Mpi, FailuresOfTheMachineAreErrorsOnEveryRank)
{
  const unsigned int n_ranks =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  for (unsigned int failing = 0; failing <= n_ranks; ++failing)
    {
      const auto message = [&](const std::function<void()> &failure) {
        try
          {
            on_all_ranks(MPI_COMM_WORLD, [&] {
              if (this_rank() == failing || failing == n_ranks)
                failure();
            });
          }
        catch (const MachineError &error)
          {
            return std::string(error.what());
          }
        return std::string("none");
      };
      const std::string start = "memory is too short: this process has ";
      EXPECT_TRUE(message([] { throw std::bad_alloc(); }).starts_with(start));
      // deal.II's aligned memory, and its vectors, throw this exception.
      EXPECT_TRUE(
        message([] { throw dealii::ExcOutOfMemory(1000); }).starts_with(start));
      EXPECT_TRUE(message([] {
                    throw std::runtime_error("Kokkos failed to allocate memory "
                                             "for label \"memoryspace data\"");
                  }).starts_with(start));
      EXPECT_EQ(message([] { std::filesystem::create_directory("/proc/a/b"); }),
                "/proc/a/b: No such file or directory");
      EXPECT_EQ(dealii::Utilities::MPI::sum(1u, MPI_COMM_WORLD), n_ranks);
    }
}

// With two ranks the last rank is not the first; with one rank it is.
TEST(Mpi, OnAllRanksThrowsTheErrorOfTheLowestRank)
{
  const unsigned int last =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) - 1;
  const auto message = [](const std::function<void()> &action) {
    try
      {
        on_all_ranks(MPI_COMM_WORLD, action);
      }
    catch (const Error &error)
      {
        return std::string(error.what());
      }
    return std::string("nothing thrown");
  };

  EXPECT_EQ(message([&] {
              if (this_rank() == last)
                throw InputError("", "from the last");
            }),
            "from the last");
  EXPECT_EQ(message([&] {
              throw InputError("", "from " + std::to_string(this_rank()));
            }),
            "from 0");
  EXPECT_EQ(message([] {}), "nothing thrown");
}
