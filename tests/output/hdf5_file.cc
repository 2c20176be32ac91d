// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Files that all ranks write together: their content, and what remains of them
// if a rank cannot write.

#include <corotet/base/hdf5_file.h>

#include <gtest/gtest.h>

#include <numeric>
#include <optional>

#include "support.h"

using namespace corotet;
using namespace test_output;

namespace
{
  // The rows of this rank: 1000 and as many more as its number.
  Hdf5Rows
  own_rows(const hsize_t n_columns)
  {
    hsize_t first = 0, n = 0;
    for (unsigned int r = 0; r < n_ranks(); ++r)
      {
        if (r == rank())
          first = n;
        n += 1000 + r;
      }
    return {first, 1000 + rank(), n, n_columns};
  }

  // Writes tables of all types, in which each number is its own position.
  void
  write_tables(const std::string &path)
  {
    Hdf5File file(path, MPI_COMM_WORLD);
    file.create_group("group");
    const auto write = [&](const std::string &name,
                           const auto         zero,
                           const hsize_t      n_columns) {
      const Hdf5Rows rows = own_rows(n_columns);
      const hsize_t  n    = std::max<hsize_t>(1, n_columns);
      std::vector<std::remove_const_t<decltype(zero)>> values(rows.n_rows * n);
      std::iota(values.begin(), values.end(), zero + rows.first * n);
      file.write(name, values.data(), rows);
    };
    write("doubles", 0., 3);
    write("group/integers", std::int32_t(0), 0);
    write("group/long_integers", std::int64_t(0), 2);
    write("group/bytes", std::uint8_t(0), 0);
    // These tables have rows on rank 0 only, or no rows at all.
    file.write_from_root("root", std::vector<double>{0, 1, 2, 3}, 2);
    file.write_from_root("empty", std::vector<double>());
    file.write_number_attribute("group", "numbers", {1, 2});
    file.write_text_attribute("group", "text", "words");
    file.finish();
  }

  const std::string reason =
    ": the file cannot be written (is the disk full, or permission missing?)";
} // namespace

// h5py reads the tables; values of bytes are modulo 256.
TEST(Hdf5File, TablesOfAllRanks)
{
  const ScratchFolder scratch;
  write_tables(scratch.path + "/a.h5");
  EXPECT_FALSE(std::filesystem::exists(scratch.path + "/a.h5.tmp"));
  EXPECT_EQ(run_python("check_hdf5.py " + scratch.path + "/a.h5 " +
                       std::to_string(own_rows(0).n_global_rows)),
            0);
}

// On one rank or on all, files are limited in size, so that descriptions or
// some tables do not fit. All ranks throw the same error, and no file is left.
TEST(Hdf5File, AnyRankMayFail)
{
  const ScratchFolder scratch;
  const std::string   path = scratch.path + "/a.h5";
  write_tables(path);
  const std::string whole = content_of(path);
  for (unsigned int failing = 0; failing <= n_ranks(); ++failing)
    for (const double part : {0., 0.02, 0.1, 0.3, 0.5, 0.8, 0.99})
      {
        const std::string message = message_of<MachineError>([&] {
          std::optional<FileSizeLimit> limit;
          if (rank() == failing || failing == n_ranks())
            limit.emplace(part * whole.size());
          write_tables(path);
        });
        // Rank 0 writes descriptions last, at the end of the file. Rows of
        // other ranks may lie below the limit; some of the last rank's lie in
        // the last tenth of the file.
        const bool must_fail = failing == 0 || failing == n_ranks() ||
                               (failing + 1 == n_ranks() && part < 0.9);
        if (must_fail || message != "no error")
          {
            EXPECT_EQ(message, path + reason) << failing << ' ' << part;
          }
        wait_for_all();
        EXPECT_FALSE(std::filesystem::exists(path + ".tmp"));
        EXPECT_EQ(content_of(path), whole);
        wait_for_all();
      }
}

// The folder does not exist, or there is a folder with the name of the file.
TEST(Hdf5File, FilesThatCannotBeMade)
{
  const ScratchFolder scratch;
  for (const std::string name : {"absent/a.h5", "b.h5"})
    {
      const std::string path = scratch.path + "/" + name;
      if (on_rank_0())
        std::filesystem::create_directories(scratch.path + "/b.h5/folder");
      EXPECT_EQ(message_of<MachineError>([&] {
                  write_tables(path);
                }).substr(0, path.size() + 1),
                path + ":");
    }
}
