// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>
#include <corotet/discretization/boundary_conditions.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <set>

namespace corotet
{
  namespace
  {
    const std::string section = "Boundary conditions/";
  } // namespace

  void
  BoundaryConditionParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "Fixed",
      fixed,
      "Boundaries, edges and corners that do not move: 'name, name'. 'name & "
      "name' is what both have in common: two boundaries an edge, with a third "
      "name a corner, an edge and a boundary points.");
    prm.add_parameter(
      "Displacement",
      displacement,
      "Prescribed displacement [m] of boundaries: 'name: x; y; z, name: x; y; "
      "z', each component an expression in x, y, z, t or 'free'; of edges and "
      "corners as in Fixed. At a node of several of them, a component that one "
      "leaves free is prescribed by another; if several prescribe it, their "
      "values must be equal. The velocity and acceleration of supports are the "
      "exact time derivatives of the expression, at a kink those of what "
      "follows. Avoid kinks: smooth_step has none, nor have cubic tables that "
      "begin and end at rest.");
    prm.add_parameter(
      "Traction",
      traction,
      "Traction of fixed direction (dead load), force per area at rest [Pa], "
      "on boundaries: 'name: x; y; z, ...', expressions in x, y, z, t.");
    prm.add_parameter(
      "Pressure",
      pressure,
      "Pressure [Pa] that follows the moving surface (with linear elasticity: "
      "that acts on the surface at rest), positive into the body: 'name: p, "
      "...', expressions in x, y, z, t.");
  }

  BoundaryConditions::BoundaryConditions(
    const BoundaryConditionParameters &parameters,
    const PlaceNames                  &names,
    const TableFunctions              &tables)
    : names(names)
  {
    std::string entry = section + "Fixed";
    if (!dealii::Utilities::trim(parameters.fixed).empty())
      for (const std::string &name :
           split_outside_brackets(parameters.fixed, ','))
        {
          Displacement condition{find(name, entry), {}, entry};
          for (unsigned int a = 0; a < 3; ++a)
            {
              claim(condition.places, a, entry);
              condition.components[a].emplace("0", 1, entry);
            }
          displacements.push_back(condition);
        }

    entry = section + "Displacement";
    for (const auto &[name, value] :
         named_values(parameters.displacement, entry))
      prescribe(find(name, entry), name, value, tables);
    for (const unsigned int id : parameters.boundaries_of_solution)
      prescribe({Place{{id}, {}, {}}},
                names.boundaries.name(id),
                parameters.displacement_of_solution,
                tables);

    entry = section + "Traction";
    for (const auto &[name, value] : named_values(parameters.traction, entry))
      {
        add(tractions,
            "a traction",
            name,
            Expression(value, 3, entry, tables),
            entry);
        const auto components = split_outside_brackets(value, ';');
        for (unsigned int a = 0; a < 3; ++a)
          if (!Expression(components[a], 1, entry, tables).is_zero())
            claim(
              {Place{names.boundary_ids(name, entry, "a traction"), {}, {}}},
              a,
              entry);
      }

    entry = section + "Pressure";
    for (const auto &[name, value] : named_values(parameters.pressure, entry))
      {
        add(pressures,
            "a pressure",
            name,
            Expression(value, 1, entry, tables),
            entry);
        for (unsigned int a = 0; a < 3; ++a)
          claim({Place{names.boundary_ids(name, entry, "a pressure"), {}, {}}},
                a,
                entry);
      }
  }

  void
  BoundaryConditions::prescribe(const std::set<Place> &places,
                                const std::string     &name,
                                const std::string     &value,
                                const TableFunctions  &tables)
  {
    const std::string              entry = section + "Displacement";
    Displacement                   condition{places, {}, entry};
    const std::vector<std::string> components =
      split_outside_brackets(value, ';');
    if (components.size() != 3)
      throw InputError(entry,
                       fmt::format("found {} components for {} '{}'; "
                                   "allowed: 'x; y; z', three "
                                   "expressions or 'free'",
                                   components.size(),
                                   kind(places),
                                   name));
    for (unsigned int a = 0; a < 3; ++a)
      if (components[a] != "free")
        {
          claim(places, a, entry);
          condition.components[a].emplace(components[a], 1, entry, tables);
        }
    displacements.push_back(condition);
  }

  std::string
  BoundaryConditions::name(const std::set<Place> &places) const
  {
    std::vector<std::string> words;
    for (const Place &place : places)
      words.push_back(names.name(place));
    return join(words, " & ");
  }

  std::string
  BoundaryConditions::kind(const std::set<Place> &places)
  {
    std::set<std::string> kinds;
    for (const Place &place : places)
      kinds.insert(PlaceNames::kind(place));
    return kinds.size() == 1 ? *kinds.begin() : "place";
  }

  std::set<Place>
  BoundaryConditions::find(const std::string &text,
                           const std::string &entry) const
  {
    std::set<Place> places;
    for (const std::string &name : split_outside_brackets(text, '&'))
      places.insert(names.find(dealii::Utilities::trim(name), entry));
    return places;
  }

  void
  BoundaryConditions::add(std::vector<SurfaceLoad> &loads,
                          const std::string        &what,
                          const std::string        &name,
                          const Expression         &value,
                          const std::string        &entry) const
  {
    for (const unsigned int boundary : names.boundary_ids(name, entry, what))
      {
        for (const SurfaceLoad &other : loads)
          if (other.boundary == boundary)
            refuse_second_boundary(entry, names.boundaries.name(boundary));
        loads.push_back({boundary, value});
      }
  }

  void
  BoundaryConditions::claim(const std::set<Place> &places,
                            const unsigned int     component,
                            const std::string     &entry)
  {
    if (places.size() == 1)
      {
        const auto &[boundaries, edges, corners] = *places.begin();
        if (boundaries.size() + edges.size() + corners.size() > 1)
          {
            for (const unsigned int id : boundaries)
              claim({Place{{id}, {}, {}}}, component, entry);
            for (const unsigned int id : edges)
              claim({Place{{}, {id}, {}}}, component, entry);
            for (const unsigned int id : corners)
              claim({Place{{}, {}, {id}}}, component, entry);
            return;
          }
      }
    std::string &owner = claims[places][component];
    if (!owner.empty())
      throw InputError(
        entry,
        fmt::format("component {} of {} '{}' has two conditions: found '{}' "
                    "and '{}', allowed is one",
                    "xyz"[component],
                    kind(places),
                    name(places),
                    owner.substr(section.size()),
                    entry.substr(section.size())));
    owner = entry;
  }
} // namespace corotet
