// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/memory.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

using namespace corotet;

namespace
{
  // In bytes, by the name of a line of /proc/self/status.
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
  // All but less than a piece of 4 MiB and parts of pages, and some for what
  // others do.
  EXPECT_LT(resident("RssAnon"), before - 8. * n_passed + 6e6);
  EXPECT_EQ(sum, 0.5 * n_passed * (n_passed - 1));
  for (std::size_t i = n_passed; i < values.size(); ++i)
    ASSERT_EQ(values[i], static_cast<double>(i));
  values.front() = 1;
  EXPECT_EQ(values.front(), 1);
}

// A few pages are not worth a call.
TEST(Memory, LastReadingKeepsSmallArrays)
{
  std::vector<double> values(100000, 2.);
  LastReading         reading(values.data());
  reading.passed(values.data() + values.size());
  EXPECT_EQ(std::accumulate(values.begin(), values.end(), 0.),
            2. * values.size());
}

TEST(Memory, PagesOfLibrariesComeBack)
{
  const double before = resident("RssFile");
  release_library_pages();
  // The names of deal.II's functions alone are more.
  EXPECT_LT(resident("RssFile"), before - 20e6);
  // Needs tables that have been given back.
  EXPECT_THROW(throw std::runtime_error("found"), std::runtime_error);
}
