// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/enumeration.h>
#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>
#include <corotet/output/output_parameters.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

namespace corotet
{
  namespace
  {
    // Throws if a column of a probe, NAME_x, would exist twice in the history
    // or in the table of modes.
    void
    check_not_taken(const std::string &entry, const std::string &name)
    {
      const std::array<std::string, 6> taken{{"momentum",
                                              "angular_momentum",
                                              "reaction",
                                              "internal_moment",
                                              "mass_share",
                                              "effective_mass"}};
      if (std::find(taken.begin(), taken.end(), name) != taken.end())
        throw InputError(entry,
                         fmt::format("'{}' cannot be a probe's name; {} are "
                                     "columns of the history or of modes "
                                     "already",
                                     name,
                                     join({taken.begin(), taken.end()})));
      for (const auto &[end, owners] :
           {std::pair{"_reaction", "supports"},
            std::pair{"_reaction_moment", "supports"},
            std::pair{"_contact", "obstacles"}})
        if (name.ends_with(end))
          throw InputError(entry,
                           fmt::format("'{}' cannot be a probe's name; columns "
                                       "of {} end with {}",
                                       name,
                                       owners,
                                       end));
    }

    // Adds a name to @p names; throws if it is there already.
    void
    check_first(const std::string     &entry,
                const std::string     &name,
                const std::string     &what,
                std::set<std::string> &names)
    {
      if (!names.insert(name).second)
        throw InputError(entry,
                         fmt::format("two {} are called '{}'; each name "
                                     "must be used once",
                                     what,
                                     shortened(name)));
    }

    std::vector<ProbePoint>
    parse_probes(const std::string &entry, const std::string &probes)
    {
      std::vector<ProbePoint> points;
      std::set<std::string>   names;
      for (const auto &[name, place] : named_values(
             probes, entry, "a list of NAME: X Y Z, separated by commas"))
        {
          check_column_name(entry, name, "a probe");
          check_first(entry, name, "probes", names);
          const auto position = point_of(place);
          if (!position)
            throw InputError(entry,
                             fmt::format("probe '{}' is at '{}'; its position "
                                         "must be three numbers (x y z, in m)",
                                         shortened(name),
                                         shortened(place)));
          points.push_back({name, *position});
        }
      return points;
    }
  } // namespace

  void
  OutputParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "Directory",
      directory,
      "Directory for the results, relative to the current folder. Empty: "
      "output/NAME for the parameter file NAME.prm.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "Overwrite",
      overwrite,
      "Whether the results of an earlier run in the directory are removed. If "
      "not, a directory that is not empty is refused; so is, in any case, one "
      "that holds anything but results.");
    prm.add_parameter(
      "Time between results",
      time_between_results,
      "Simulated time between two states in solution.vtkhdf [s]; 0: as "
      "'States' says. The first and, unless stopped, the last state are there.",
      dealii::Patterns::Double(0));
    prm.add_parameter(
      "States",
      n_states,
      "About how many states solution.vtkhdf has if 'Time between results' is "
      "0, at equal distances in time [-]. They are taken at ends of steps, "
      "which do not change for them; a run with fewer steps has one of every "
      "step. 0: one of every step.",
      dealii::Patterns::Integer(0));
    prm.add_parameter(
      "Steps between rows",
      steps_between_rows,
      "Number of steps from one row of history.csv to the next [-]; only steps "
      "with a row may have a state in solution.vtkhdf. Increase it for "
      "explicit runs, whose steps are many. The last step, and those that "
      "reach a multiple of 'Time between results', have a row in any case.",
      dealii::Patterns::Integer(1));
    prm.add_parameter(
      "Probes",
      probes,
      "Points of the undeformed body [m] whose displacement goes into "
      "history.csv: NAME: X Y Z, separated by commas, for example 'tip: 1 0.05 "
      "0.05, middle: 0.5 0.05 0.05'. A point slightly outside the cells, as on "
      "a curved surface, is moved to their nearest point, as the log says.",
      dealii::Patterns::Anything());
    add_enumeration<StressOutput>(
      prm,
      "Stress",
      stress,
      {{"none", StressOutput::none},
       {"nodes", StressOutput::nodes},
       {"quadrature points", StressOutput::quadrature_points},
       {"both", StressOutput::both}},
      "Where stress and strain are written [-]: 'none', nowhere; 'nodes', "
      "recovered (smoothed), with the estimated error of each cell, in "
      "solution.vtkhdf; 'quadrature points', as computed, in "
      "stress_points.vtkhdf; 'both'. They make results some times larger.");
    prm.add_parameter(
      "Stress probes",
      stress_probes,
      "Points of the undeformed body [m] whose stress goes into history.csv; "
      "written like 'Probes'.",
      dealii::Patterns::Anything());
    add_enumeration<bool>(
      prm,
      "Stress at probes",
      raw_stress_at_probes,
      {{"recovered", false}, {"raw", true}},
      "Which stress 'Stress probes' show [-]: 'recovered', smoothed and in "
      "general more accurate; 'raw', that of the displacement in the cell that "
      "has the point. If several cells have it, 'raw' is their mean, or the "
      "mean of the means of each material.");
    prm.add_parameter(
      "Reactions",
      reactions,
      "Supports whose force and moment about the origin on the body go into "
      "history.csv: 'NAME: place, ...', places as in Boundary "
      "conditions/Fixed, for example 'clamp: x-min, rope: x-max & y-max & "
      "z-max'. Nodes that several have in common count for each. What is "
      "fixed or prescribed counts, and springs and dashpots on these boundaries.",
      dealii::Patterns::Anything());
  }

  std::vector<ProbePoint>
  OutputParameters::probe_points() const
  {
    const std::string entry  = "Output/Probes";
    const auto        points = parse_probes(entry, probes);
    for (const ProbePoint &point : points)
      check_not_taken(entry, point.name);
    return points;
  }

  std::vector<ProbePoint>
  OutputParameters::stress_probe_points() const
  {
    return parse_probes("Output/Stress probes", stress_probes);
  }

  std::vector<NamedSupport>
  OutputParameters::supports() const
  {
    const std::string         entry = "Output/Reactions";
    std::vector<NamedSupport> result;
    std::set<std::string>     names;
    for (const auto &[name, places] : named_values(
           reactions,
           entry,
           "a list of NAME: PLACE, separated by commas, each place as in "
           "Boundary conditions/Fixed"))
      {
        check_column_name(entry, name, "a support");
        check_first(entry, name, "supports", names);
        result.push_back({name, places});
      }
    return result;
  }

  std::string
  OutputParameters::directory_of_run(const std::string &parameter_file) const
  {
    if (!directory.empty())
      return directory;
    return "output/" + std::filesystem::path(parameter_file).stem().string();
  }
} // namespace corotet
