// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Nodes, one for each material that meets there.

#include <corotet/base/exceptions.h>
#include <corotet/operators/material_nodes.h>

#include <gtest/gtest.h>

#include <limits>

using namespace corotet;

// Six numbers of each copy must be numbers that deal.II has, of 32 bits in
// Debian's: a body of 300 million cubic cells, which is allowed, has more.
TEST(MaterialNodes, MoreThanNumbersCount)
{
  const std::uint64_t largest =
    std::numeric_limits<dealii::types::global_dof_index>::max();
  EXPECT_NO_THROW(MaterialNodes::check_number(largest / 6));
  try
    {
      MaterialNodes::check_number(largest / 6 + 1);
      FAIL() << "not refused";
    }
  catch (const InputError &error)
    {
      EXPECT_EQ(error.entry, "Output/Stress");
    }
}
