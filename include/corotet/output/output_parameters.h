// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_output_parameters_h
#define corotet_output_output_parameters_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace corotet
{
  /**
   * A point of the undeformed body [m] whose displacement or stress goes into
   * the history.
   */
  struct ProbePoint
  {
    std::string      name;
    dealii::Point<3> position;
  };

  /**
   * Boundaries, edges and corners, 'name' or 'name & name', whose reaction goes
   * into the history.
   */
  struct NamedSupport
  {
    std::string name;
    std::string places;
  };

  template <typename Named>
  std::vector<std::string>
  names_of(const std::vector<Named> &list)
  {
    std::vector<std::string> names;
    for (const Named &named : list)
      names.push_back(named.name);
    return names;
  }

  /// The places where stress and strain are written.
  enum class StressOutput
  {
    none,
    nodes,
    quadrature_points,
    both
  };

  /**
   * The parameters of section Output.
   */
  struct OutputParameters
  {
    /// Declares the entries in the section that @p prm is in.
    void
    declare_parameters(dealii::ParameterHandler &prm);

    /**
     * The points of entry Probes. Names are unique, consist of letters, digits
     * and underscores (no digit first) and differ from the history's own
     * columns. Throws InputError.
     */
    std::vector<ProbePoint>
    probe_points() const;

    /// The points of entry Stress probes, with the same rules, except that
    /// names may be those of the history's own columns.
    std::vector<ProbePoint>
    stress_probe_points() const;

    /// The supports of entry Reactions, with names of the same kind. Throws
    /// InputError.
    std::vector<NamedSupport>
    supports() const;

    /// Whether stress is written at the nodes, with the estimate of its error.
    bool
    has_stress_at_nodes() const
    {
      return stress == StressOutput::nodes || stress == StressOutput::both;
    }

    /// Whether stress is written at quadrature points.
    bool
    has_stress_at_points() const
    {
      return stress == StressOutput::quadrature_points ||
             stress == StressOutput::both;
    }

    /**
     * The output directory of a run of @p parameter_file: as set, or
     * output/STEM, both relative to the current folder.
     */
    std::string
    directory_of_run(const std::string &parameter_file) const;

    /// The simulated time between two states of a run of so many seconds [s];
    /// 0: every step has a state.
    double
    time_between_states(const double duration) const
    {
      if (time_between_results > 0 || n_states == 0)
        return time_between_results;
      return duration / n_states;
    }

    std::string directory;
    bool        overwrite = false;
    /// The simulated time between results [s]; 0: it follows from n_states.
    double       time_between_results = 0;
    unsigned int n_states             = 200;
    unsigned int steps_between_rows   = 1;
    std::string  probes;
    StressOutput stress = StressOutput::none;
    std::string  stress_probes;
    /// Whether probes show the raw stress instead of the recovered one.
    bool        raw_stress_at_probes = false;
    std::string reactions;
  };
} // namespace corotet

#endif
