// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Copies of nodes, one for each material that meets at the node.

#include <corotet/base/exceptions.h>
#include <corotet/operators/material_nodes.h>

#include <gtest/gtest.h>

#include <limits>

using namespace corotet;

// deal.II must be able to number three unknowns and three more for each copy,
// with 32 bits in Debian's build: a body of 300 million cubic cells, which is
// otherwise allowed, has too many.
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
