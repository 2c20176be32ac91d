// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "earlier_run.h"

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/output/checkpoints.h>
#include <corotet/studies/run_parameters.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace corotet
{
  namespace
  {
    namespace fs = std::filesystem;
    using Json   = nlohmann::ordered_json;

    // Removes folders: "f: ../tables/f.csv, g: g.csv" becomes "f: f.csv, g:
    // g.csv".
    std::string
    without_folders(const std::string &files)
    {
      using dealii::Utilities::split_string_list;
      std::string result;
      for (const std::string &item : split_string_list(files, ','))
        {
          std::vector<std::string> parts = split_string_list(item, ':');
          parts.back() = fs::path(parts.back()).filename().string();
          result += result.empty() ? "" : ", ";
          for (const std::string &part : parts)
            result += (&part == &parts.front() ? "" : ": ") + part;
        }
      return result;
    }

    // The first changed file name among those that restarts from a checkpoint
    // do not compare, since checkpoints have checksums: the mesh's file, if it
    // has one, and those of tables.
    std::optional<ChangedEntry>
    changed_file(const Json &before, const Json &now)
    {
      std::vector<std::vector<std::string>> entries = {{"Tables", "Linear"},
                                                       {"Tables", "Cubic"}};
      const std::string type = now.at("Mesh").at("Type").get<std::string>();
      if (now.at("Mesh").contains(type) &&
          now.at("Mesh").at(type).contains("File"))
        entries.push_back({"Mesh", type, "File"});
      for (const std::vector<std::string> &path : entries)
        {
          const Json *old_node = &before, *new_node = &now;
          std::string entry;
          for (const std::string &name : path)
            {
              old_node = &old_node->at(name);
              new_node = &new_node->at(name);
              entry += (entry.empty() ? "" : "/") + name;
            }
          const std::string old_files = old_node->get<std::string>();
          const std::string new_files = new_node->get<std::string>();
          if (without_folders(old_files) != without_folders(new_files))
            return ChangedEntry{entry, new_files, old_files};
        }
      return std::nullopt;
    }

    std::optional<ChangedEntry>
    change_since(Json before, Json now)
    {
      const std::string study = "Convergence study";
      // Other entries of the section may differ.
      const Json old_run = before.at(study).at("Run"),
                 new_run = now.at(study).at("Run");
      if (now.at("Type") == "convergence study")
        for (Json *const entries : {&before, &now})
          {
            entries->erase("Output");
            entries->at("Discretization").erase("Degree");
            entries->at("Mesh").erase("Refinements");
          }
      if (const auto change = forbidden_change(before, now))
        return change;
      if (now.at("Type") == "convergence study" && old_run != new_run)
        return ChangedEntry{study + "/Run", new_run, old_run};
      return changed_file(before, now);
    }
  } // namespace

  std::optional<OtherRun>
  other_run_in(const std::string   &directory,
               const ParameterFile &file,
               const MPI_Comm       comm)
  {
    const std::string path     = directory + "/parameters.prm";
    const bool        is_known = from_root(comm, [&] {
      // A loss of power may leave an empty file.
      std::error_code error;
      const auto      size = fs::file_size(path, error);
      return !error && size > 0;
    });
    if (!is_known)
      return std::nullopt;
    const std::string allowed = "allowed: another directory, or "
                                "Output/Overwrite = true to begin anew";
    ParameterFile     earlier;
    RunParameters     parameters;
    parameters.declare_parameters(earlier.handler());
    try
      {
        earlier.read(path, {}, comm);
      }
    catch (const InputError &error)
      {
        return OtherRun{"Output/Directory",
                        fmt::format("--restart: found results in '{}' whose "
                                    "parameters this program cannot read ({}); "
                                    "{}",
                                    directory,
                                    error.what(),
                                    allowed)};
      }
    const auto change = change_since(earlier.values(), file.values());
    if (!change)
      return std::nullopt;
    return OtherRun{change->entry,
                    fmt::format("--restart: found '{}', but in '{}' are "
                                "results of another run, with '{}'; {}",
                                change->now,
                                directory,
                                change->before,
                                allowed)};
  }

  void
  check_new_beginning(const std::string   &directory,
                      const ParameterFile &file,
                      const bool           has_checkpoints,
                      const MPI_Comm       comm)
  {
    if (has_checkpoints)
      throw InputError("Output/Directory",
                       "--restart: none of the checkpoints in '" + directory +
                         "' can be gone on from; allowed: the program that "
                         "wrote them, another directory, or "
                         "Output/Overwrite = true to begin anew");
    if (holds_any(directory,
                  {"summary.json", "modes.csv", "study.csv", "rows"},
                  comm))
      throw InputError("Output/Directory",
                       "--restart: found the results of a run that has "
                       "ended in '" +
                         directory +
                         "', and no checkpoint to go on from; allowed: "
                         "another directory, or Output/Overwrite = true "
                         "to begin anew");
    if (const auto other = other_run_in(directory, file, comm))
      throw InputError(other->entry, other->message);
  }

  bool
  holds_any(const std::string              &directory,
            const std::vector<std::string> &names,
            const MPI_Comm                  comm)
  {
    return from_root(comm, [&] {
      return std::any_of(names.begin(),
                         names.end(),
                         [&](const std::string &name) {
                           return fs::exists(directory + "/" + name);
                         });
    });
  }
} // namespace corotet
