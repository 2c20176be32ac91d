// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/unused_entries.h>
#include <corotet/studies/unused_parameters.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace corotet
{
  std::vector<std::string>
  unused_parameters(const ParameterFile &file, const RunParameters &parameters)
  {
    std::vector<std::string> used;
    // As its description says.
    const nlohmann::ordered_json solver = file.values().at("Linear solver");
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
    if (is_multigrid && is_amg_coarse &&
        multigrid.at("Vertex rotations") == "true")
      {
        const std::string section = "Linear solver/p-multigrid/",
                          entry   = section + "Vertex rotations";
        lines.push_back(
          fmt::format("{}: no effect, as \"{}Coarse solver\" is 'amg': {}",
                      file.location(entry),
                      section,
                      entry));
      }
    if (type == RunType::modes && parameters.checkpoint.wall_time_limit > 0)
      lines.push_back(file.location("Checkpoint/Wall time limit") +
                      ": no effect on modes: \"Checkpoint/Wall time limit\"");
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
