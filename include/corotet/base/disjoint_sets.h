// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_disjoint_sets_h
#define corotet_base_disjoint_sets_h

#include <utility>
#include <vector>

namespace corotet
{
  /**
   * The numbers from 0 to n - 1 in sets that are united pair by pair
   * (union-find with path halving).
   */
  class DisjointSets
  {
  public:
    /// Each number is a set of its own.
    explicit DisjointSets(const unsigned int n);

    void
    unite(const unsigned int a, const unsigned int b);

    /// The smallest number of the set of @p a.
    unsigned int
    root(unsigned int a);

    /// For each number the index of its set, and how many sets there are. Sets
    /// are in the order of their smallest numbers.
    std::pair<std::vector<unsigned int>, unsigned int>
    numbers();

  private:
    /// Another number of the same set, smaller or equal.
    std::vector<unsigned int> parents;
  };
} // namespace corotet

#endif
