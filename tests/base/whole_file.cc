// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/whole_file.h>

#include <functional>
#include <string>

#include "parameter_example.h"

using namespace corotet;

namespace
{
  // A file that exists, can be opened and fails as soon as it is read, like one
  // on a broken disk: there is no memory at the address zero.
  const std::string unreadable = "/proc/self/mem";

  std::string
  failure(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const MachineError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(WholeFile, ContentOfAnySize)
{
  TemporaryFolder folder;
  for (const std::size_t size : {0, 1, 8191, 8192, 8193, 100000})
    {
      const std::string content(size, 'a');
      folder.write("file", content);
      EXPECT_EQ(read_whole_file(folder / "file"), content);
    }
}

TEST(WholeFile, FailureIsNoEnd)
{
  EXPECT_EQ(failure([] { read_whole_file(unreadable); }),
            unreadable + ": cannot be read to its end");
  EXPECT_EQ(failure([] { read_whole_file("/no/such/file"); }),
            "/no/such/file: cannot be read (permission?)");
  // If the failure passed for the end of the file, all entries behind it would
  // have their defaults.
  Example example;
  EXPECT_EQ(failure([&] {
              example.refusal("case.prm", "include " + unreadable + "\n");
            }),
            unreadable + ": cannot be read to its end");
}
