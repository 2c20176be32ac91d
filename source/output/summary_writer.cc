// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>
#include <corotet/base/mpi.h>
#include <corotet/base/version.h>
#include <corotet/base/whole_file.h>
#include <corotet/output/summary_writer.h>

#include <deal.II/base/config.h>

#include <nlohmann/json.hpp>

#include <cstdint>

namespace corotet
{
  namespace
  {
    nlohmann::ordered_json
    summary_object(const RunSummary             &summary,
                   const nlohmann::ordered_json &results,
                   const std::uint64_t           peak_memory_bytes)
    {
      nlohmann::ordered_json object;
      object["status"] = summary.status;
      if (!summary.message.empty())
        object["message"] = summary.message;
      object["version"]        = version;
      object["git_revision"]   = git_revision;
      object["dealii_version"] = DEAL_II_PACKAGE_VERSION;
      object["ranks"]          = summary.ranks;
      object["cells"]          = summary.cells;
      object["nodes"]          = summary.nodes;
      object["dofs"]           = summary.unknowns;
      object["degree"]         = summary.degree;
      object["mesh_volume"]    = summary.mesh_volume;
      object["total_mass"]     = summary.total_mass;
      object.update(results);
      object["wall_time"]         = {{"setup", summary.wall_times.setup},
                                     {"read", summary.wall_times.read},
                                     {"partition", summary.wall_times.partition},
                                     {"assembly", summary.wall_times.assembly},
                                     {"solve", summary.wall_times.solve},
                                     {"output", summary.wall_times.output},
                                     {"total", summary.total_wall_time}};
      object["peak_memory_bytes"] = peak_memory_bytes;
      return object;
    }

    nlohmann::ordered_json
    norms_object(const FieldNorms &norms)
    {
      return {{"L2", norms.L2}, {"H1", norms.H1}, {"energy", norms.energy}};
    }
  } // namespace

  SummaryWriter::SummaryWriter(const std::string   &directory,
                               const HistoryWriter &history,
                               const MPI_Comm       comm,
                               const bool           with_error_estimate)
    : directory(directory)
    , history(history)
    , comm(comm)
    , with_error_estimate(with_error_estimate)
  {}

  void
  SummaryWriter::resume(const Snapshot &state)
  {
    step(state);
  }

  void
  SummaryWriter::step(const Snapshot &state)
  {
    if (state.last)
      save(state);
  }

  void
  SummaryWriter::save(const Snapshot &state)
  {
    if (!with_error_estimate)
      return;
    const StressError &error = state.stress().error();
    error_estimate           = {error.energy_norm, error.relative()};
  }

  void
  SummaryWriter::finish(const RunSummary &summary)
  {
    nlohmann::ordered_json results;
    results["steps"]                 = summary.steps;
    results["end_time"]              = summary.end_time;
    results["preconditioner_builds"] = summary.preconditioner_builds;
    results["final"]                 = history.last_row();
    if (summary.errors)
      {
        results["errors"]      = norms_object(summary.errors->error);
        results["exact_norms"] = norms_object(summary.errors->reference);
      }
    if (summary.largest_rotation_difference)
      results["largest_rotation_difference"] =
        *summary.largest_rotation_difference;
    if (error_estimate)
      results["error_estimate"] = {{"energy_norm", error_estimate->energy_norm},
                                   {"relative", error_estimate->relative}};
    write_summary(directory, summary, results, comm);
  }

  void
  write_summary(const std::string            &directory,
                const RunSummary             &summary,
                const nlohmann::ordered_json &results,
                const MPI_Comm                comm)
  {
    const std::uint64_t peak = peak_memory(comm);
    on_root(comm, [&] {
      write_json_file(directory + "/summary.json",
                      summary_object(summary, results, peak),
                      "the summary");
    });
  }
} // namespace corotet
