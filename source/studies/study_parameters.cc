// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>
#include <corotet/studies/study_parameters.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  namespace
  {
    const std::string section = "Convergence study/";

    // The largest number of runs, far more than anybody waits for.
    constexpr double max_cases = 10000;

    // All values, or one empty value, which stands for that of the parameter
    // file.
    template <typename T>
    std::vector<std::optional<T>>
    choices(const std::vector<T> &values)
    {
      if (values.empty())
        return {std::nullopt};
      return {values.begin(), values.end()};
    }
  } // namespace

  std::string
  StudyCase::name() const
  {
    std::string name =
      fmt::format("degree_{}_refinements_{}", degree, refinements);
    if (time_step)
      name += fmt::format("_time_step_{}", *time_step);
    for (const auto &word : {mass, rotation})
      if (word)
        name += "_" + *word;
    std::replace(name.begin(), name.end(), ' ', '_');
    name.erase(std::remove(name.begin(), name.end(), ','), name.end());
    return name;
  }

  std::vector<std::string>
  StudyCase::overrides() const
  {
    std::vector<std::string> result = {
      fmt::format("Discretization/Degree = {}", degree),
      fmt::format("Mesh/Refinements = {}", refinements)};
    if (time_step)
      result.push_back(
        fmt::format("Time integration/Time step = {}", *time_step));
    if (mass)
      result.push_back("Discretization/Mass = " + *mass);
    if (rotation)
      result.push_back("Material/Rotation = " + *rotation);
    return result;
  }

  void
  StudyParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    add_enumeration<RunType>(prm,
                             "Run",
                             run,
                             {{"simulation", RunType::simulation},
                              {"modes", RunType::modes}},
                             "What is run with all combinations of the values "
                             "below: 'simulation' or 'modes', as in Type.");
    prm.add_parameter("Degrees",
                      degrees,
                      "Values of Discretization/Degree.",
                      List(Integer(1, 3), 1));
    prm.add_parameter("Refinements",
                      refinements,
                      "Values of Mesh/Refinements, increasing.",
                      List(Integer(0, 9), 1));
    prm.add_parameter("Time steps",
                      time_steps,
                      "Values of Time integration/Time step [s], decreasing. "
                      "Empty: that of the file.",
                      List(Double(0)));
    prm.add_parameter("Masses",
                      masses,
                      "Values of Discretization/Mass. Empty: that of the file.",
                      List(selection(mass_types)));
    prm.add_parameter(
      "Rotations",
      rotations,
      "Values of Material/Rotation, separated by semicolons. Empty: that of "
      "the file.",
      List(selection(corotet::rotations), 0, List::max_int_value, ";"));
    add_enumeration(
      prm,
      "Reference",
      reference,
      study_references,
      "What the fields of the runs are compared with: 'exact solution', that "
      "of section Exact solution; 'finer run', a run of the highest degree on "
      "the finest mesh, refined further, with the shortest time step, or a "
      "quarter of it if 'Time steps' has several values; 'none', nothing: only "
      "Quantities are compared.");
    prm.add_parameter("Further refinements",
                      further_refinements,
                      "Number of refinements that the finer run of 'Reference' "
                      "has beyond the largest of 'Refinements' [-]. 0 is "
                      "allowed only with several 'Time steps' of a simulation "
                      "with steps of given length: else a run would be "
                      "compared with itself.",
                      Integer(0, 3));
    prm.add_parameter(
      "Quantities",
      quantities,
      "Numbers of each run that are compared: 'name, name: value', where a "
      "name is a column of history.csv, of which the last row counts, or "
      "frequency_1, frequency_2, ... [Hz] of modes, and the value is what it "
      "should be. Without a value it is compared with the finer run, if there "
      "is one.");
    prm.add_parameter("Pictures",
                      pictures,
                      "Whether errors are plotted at the end, by Python and "
                      "matplotlib.");
  }

  std::vector<StudyCase>
  StudyParameters::cases() const
  {
    const auto sorted = [](const auto &values, const auto &before) {
      return std::adjacent_find(values.begin(),
                                values.end(),
                                [&](const auto &a, const auto &b) {
                                  return !before(a, b);
                                }) == values.end();
    };
    if (!sorted(refinements, std::less<>()))
      throw InputError(section + "Refinements",
                       "the values do not increase; each is allowed once");
    if (!sorted(time_steps, std::greater<>()))
      throw InputError(section + "Time steps",
                       "the values do not decrease; each is allowed once");
    if (time_steps.size() > 1 && time_steps.back() == 0)
      throw InputError(section + "Time steps",
                       "found 0 among several; allowed: 0 alone, for the "
                       "step that an explicit integrator chooses, or numbers "
                       "above 0");
    // A floating-point number, which does not overflow.
    const double n_cases = 1. * choices(masses).size() *
                           choices(rotations).size() * degrees.size() *
                           choices(time_steps).size() * refinements.size();
    if (n_cases > max_cases)
      throw InputError(section + "Degrees",
                       fmt::format("found {} runs, one for each combination of "
                                   "values; allowed are {}",
                                   n_cases,
                                   max_cases));
    std::vector<StudyCase> result;
    for (const auto &mass : choices(masses))
      for (const auto &rotation : choices(rotations))
        for (const unsigned int degree : degrees)
          for (const auto &time_step : choices(time_steps))
            for (const unsigned int n : refinements)
              {
                const StudyCase one{degree, n, time_step, mass, rotation};
                if (std::find(result.begin(), result.end(), one) !=
                    result.end())
                  throw InputError(section + "Degrees",
                                   "a value is given twice in Degrees, Masses "
                                   "or Rotations; each is allowed once");
                result.push_back(one);
              }
    return result;
  }

  std::vector<StudyParameters::Quantity>
  StudyParameters::quantity_list() const
  {
    std::vector<Quantity> result;
    for (const auto &[name, value] : names_and_values(quantities))
      {
        Quantity quantity{name, {}};
        try
          {
            if (value)
              quantity.reference = dealii::Utilities::string_to_double(*value);
          }
        catch (const dealii::ExceptionBase &)
          {
            quantity.reference.reset();
          }
        if (name.empty() ||
            (value && !std::isfinite(quantity.reference.value_or(
                        std::numeric_limits<double>::quiet_NaN()))))
          throw InputError(section + "Quantities",
                           fmt::format("found '{}'; allowed: 'name' or 'name: "
                                       "number'",
                                       shortened(value ? name + ": " + *value :
                                                         name)));
        for (const char *const column :
             {"newton_iterations", "linear_iterations", "wall_time"})
          if (name == column)
            throw InputError(section + "Quantities",
                             fmt::format("found '{}', of which every study has "
                                         "a column, for all steps; allowed: "
                                         "other columns of a history",
                                         name));
        for (const Quantity &other : result)
          if (other.name == name)
            throw InputError(section + "Quantities",
                             fmt::format("found '{}' twice; allowed: each "
                                         "quantity once",
                                         shortened(name)));
        result.push_back(quantity);
      }
    return result;
  }
} // namespace corotet
