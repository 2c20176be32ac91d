// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/discretization/prescribed_motion.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace corotet
{
  namespace
  {
    const std::string blamed_entry = "Boundary conditions/Displacement";

    std::string
    plural(const std::string &kind)
    {
      return kind == "boundary" ? "boundaries" : kind + "s";
    }
  } // namespace

  PrescribedMotion::PrescribedMotion(const Discretization     &discretization,
                                     const ReferenceElement   &reference,
                                     const BoundaryConditions &conditions,
                                     const double              time_scale)
    : discretization(discretization)
    , conditions(conditions)
    , time_scale(time_scale)
    , length_scale(std::cbrt(discretization.volume()))
    , flags(std::size_t(3) * discretization.n_local_nodes())
  {
    std::vector<unsigned int> entry_of_unknown(flags.size());
    for (unsigned int d = 0; d < conditions.displacements.size(); ++d)
      {
        const auto &condition = conditions.displacements[d];
        const std::vector<unsigned char> is_common =
          common_nodes(reference, condition.places, condition.entry);
        for (unsigned int unknown = 0; unknown < flags.size(); ++unknown)
          if (is_common[unknown / 3] && condition.components[unknown % 3])
            {
              const bool is_owned =
                unknown < 3 * discretization.n_owned_nodes();
              if (is_owned && flags[unknown])
                shared.push_back({{unknown, d}, entry_of_unknown[unknown]});
              else if (is_owned)
                {
                  entry_of_unknown[unknown] = entries.size();
                  entries.push_back({unknown, d});
                  prescribed.push_back(unknown);
                }
              flags[unknown] = 1;
            }
      }
  }

  void
  PrescribedMotion::mark(Vector                 &marks,
                         const ReferenceElement &reference,
                         const Place            &place) const
  {
    const auto contains = [](const std::vector<unsigned int> &ids,
                             const unsigned int               id) {
      return std::binary_search(ids.begin(), ids.end(), id);
    };
    const auto mark_nodes = [&](const unsigned int               cell,
                                const std::vector<unsigned int> &nodes) {
      for (const unsigned int i : nodes)
        marks.local_element(3 * discretization.cell_nodes(cell)[i]) = 1;
    };
    for (const unsigned int boundary : place.boundaries)
      for (const BoundaryFace &face : discretization.boundary_faces(boundary))
        mark_nodes(face.cell, reference.face_nodes[face.face]);
    if (place.edges.empty() && place.corners.empty())
      return;
    std::vector<unsigned int> local_cells(discretization.n_local_cells());
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      local_cells[discretization.cell_in_local_mesh(c)] = c;
    for (const auto &[cell, edge, id] : discretization.mesh().named_edges())
      if (contains(place.edges, id))
        mark_nodes(local_cells[cell], reference.edge_nodes[edge]);
    for (const auto &[cell, vertex, id] : discretization.mesh().named_corners())
      if (contains(place.corners, id))
        mark_nodes(local_cells[cell], {vertex});
  }

  std::vector<unsigned char>
  PrescribedMotion::common_nodes(const ReferenceElement &reference,
                                 const std::set<Place>  &places,
                                 const std::string      &entry) const
  {
    std::vector<unsigned char> is_common(discretization.n_local_nodes(), 1);
    Vector                     marks;
    discretization.initialize_vector(marks);
    for (const Place &place : places)
      {
        // A node may lie on a boundary although none of the owned cells that
        // touch it has a face there: the marks are in a vector, whose exchange
        // tells it to all ranks that have the node.
        marks = 0;
        mark(marks, reference, place);
        marks.compress(dealii::VectorOperation::add);
        marks.update_ghost_values();
        for (unsigned int n = 0; n < is_common.size(); ++n)
          if (marks.local_element(3 * n) == 0)
            is_common[n] = 0;
      }
    const bool any =
      std::find(is_common.begin(), is_common.end(), 1) != is_common.end();
    if (dealii::Utilities::MPI::max(any ? 1 : 0,
                                    discretization.communicator()) == 0)
      throw InputError(entry,
                       fmt::format("{} have no node in common: found '{}'; "
                                   "allowed are those that meet in an edge or "
                                   "a corner",
                                   plural(BoundaryConditions::kind(places)),
                                   conditions.name(places)));
    return is_common;
  }

  double
  PrescribedMotion::value(const Entry &entry, const double time) const
  {
    const Expression &formula = expression(entry);
    return formula.is_zero() ?
             0. :
             formula.value(discretization.node_position(entry.unknown / 3),
                           time);
  }

  void
  PrescribedMotion::check_agreement(const double time) const
  {
    for (const auto &[other, first] : shared)
      {
        const double u = value(entries[first], time);
        const double w = value(other, time);
        // Values of expressions agree up to round-off only.
        if (std::abs(u - w) >
            1e-12 * (std::abs(u) + std::abs(w) + length_scale))
          {
            const auto places = [&](const Entry &entry) {
              return conditions.displacements[entry.condition].places;
            };
            std::set<Place> both = places(entries[first]);
            both.merge(places(other));
            const dealii::Point<3> x =
              discretization.node_position(other.unknown / 3);
            throw InputError(
              blamed_entry,
              fmt::format("{} '{}' and '{}' prescribe different "
                          "displacements in {} at their common point ({}, {}, "
                          "{}) at t = {}: found {} and {}, allowed are equal "
                          "ones",
                          plural(BoundaryConditions::kind(both)),
                          conditions.name(places(entries[first])),
                          conditions.name(places(other)),
                          "xyz"[other.unknown % 3],
                          x[0],
                          x[1],
                          x[2],
                          time,
                          u,
                          w));
          }
      }
  }

  std::array<double, 3>
  PrescribedMotion::motion(const Entry &entry, const double time) const
  {
    const Expression &formula = expression(entry);
    const double      u       = value(entry, time);
    if (!std::isfinite(u))
      throw InputError(blamed_entry,
                       fmt::format("the displacement at t = {} is not "
                                   "finite: found {}",
                                   time,
                                   u));
    if (time_scale == 0 || !formula.depends_on_time())
      return {{u, 0, 0}};
    const auto [v, a] =
      formula.time_derivatives(discretization.node_position(entry.unknown / 3),
                               time,
                               0.1 * time_scale);
    if (!std::isfinite(v) || !std::isfinite(a))
      throw InputError(blamed_entry,
                       fmt::format("the displacement has no velocity or "
                                   "acceleration at t = {}: found {} and {}, "
                                   "allowed are finite ones",
                                   time,
                                   v,
                                   a));
    return {{u, v, a}};
  }

  void
  PrescribedMotion::apply(const double time,
                          const double load_factor,
                          Vector      &displacement,
                          Vector      &velocity,
                          Vector      &acceleration) const
  {
    on_all_ranks(discretization.communicator(), [&] {
      check_agreement(time);
      // A value that does not depend on space is computed once for all nodes of
      // a condition.
      std::array<std::array<double, 3>, 3> known{};
      std::array<unsigned int, 3>          known_condition;
      known_condition.fill(dealii::numbers::invalid_unsigned_int);
      for (const Entry &entry : entries)
        {
          const unsigned int component = entry.unknown % 3;
          if (known_condition[component] != entry.condition ||
              expression(entry).depends_on_space())
            known[component] = motion(entry, time);
          known_condition[component]                = entry.condition;
          const auto &[u, v, a]                     = known[component];
          displacement.local_element(entry.unknown) = load_factor * u;
          if (velocity.size() == 0)
            continue;
          velocity.local_element(entry.unknown)     = load_factor * v;
          acceleration.local_element(entry.unknown) = load_factor * a;
        }
    });
  }

  bool
  PrescribedMotion::is_at_rest() const
  {
    for (const auto &condition : conditions.displacements)
      for (const auto &component : condition.components)
        if (component && component->depends_on_time())
          return false;
    return true;
  }

  void
  PrescribedMotion::set_zero(Vector &vector) const
  {
    for (const unsigned int unknown : prescribed)
      vector.local_element(unknown) = 0;
  }
} // namespace corotet
