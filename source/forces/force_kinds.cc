// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/named_values.h>
#include <corotet/base/parameter_file.h>
#include <corotet/base/text.h>
#include <corotet/forces/body_force.h>
#include <corotet/forces/contact.h>
#include <corotet/forces/elastic_support.h>
#include <corotet/forces/force_kind.h>
#include <corotet/forces/gravity.h>
#include <corotet/forces/point_forces.h>
#include <corotet/forces/pressure.h>
#include <corotet/forces/rayleigh_damping.h>
#include <corotet/forces/surface_forces.h>
#include <corotet/forces/traction.h>
#include <corotet/operators/mass.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace corotet
{
  void
  ForceContext::apply_mass(Vector &f, const Vector &a) const
  {
    mass.apply(f, a);
  }

  std::vector<ValueOnBoundaries>
  values_on_boundaries(const ForceContext &context,
                       const std::string  &list,
                       const std::string  &entry,
                       const std::string  &what)
  {
    const PlaceNames &names = context.discretization.mesh().places();
    std::vector<ValueOnBoundaries> items;
    std::set<unsigned int>         known;
    for (const auto &[name, value] : named_values(list, entry))
      {
        items.push_back({name, value, names.boundary_ids(name, entry, what)});
        for (const unsigned int id : items.back().boundaries)
          if (!known.insert(id).second)
            refuse_second_boundary(entry, names.boundaries.name(id));
      }
    return items;
  }

  std::string
  on_boundary(const ForceContext &context,
              const std::string  &entry,
              const unsigned int  boundary)
  {
    return entry + " on boundary '" +
           shortened(
             context.discretization.mesh().boundaries().name(boundary)) +
           "'";
  }

  std::vector<Candidate<ForceKind>>
  force_kinds()
  {
    return with_added<ForceKind>(
      {candidate<ForceKind, GravityKind>("gravity"),
       candidate<ForceKind, BodyForceKind>("body force"),
       candidate<ForceKind, PointForcesKind>("point forces"),
       candidate<ForceKind, SurfaceForcesKind>("surface forces"),
       candidate<ForceKind, TractionKind>("traction"),
       candidate<ForceKind, PressureKind>("pressure"),
       candidate<ForceKind, RayleighDampingKind>("Rayleigh damping"),
       candidate<ForceKind, SupportsKind>("supports"),
       candidate<ForceKind, ContactKind>("contact")});
  }

  namespace
  {
    // Two kinds must not have the same entry, which each of them would take for
    // its own.
    void
    check_entries(const std::vector<Candidate<ForceKind>> &kinds)
    {
      std::map<std::string, std::string> kind_of;
      for (const Candidate<ForceKind> &candidate : kinds)
        {
          const std::unique_ptr<ForceKind> kind = candidate.make();
          ParameterFile                    file;
          kind->declare_parameters(file.handler());
          // The names "/Section/Entry" of all entries.
          const auto entries = file.values().flatten();
          for (const auto &[entry, value] : entries.items())
            if (const auto [known, is_new] =
                  kind_of.emplace(entry, candidate.name);
                !is_new && !entry.empty())
              throw std::logic_error(
                fmt::format("two kinds of force have the entry '{}': '{}' and "
                            "'{}'",
                            entry.substr(1),
                            known->second,
                            candidate.name));
        }
    }
  } // namespace

  ForceParameters::ForceParameters()
  {
    const std::vector<Candidate<ForceKind>> candidates = force_kinds();
    for (const Candidate<ForceKind> &kind : candidates)
      kinds.push_back(kind.make());
    n_of_library = kinds.size() - added_candidates<ForceKind>().size();
    // The kinds of the library share no entry.
    if (!added_candidates<ForceKind>().empty())
      check_entries(candidates);
  }

  void
  ForceParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    for (const auto &kind : kinds)
      kind->declare_parameters(prm);
  }

  std::vector<ForceKind::GivenEntry>
  ForceParameters::given() const
  {
    std::vector<ForceKind::GivenEntry> all;
    for (const auto &kind : kinds)
      for (const ForceKind::GivenEntry &entry : kind->given())
        all.push_back(entry);
    return all;
  }

  std::vector<std::string>
  ForceParameters::obstacles() const
  {
    std::vector<std::string> all;
    for (const auto &kind : kinds)
      for (const std::string &name : kind->obstacles())
        all.push_back(name);
    return all;
  }

  ForceTerms
  ForceParameters::make(const ForceContext &context) const
  {
    ForceTerms terms(context.discretization);
    for (std::size_t k = 0; k < kinds.size(); ++k)
      {
        if (k == n_of_library)
          terms.terms_of_programs_follow();
        kinds[k]->add_to(terms, context);
      }
    return terms;
  }

  ForceTerms
  ForceParameters::make_for_modes(const ForceContext &context) const
  {
    ForceTerms terms(context.discretization);
    for (const auto &kind : kinds)
      {
        const auto given = kind->given();
        if (std::any_of(given.begin(), given.end(), [](const auto &entry) {
              return entry.in_modes;
            }))
          kind->add_to(terms, context);
      }
    terms.leave_out_damping();
    return terms;
  }
} // namespace corotet
