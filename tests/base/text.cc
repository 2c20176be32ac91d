// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Text helpers. Expected values follow from the definition of the Levenshtein
// distance and of splitting; they are counted by hand.

#include <corotet/base/text.h>

#include <gtest/gtest.h>

using namespace corotet;

TEST(Text, NearestFindsTheFewestChanges)
{
  EXPECT_EQ(nearest("Densty", {"Degree", "Density"}), "Density");
  // One replaced character wins against two.
  EXPECT_EQ(nearest("x-mix", {"y-min", "x-max", "x-min"}), "x-max");
}

TEST(Text, NearestIgnoresCase)
{
  EXPECT_EQ(nearest("TIME STEP", {"End time", "Time step"}), "Time step");
}

TEST(Text, NearestIsEmptyIfNothingIsNear)
{
  EXPECT_EQ(nearest("Colour", {"Density", "Degree"}), "");
  EXPECT_EQ(nearest("anything", {}), "");
  // Two of three characters are too many.
  EXPECT_EQ(nearest("abc", {"axy"}), "");
}

TEST(Text, Join)
{
  EXPECT_EQ(join({}), "");
  EXPECT_EQ(join({"a"}), "a");
  EXPECT_EQ(join({"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(join({"a", "b"}, "/"), "a/b");
}

TEST(Text, SplitOutsideBrackets)
{
  using Parts = std::vector<std::string>;
  EXPECT_EQ(split_outside_brackets(" min(1, x) , y[2,3],z ", ','),
            (Parts{"min(1, x)", "y[2,3]", "z"}));
  EXPECT_EQ(split_outside_brackets("", ';'), Parts{""});
  EXPECT_EQ(split_outside_brackets("a;;", ';'), (Parts{"a", "", ""}));
  // A bracket too many must not hide the separators behind it.
  EXPECT_EQ(split_outside_brackets("a);b", ';'), (Parts{"a)", "b"}));
}
