// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/memory.h>

#include <gtest/gtest.h>
#include <link.h>

#include <cstddef>
#include <fstream>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace corotet;

namespace
{
  // The memory [bytes] in the line of /proc/self/status with this name.
  double
  resident(const std::string &name)
  {
    std::ifstream status("/proc/self/status");
    std::string   word;
    double        kilobytes = 0;
    while (status >> word)
      if (word == name + ":")
        {
          status >> kilobytes;
          return 1024 * kilobytes;
        }
    throw std::runtime_error("no " + name);
  }
} // namespace

TEST(Memory, LastReadingGivesBackWhatHasBeenPassed)
{
  std::vector<double> values(8000000);
  std::iota(values.begin(), values.end(), 0.);
  const std::size_t n_passed = 6000000;
  const double      before   = resident("RssAnon");
  LastReading       reading(values.data());
  double            sum = 0;
  for (std::size_t i = 0; i < n_passed; ++i)
    {
      reading.passed(&values[i]);
      sum += values[i];
    }
  // All that was passed is given back, but for less than a piece of 4 MiB and
  // parts of pages; the process may use some memory for other things.
  EXPECT_LT(resident("RssAnon"), before - 8. * n_passed + 6e6);
  EXPECT_EQ(sum, 0.5 * n_passed * (n_passed - 1));
  for (std::size_t i = n_passed; i < values.size(); ++i)
    ASSERT_EQ(values[i], static_cast<double>(i));
  values.front() = 1;
  EXPECT_EQ(values.front(), 1);
}

// A few pages are not worth a system call.
TEST(Memory, LastReadingKeepsSmallArrays)
{
  std::vector<double> values(100000, 2.);
  LastReading         reading(values.data());
  reading.passed(values.data() + values.size());
  EXPECT_EQ(std::accumulate(values.begin(), values.end(), 0.),
            2. * values.size());
}

TEST(Memory, FreedArraysAreGivenBack)
{
  // Many small arrays come from the heap on all systems; the last one stays, so
  // that the heap does not end before it.
  const std::size_t                n_arrays = 1000, n_each = 12500;
  std::vector<std::vector<double>> arrays(n_arrays);
  for (std::vector<double> &values : arrays)
    values.assign(n_each, 1.);
  const double before = resident("RssAnon");
  for (std::size_t i = 0; i + 1 < n_arrays; ++i)
    std::vector<double>().swap(arrays[i]);
  release_free_memory();
  // All but parts of pages is given back; the process may use some memory for
  // other things.
  EXPECT_LT(resident("RssAnon"), before - 8. * n_arrays * n_each + 1e7);
  EXPECT_EQ(arrays.back(), std::vector<double>(n_each, 1.));
}

TEST(Memory, PagesOfLibrariesComeBack)
{
  // Size [bytes] of the read-only pages of all libraries, each of which is read
  // once so that it is in memory; and a sum that keeps the reading from being
  // left out.
  std::pair<double, unsigned int> found(0, 0);
  dl_iterate_phdr(
    [](dl_phdr_info *library, std::size_t, void *data) {
      auto &[size, sum] = *static_cast<std::pair<double, unsigned int> *>(data);
      for (const ElfW(Phdr) & header :
           std::span(library->dlpi_phdr, library->dlpi_phnum))
        if (header.p_type == PT_LOAD && header.p_flags == PF_R)
          {
            // NOLINTNEXTLINE(performance-no-int-to-ptr)
            const auto *bytes = reinterpret_cast<const unsigned char *>(
              library->dlpi_addr + header.p_vaddr);
            for (std::size_t i = 0; i < header.p_memsz; i += 4096)
              sum += bytes[i];
            size += header.p_memsz;
          }
      return 0;
    },
    &found);
  // Linkers of other machines put read-only tables beside the code.
  if (found.first < 30e6)
    GTEST_SKIP() << "few pages are there to be read only";
  const double before = resident("RssFile");
  release_library_pages();
  EXPECT_LT(resident("RssFile"), before - 0.5 * found.first);
  // Throwing reads tables that have been given back.
  EXPECT_THROW(throw std::runtime_error("found"), std::runtime_error);
}
