// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The meaning of names and numbers where sets overlap.

#include <corotet/mesh/mesh_names.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace corotet;

// Files may list a member twice: an id is not split only if all its members
// are in the set.
TEST(NamedSets, RepeatedMembers)
{
  std::vector<unsigned int>   ids{0, 0, 0, 0, 0};
  std::vector<unsigned int *> places;
  for (unsigned int &id : ids)
    places.push_back(&id);
  NamedSets named;
  named.add("some", {0, 1, 2, 2, 1}, places);
  const auto some = MeshNames("region", named).ids("some", "");
  for (std::size_t i = 0; i < ids.size(); ++i)
    EXPECT_EQ(std::find(some.begin(), some.end(), ids[i]) != some.end(), i < 3)
      << i;
}

// Where sets overlap, each member has one id, and every name keeps the meaning
// that it had before other sets were added.
TEST(NamedSets, Overlap)
{
  using Ids = std::vector<unsigned int>;
  std::vector<unsigned int>   ids{0, 0, 0, 1, 1, 2};
  std::vector<unsigned int *> places;
  for (unsigned int &id : ids)
    places.push_back(&id);
  NamedSets  named{{{0, "left"}, {1, ""}, {2, "right"}}, {}, {}};
  const auto members = [&](const std::string &name) {
    const Ids                of_name = MeshNames("region", named).ids(name, "");
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (std::find(of_name.begin(), of_name.end(), ids[i]) != of_name.end())
        result.push_back(i);
    return result;
  };
  using Members = std::vector<std::size_t>;
  named.add("top", {1, 3}, places);
  named.add("all", {0, 1, 2, 3, 4, 5}, places);
  named.add("last", {5}, places);
  named.add("top", {2}, places);
  EXPECT_EQ(members("left"), (Members{0, 1, 2}));
  EXPECT_EQ(members("right"), (Members{5}));
  EXPECT_EQ(members("top"), (Members{1, 2, 3}));
  EXPECT_EQ(members("all"), (Members{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(members("last"), (Members{5}));
  // The numbers of ids mean the members that they had before they were split.
  named.add("first", {0}, places);
  EXPECT_EQ(members("0"), (Members{0, 1, 2}));
  EXPECT_EQ(members("1"), (Members{3, 4}));
  EXPECT_EQ(members("2"), (Members{5}));

  const MeshNames names("region", named);
  EXPECT_EQ(names.name(ids[1]), "all & left & top");
  EXPECT_EQ(names.name(names.ids("top", "")), "top");
  EXPECT_EQ(
    names.known(),
    (std::vector<std::string>{"right", "all", "first", "last", "left", "top"}));

  named.restrict_to({ids[0], ids[4]});
  EXPECT_EQ(MeshNames("region", named).known(),
            (std::vector<std::string>{"all", "first", "left"}));
}
