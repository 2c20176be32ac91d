// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/unused_entries.h>
#include <corotet/studies/unused_parameters.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace corotet
{
  std::vector<std::string>
  unused_parameters(const ParameterFile &file, const RunParameters &parameters)
  {
    std::vector<std::string> used;
    // The solver 'automatic' uses these sections, as its description says.
    const nlohmann::ordered_json values = file.values();
    const auto                  &solver = values.at("Linear solver");
    if (solver.at("Type") == "automatic")
      used.emplace_back("Linear solver/p-multigrid");
    const auto &multigrid = solver.at("p-multigrid");
    const bool  is_multigrid =
      solver.at("Type") == "automatic" || solver.at("Type") == "p-multigrid";
    const bool is_amg_coarse = multigrid.at("Coarse solver") == "amg";
    if (is_amg_coarse)
      used.emplace_back("Linear solver/amg");
    const RunType type              = parameters.simulation.type;
    const bool    is_study_of_modes = type == RunType::convergence_study &&
                                   parameters.study.run == RunType::modes;
    if (is_study_of_modes)
      used.emplace_back("Modes");
    std::vector<std::string> lines = find_unused_entries(file, used);
    const auto note = [&](const std::string &entry, const std::string &choice) {
      if (std::string line = unused_entry(file, entry, choice); !line.empty())
        lines.push_back(std::move(line));
    };
    if (is_multigrid && is_amg_coarse &&
        multigrid.at("Vertex rotations") == "true")
      note("Linear solver/p-multigrid/Vertex rotations",
           "Linear solver/p-multigrid/Coarse solver");
    if (values.at("Material").at("Type") != "corotational")
      note("Material/Rotation", "Material/Type");
    const auto       &steps    = values.at("Time integration");
    const std::string adaptive = "Time integration/Adaptive step/";
    if (steps.at("Type") == "static")
      note("Time integration/Time step", "Time integration/Type");
    if (steps.at("Adaptive step").at("Enabled") == "false")
      for (const char *entry :
           {"Target error", "Smallest step", "Largest step"})
        note(adaptive + entry, adaptive + "Enabled");
    const auto &contact = values.at("Contact");
    if (contact.at("Obstacles").get<std::string>().empty())
      note("Contact/Boundaries", "Contact/Obstacles");
    if (contact.at("Friction").get<std::string>().empty())
      note("Contact/Slip velocity", "Contact/Friction");
    if (values.at("Output").at("Stress probes").get<std::string>().empty())
      note("Output/Stress at probes", "Output/Stress probes");
    if (type == RunType::convergence_study &&
        values.at("Convergence study").at("Reference") != "finer run")
      note("Convergence study/Further refinements",
           "Convergence study/Reference");
    if (type == RunType::convergence_study)
      {
        const std::string study = "Convergence study/";
        if (is_study_of_modes)
          note(study + "Time steps", study + "Run");
        else if (steps.at("Type") == "static")
          note(study + "Time steps", "Time integration/Type");
        else if (steps.at("Adaptive step").at("Enabled") == "true")
          note(study + "Time steps", adaptive + "Enabled");
        if (values.at("Material").at("Type") != "corotational")
          note(study + "Rotations", "Material/Type");
      }
    const auto note_of_modes = [&](const std::string &entry) {
      lines.push_back(file.location(entry) + ": no effect on modes: \"" +
                      entry + "\"");
    };
    if (type == RunType::modes && parameters.checkpoint.wall_time_limit > 0)
      note_of_modes("Checkpoint/Wall time limit");
    if (type == RunType::modes && !parameters.output.reactions.empty())
      note_of_modes("Output/Reactions");
    return lines;
  }

  bool
  has_unused_density(const ParameterFile        &file,
                     const SimulationParameters &parameters)
  {
    if (!file.is_set("Material/Density") || parameters.type == RunType::modes ||
        parameters.time_integrator.selected().is_dynamic())
      return false;
    const auto given = parameters.forces.given();
    return std::none_of(given.begin(), given.end(), [](const auto &entry) {
      return entry.on_mass;
    });
  }
} // namespace corotet
