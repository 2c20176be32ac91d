// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/joint_reduction.h>
#include <corotet/output/support_reactions.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

namespace corotet
{
  SupportReactions::SupportReactions(
    const std::vector<NamedSupport> &supports,
    const Body                      &body,
    const std::set<unsigned int>    &ground_boundaries)
    : support_names(names_of(supports))
    , boundaries(supports.size())
  {
    const std::string                entry    = "Output/Reactions";
    const std::vector<unsigned int> &unknowns = body.motion.unknowns();
    for (unsigned int s = 0; s < supports.size(); ++s)
      {
        const std::set<Place> places =
          body.conditions.find(supports[s].places, entry);
        const auto has_node =
          body.motion.common_nodes(body.reference, places, entry);
        // An edge or a corner in which places meet has no area.
        if (places.size() == 1)
          for (const unsigned int boundary : places.begin()->boundaries)
            if (ground_boundaries.contains(boundary))
              boundaries[s].insert(boundary);
        unsigned int n_found = 0;
        for (unsigned int k = 0; k < unknowns.size(); ++k)
          if (has_node[unknowns[k] / 3])
            {
              entries.push_back({s, k, unknowns[k] % 3});
              ++n_found;
            }
        if (boundaries[s].empty() &&
            dealii::Utilities::MPI::max(n_found,
                                        body.discretization.communicator()) ==
              0)
          throw InputError(entry,
                           fmt::format("nothing is fixed or prescribed at "
                                       "'{}', and no springs or dashpots act "
                                       "there; allowed are places with one of "
                                       "these",
                                       supports[s].places));
      }
  }

  std::vector<SupportReactions::Reaction>
  SupportReactions::reactions(const Snapshot &state) const
  {
    std::vector<Reaction> result(support_names.size());
    for (const auto &[support, number, component] : entries)
      {
        const SupportForce  &at = state.support_forces[number];
        dealii::Tensor<1, 3> force;
        force[component] = at.force;
        result[support].force += force;
        result[support].moment += cross_product_3d(at.position, force);
      }
    JointReduction reduction;
    for (Reaction &reaction : result)
      {
        reduction.sum(reaction.force);
        reduction.sum(reaction.moment);
      }
    reduction.run(state.discretization.communicator());
    for (unsigned int s = 0; s < result.size(); ++s)
      for (const GroundForce &ground : state.record.ground_forces)
        if (boundaries[s].contains(ground.boundary))
          {
            result[s].force += ground.force;
            result[s].moment += ground.moment;
          }
    return result;
  }
} // namespace corotet
