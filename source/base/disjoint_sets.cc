// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/disjoint_sets.h>

#include <algorithm>
#include <numeric>

namespace corotet
{
  DisjointSets::DisjointSets(const unsigned int n)
    : parents(n)
  {
    std::iota(parents.begin(), parents.end(), 0u);
  }

  unsigned int
  DisjointSets::root(unsigned int a)
  {
    while (parents[a] != a)
      a = parents[a] = parents[parents[a]];
    return a;
  }

  void
  DisjointSets::unite(const unsigned int a, const unsigned int b)
  {
    const auto [first, second] = std::minmax({root(a), root(b)});
    parents[second]            = first;
  }

  std::pair<std::vector<unsigned int>, unsigned int>
  DisjointSets::numbers()
  {
    std::vector<unsigned int> result(parents.size());
    unsigned int              n = 0;
    for (unsigned int a = 0; a < parents.size(); ++a)
      result[a] = parents[a] == a ? n++ : result[root(a)];
    return {result, n};
  }
} // namespace corotet
