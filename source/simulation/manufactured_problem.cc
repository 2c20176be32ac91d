// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/triangulation.h>
#include <corotet/simulation/manufactured_problem.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

namespace corotet
{
  ManufacturedProblem::ManufacturedProblem(
    const SimulationParameters &parameters)
    : parameters(parameters)
    , manufacture(false)
  {
    const auto &section = parameters.exact_solution;
    if (dealii::Utilities::trim(section.displacement).empty())
      return;
    exact       = std::make_unique<ExactSolution>(section.displacement);
    manufacture = section.manufacture;
    if (manufacture)
      refuse_given_data();
  }

  void
  ManufacturedProblem::refuse_given_data() const
  {
    const BoundaryConditionParameters &conditions =
      parameters.boundary_conditions;
    const std::string zero = LoadParameters().gravity;
    const struct
    {
      std::string entry, value, allowed;
    } data[] = {
      {"Boundary conditions/Fixed", conditions.fixed, ""},
      {"Boundary conditions/Displacement", conditions.displacement, ""},
      {"Boundary conditions/Traction", conditions.traction, ""},
      {"Boundary conditions/Pressure", conditions.pressure, ""},
      {"Loads/Gravity", parameters.loads.gravity, zero},
      {"Loads/Body force", parameters.loads.body_force, zero},
      {"Loads/Point forces", parameters.loads.point_forces, ""},
      {"Initial conditions/Displacement",
       parameters.initial_displacement,
       zero},
      {"Initial conditions/Velocity", parameters.initial_velocity, zero}};
    for (const auto &[entry, value, allowed] : data)
      if (dealii::Utilities::trim(value) != allowed)
        throw InputError(entry,
                         fmt::format("found '{}', but the data are made from "
                                     "the exact solution; allowed: '{}', or "
                                     "Exact solution/Manufacture = false",
                                     value,
                                     allowed));
    const RayleighDamping damping = parameters.damping.coefficients();
    if (damping.mass > 0 || damping.stiffness > 0)
      throw InputError("Damping",
                       "found a damped body; data can be made from the exact "
                       "solution of undamped ones only");
  }

  std::set<unsigned int>
  ManufacturedProblem::displacement_boundaries(
    const MeshNames &boundaries) const
  {
    const std::string &text = parameters.exact_solution.displacement_boundary;
    std::set<unsigned int> ids;
    if (text == "all")
      for (const auto &[id, name] : boundaries.all())
        ids.insert(id);
    else if (text != "none")
      for (const std::string &name : split_outside_brackets(text, ','))
        ids.insert(boundaries.id(name, "Exact solution/Displacement boundary"));
    return ids;
  }

  BoundaryConditionParameters
  ManufacturedProblem::boundary_conditions(const MeshNames &boundaries) const
  {
    if (!manufacture)
      return parameters.boundary_conditions;
    std::vector<std::string> items;
    for (const unsigned int id : displacement_boundaries(boundaries))
      items.push_back(fmt::format("{}: {}", id, exact->displacement_text()));
    BoundaryConditionParameters conditions;
    conditions.displacement = join(items);
    return conditions;
  }

  std::string
  ManufacturedProblem::initial_displacement() const
  {
    return manufacture ? exact->displacement_text() :
                         parameters.initial_displacement;
  }

  std::string
  ManufacturedProblem::initial_velocity() const
  {
    return manufacture ? exact->velocity_text() : parameters.initial_velocity;
  }

  void
  ManufacturedProblem::add_to(
    Loads                                           &loads,
    const MeshNames                                 &boundaries,
    const std::map<unsigned int, IsotropicMaterial> &materials) const
  {
    if (!manufacture)
      return;
    const IsotropicMaterial &material = materials.begin()->second;
    for (const auto &[region, other] : materials)
      if (other.lambda != material.lambda || other.mu != material.mu ||
          other.density != material.density)
        throw InputError("Exact solution/Displacement",
                         "the regions have different materials; data can be "
                         "made for a body of one material only");
    const std::set<unsigned int> prescribed =
      displacement_boundaries(boundaries);
    std::vector<unsigned int> others{unnamed_boundary};
    for (const auto &[id, name] : boundaries.all())
      if (prescribed.count(id) == 0)
        others.push_back(id);
    loads.add_manufactured(*exact,
                           material,
                           parameters.material.rotation_placement() ==
                             Rotation::none,
                           parameters.time_integrator.selected().is_dynamic(),
                           others);
  }
} // namespace corotet
