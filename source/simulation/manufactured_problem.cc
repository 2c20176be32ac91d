// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/expression.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>
#include <corotet/forces/body_force.h>
#include <corotet/forces/traction.h>
#include <corotet/simulation/manufactured_problem.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <utility>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  ManufacturedProblem::ManufacturedProblem(
    const SimulationParameters &parameters,
    const bool                  is_used)
    : parameters(parameters)
  {
    const auto &section = parameters.exact_solution;
    if (!is_used || dealii::Utilities::trim(section.displacement).empty())
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
    std::vector<ForceKind::GivenEntry> data{
      {"Boundary conditions/Fixed", conditions.fixed, ""},
      {"Boundary conditions/Displacement", conditions.displacement, ""},
      {"Boundary conditions/Traction", conditions.traction, ""},
      {"Boundary conditions/Pressure", conditions.pressure, ""}};
    for (const auto &[entry, value] :
         {std::pair{"Initial conditions/Displacement",
                    parameters.initial_displacement},
          std::pair{"Initial conditions/Velocity",
                    parameters.initial_velocity}})
      if (!is_zero_expression(value, 3))
        data.push_back({entry, value, "0; 0; 0"});
    for (const ForceKind::GivenEntry &given : parameters.forces.given())
      data.push_back(given);
    for (const ForceKind::GivenEntry &given : data)
      if (dealii::Utilities::trim(given.value) != given.none)
        throw InputError(given.entry,
                         fmt::format("found '{}', but the data are made from "
                                     "the exact solution; allowed: '{}', or "
                                     "Exact solution/Manufacture = false",
                                     shortened(given.value),
                                     given.none));
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
        {
          const std::string entry = "Exact solution/Displacement boundary";
          for (const unsigned int id : boundaries.ids(name, entry))
            if (!ids.insert(id).second)
              refuse_second_boundary(entry, boundaries.name(id));
        }
    return ids;
  }

  BoundaryConditionParameters
  ManufacturedProblem::boundary_conditions(const MeshNames &boundaries) const
  {
    if (!manufacture)
      return parameters.boundary_conditions;
    BoundaryConditionParameters conditions;
    conditions.boundaries_of_solution   = displacement_boundaries(boundaries);
    conditions.displacement_of_solution = exact->displacement_text();
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
    ForceTerms                                      &terms,
    const Discretization                            &discretization,
    const ReferenceElement                          &reference,
    const std::map<unsigned int, IsotropicMaterial> &materials,
    const std::shared_ptr<const MaterialLaw>        &law) const
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
    const MeshNames &boundaries = discretization.mesh().boundaries();
    const std::set<unsigned int> prescribed =
      displacement_boundaries(boundaries);
    std::vector<unsigned int> others{unnamed_boundary};
    for (const auto &[id, name] : boundaries.all())
      if (!prescribed.contains(id))
        others.push_back(id);
    const ExactSolution &solution = *exact;
    const bool           varies   = solution.depends_on_time();
    const bool           with_inertia =
      parameters.time_integrator.selected().is_dynamic();
    terms.add(std::make_unique<BodyForce>(
      discretization,
      reference,
      [=, &solution](const Point<3> &x, const Tensor<1, 3> &, const double t) {
        return solution.body_force(material, *law, with_inertia, x, t);
      },
      varies));
    for (const unsigned int boundary : others)
      terms.add(std::make_unique<Traction>(
        discretization,
        reference,
        boundary,
        [=, &solution](const Point<3>     &x,
                       const Tensor<1, 3> &normal,
                       const double        t) {
          return solution.stress(material, *law, x, t) * normal;
        },
        varies));
  }
} // namespace corotet
