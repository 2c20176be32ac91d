// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_support_reactions_h
#define corotet_output_support_reactions_h

#include <corotet/output/output_parameters.h>
#include <corotet/simulation/body.h>

#include <set>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The forces and moments that single supports exert on the body: sums over
   * the prescribed unknowns at their nodes, and over springs and dashpots on
   * their boundaries.
   */
  class SupportReactions
  {
  public:
    struct Reaction
    {
      /// The force [N].
      dealii::Tensor<1, 3> force;
      /// The moment about the origin, with current positions [N m].
      dealii::Tensor<1, 3> moment;
    };

    SupportReactions() = default;

    /// Throws InputError, blamed on Output/Reactions, for unknown names and for
    /// supports where nothing is prescribed and that are none of the @p
    /// ground_boundaries, on which springs and dashpots act. Collective.
    SupportReactions(const std::vector<NamedSupport> &supports,
                     const Body                      &body,
                     const std::set<unsigned int>    &ground_boundaries);

    const std::vector<std::string> &
    names() const
    {
      return support_names;
    }

    /// The reactions of each support, on all ranks, at the time for which the
    /// equation of motion was solved. Collective.
    std::vector<Reaction>
    reactions(const Snapshot &state) const;

  private:
    /// A prescribed unknown of a support: its index among the prescribed
    /// unknowns of this rank, and its component.
    struct Entry
    {
      unsigned int support;
      unsigned int number;
      unsigned int component;
    };

    std::vector<std::string> support_names;
    std::vector<Entry>       entries;
    /// The boundaries of each support on which springs and dashpots act.
    std::vector<std::set<unsigned int>> boundaries;
  };
} // namespace corotet

#endif
