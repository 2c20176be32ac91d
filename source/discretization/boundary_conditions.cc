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
      "Boundaries that do not move: 'name, name'. 'name & name' "
      "is the edge where two meet, a third name makes it a "
      "corner.");
    prm.add_parameter(
      "Displacement",
      displacement,
      "Displacement [m] of boundaries: 'name: x; y; z, name: x; y; z', each "
      "component an expression in x, y, z, t or 'free'; edges and corners as "
      "in Fixed. Supports move with the expression's own velocity and "
      "acceleration, its exact derivatives; at a kink those of what follows. "
      "Let it have none, like smooth_step and cubic tables that begin and end "
      "at rest.");
    prm.add_parameter(
      "Traction",
      traction,
      "Dead traction [Pa], force per area at rest: 'name: x; y; z, ...', "
      "expressions in x, y, z, t.");
    prm.add_parameter(
      "Pressure",
      pressure,
      "Pressure [Pa] that follows the moving surface (with linear elasticity: "
      "that acts on the surface at rest), positive into the body: 'name: p, "
      "...', expressions in x, y, z, t.");
  }

  BoundaryConditions::BoundaryConditions(
    const BoundaryConditionParameters &parameters,
    const MeshNames                   &boundaries,
    const TableFunctions              &tables)
    : names(boundaries)
  {
    std::string entry = section + "Fixed";
    if (!dealii::Utilities::trim(parameters.fixed).empty())
      for (const std::string &name :
           split_outside_brackets(parameters.fixed, ','))
        {
          Displacement condition{find(name, entry), {}, entry};
          for (unsigned int a = 0; a < 3; ++a)
            {
              claim(condition.boundaries, a, entry);
              condition.components[a].emplace("0", 1, entry);
            }
          displacements.push_back(condition);
        }

    entry = section + "Displacement";
    for (const auto &[name, value] :
         named_values(parameters.displacement, entry))
      {
        Displacement                   condition{find(name, entry), {}, entry};
        const std::vector<std::string> components =
          split_outside_brackets(value, ';');
        if (components.size() != 3)
          throw InputError(entry,
                           fmt::format("found {} components for boundary "
                                       "'{}'; allowed: 'x; y; z', three "
                                       "expressions or 'free'",
                                       components.size(),
                                       name));
        for (unsigned int a = 0; a < 3; ++a)
          if (components[a] != "free")
            {
              claim(condition.boundaries, a, entry);
              condition.components[a].emplace(components[a], 1, entry, tables);
            }
        displacements.push_back(condition);
      }

    entry = section + "Traction";
    for (const auto &[name, value] : named_values(parameters.traction, entry))
      {
        add(tractions, name, Expression(value, 3, entry, tables), entry);
        const auto components = split_outside_brackets(value, ';');
        for (unsigned int a = 0; a < 3; ++a)
          if (!Expression(components[a], 1, entry, tables).is_zero())
            claim(find(name, entry), a, entry);
      }

    entry = section + "Pressure";
    for (const auto &[name, value] : named_values(parameters.pressure, entry))
      {
        add(pressures, name, Expression(value, 1, entry, tables), entry);
        for (unsigned int a = 0; a < 3; ++a)
          claim(find(name, entry), a, entry);
      }
  }

  std::string
  BoundaryConditions::name(
    const std::set<std::vector<unsigned int>> &boundaries) const
  {
    std::vector<std::string> words;
    for (const std::vector<unsigned int> &boundary : boundaries)
      words.push_back(names.name(boundary));
    return join(words, " & ");
  }

  std::set<std::vector<unsigned int>>
  BoundaryConditions::find(const std::string &text,
                           const std::string &entry) const
  {
    std::set<std::vector<unsigned int>> boundaries;
    for (const std::string &name : split_outside_brackets(text, '&'))
      boundaries.insert(names.ids(dealii::Utilities::trim(name), entry));
    return boundaries;
  }

  void
  BoundaryConditions::add(std::vector<SurfaceLoad> &loads,
                          const std::string        &name,
                          const Expression         &value,
                          const std::string        &entry) const
  {
    for (const unsigned int boundary : names.ids(name, entry))
      {
        for (const SurfaceLoad &other : loads)
          if (other.boundary == boundary)
            refuse_second_boundary(entry, names.name(boundary));
        loads.push_back({boundary, value});
      }
  }

  void
  BoundaryConditions::claim(
    const std::set<std::vector<unsigned int>> &boundaries,
    const unsigned int                         component,
    const std::string                         &entry)
  {
    if (boundaries.size() == 1 && boundaries.begin()->size() > 1)
      {
        for (const unsigned int id : *boundaries.begin())
          claim({{id}}, component, entry);
        return;
      }
    std::string &owner = claims[boundaries][component];
    if (!owner.empty())
      throw InputError(
        entry,
        fmt::format("component {} of boundary '{}' has two conditions: found "
                    "'{}' and '{}', allowed is one",
                    "xyz"[component],
                    name(boundaries),
                    owner.substr(section.size()),
                    entry.substr(section.size())));
    owner = entry;
  }
} // namespace corotet
