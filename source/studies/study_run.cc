// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>
#include <corotet/base/text.h>
#include <corotet/output/checkpoints.h>
#include <corotet/output/history_writer.h>
#include <corotet/output/mesh_checksum.h>
#include <corotet/output/table_checksums.h>
#include <corotet/simulation/modal_analysis.h>
#include <corotet/studies/study_run.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace corotet
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    const std::string quantities_entry = "Convergence study/Quantities";

    // Keeps the number of iterations of all steps, and the history's row of the
    // last step.
    class LastRow : public Observer
    {
    public:
      LastRow(const HistoryColumns &columns)
        : columns(columns)
      {}

      void
      start(const Snapshot &initial) override
      {
        step(initial);
      }

      void
      step(const Snapshot &state) override
      {
        newton_iterations += state.record.newton_iterations;
        linear_iterations += state.record.linear_iterations;
        if (!state.last && !row.is_null())
          return;
        row = columns.row(state);
      }

      void
      transfer(Archive &archive) override
      {
        std::string text = row.dump();
        archive.within("study", [&] {
          archive.transfer("row", text);
          archive.transfer("newton_iterations", newton_iterations);
          archive.transfer("linear_iterations", linear_iterations);
        });
        if (archive.is_reading())
          row = Json::parse(text);
      }

      void
      finish(const RunSummary &run_summary) override
      {
        summary = run_summary;
      }

      HistoryColumns columns;
      Json           row;
      RunSummary     summary;
      unsigned int   newton_iterations = 0;
      unsigned int   linear_iterations = 0;
    };

    void
    take(StudyResult &result, const RunSummary &summary)
    {
      result.cells    = summary.cells;
      result.nodes    = summary.nodes;
      result.unknowns = summary.unknowns;
      result.h      = std::cbrt(6 * std::numbers::sqrt2 * summary.mesh_volume /
                           summary.cells);
      result.errors = summary.errors;
      result.steps  = summary.steps;
      result.wall_times      = summary.wall_times;
      result.total_wall_time = summary.total_wall_time;
    }

    Json
    norms_to_json(const FieldNorms &norms)
    {
      return Json::array({norms.L2, norms.H1, norms.energy});
    }

    // The @p entries that a result depends on.
    Json
    compared_entries(Json entries)
    {
      for (const char *const section :
           {"Convergence study", "Verification", "Checkpoint"})
        entries.erase(section);
      Json output;
      for (const char *const entry : {"Probes",
                                      "Stress probes",
                                      "Stress at probes",
                                      "Reactions",
                                      // Steps whose length the run chooses end
                                      // at these times.
                                      "Time between results"})
        output[entry] = entries.at("Output").at(entry);
      entries["Output"] = output;
      return entries;
    }

    FieldNorms
    norms_from_json(const Json &list)
    {
      return {list.at(0), list.at(1), list.at(2)};
    }
  } // namespace

  Json
  result_to_json(const StudyResult &result)
  {
    Json object;
    object["status"]  = result.status;
    object["message"] = result.message;
    object["cells"]   = result.cells;
    object["nodes"]   = result.nodes;
    object["dofs"]    = result.unknowns;
    object["h"]       = result.h;
    if (result.errors)
      {
        object["errors"]    = norms_to_json(result.errors->error);
        object["reference"] = norms_to_json(result.errors->reference);
      }
    // A value that is not a number would be written as null.
    object["quantities"] = Json::array();
    for (const double value : result.quantities)
      object["quantities"].push_back(fmt::format("{}", value));
    object["steps"]             = result.steps;
    object["mean_time_step"]    = result.mean_time_step;
    object["newton_iterations"] = result.newton_iterations;
    object["linear_iterations"] = result.linear_iterations;
    object["wall_times"]        = {result.wall_times.setup,
                                   result.wall_times.assembly,
                                   result.wall_times.solve,
                                   result.wall_times.output,
                                   result.total_wall_time};
    object["peak_memory_bytes"] = result.peak_memory_bytes;
    object["worth_a_look"]      = result.worth_a_look;
    return object;
  }

  StudyResult
  result_from_json(const StudyCase &study_case, const Json &object)
  {
    StudyResult result;
    result.study_case = study_case;
    result.status     = object.at("status");
    result.message    = object.at("message");
    result.cells      = object.at("cells");
    result.nodes      = object.at("nodes");
    result.unknowns   = object.at("dofs");
    result.h          = object.at("h");
    if (object.contains("errors"))
      result.errors = {norms_from_json(object.at("errors")),
                       norms_from_json(object.at("reference"))};
    for (const auto &value : object.at("quantities"))
      result.quantities.push_back(std::stod(value.get<std::string>()));
    result.steps             = object.at("steps");
    result.mean_time_step    = object.at("mean_time_step");
    result.newton_iterations = object.at("newton_iterations");
    result.linear_iterations = object.at("linear_iterations");
    const Json &times        = object.at("wall_times");
    result.wall_times = {times.at(0), times.at(1), times.at(2), times.at(3)};
    result.total_wall_time   = times.at(4);
    result.peak_memory_bytes = object.at("peak_memory_bytes");
    result.worth_a_look      = object.at("worth_a_look");
    return result;
  }

  StudyRun::StudyRun(const std::string              &path,
                     const std::vector<std::string> &overrides,
                     const StudyCase                &study_case,
                     const MPI_Comm                  comm)
    : study_case(study_case)
    , comm(comm)
    , log(comm, /* quiet = */ true)
  {
    parameters.declare_parameters(file.handler());
    std::vector<std::string> all = overrides;
    for (const std::string &text : study_case.overrides())
      all.push_back(text);
    file.read(path, all, comm);
    reset_peak_memory();
    // Checked first, as it may be the reason why supports are missing.
    if (parameters.study.run != RunType::modes &&
        parameters.study.reference == StudyReference::exact_solution &&
        dealii::Utilities::trim(
          parameters.simulation.exact_solution.displacement)
          .empty())
      throw InputError("Convergence study/Reference",
                       "found 'exact solution', but Exact "
                       "solution/Displacement is empty; allowed: 'finer "
                       "run' or 'none', or an exact solution");
    if (parameters.study.run == RunType::modes)
      analysis = std::make_unique<ModalAnalysis>(parameters.simulation,
                                                 file.folder(),
                                                 comm,
                                                 log);
    else
      simulated = std::make_unique<Simulation>(parameters.simulation,
                                               file.folder(),
                                               comm,
                                               log);
    // Checks the columns and the quantities before the work starts.
    if (simulated)
      columns.emplace(parameters.output, *simulated, log);
    pick(simulated ? history_example(parameters.output,
                                     parameters.simulation.forces.obstacles()) :
                     frequencies());
  }

  StudyRun::~StudyRun() = default;

  std::string
  describe(const StudyResult &result, const std::string &log_name)
  {
    std::string text = fmt::format("{} cells, {} unknowns, {:.2f} s",
                                   result.cells,
                                   result.unknowns,
                                   result.total_wall_time);
    if (result.errors)
      text += fmt::format(", L2 error {:.3e}", result.errors->error.L2);
    if (!result.worth_a_look.empty())
      text += fmt::format(", {} in rows/{}.log", result.worth_a_look, log_name);
    return result.status == "done" ? text :
                                     text + ", failed: " + result.message;
  }

  Json
  StudyRun::fingerprint() const
  {
    const Body &body        = simulated ? simulated->body() : analysis->body();
    Json        result      = compared_entries(file.values());
    result["mesh_checksum"] = mesh_checksum(body.mesh);
    result["tables"]        = table_checksums(body.tables);
    return result;
  }

  StudyResult
  StudyRun::compute(const std::string &path,
                    const bool         goes_on,
                    const bool         saves_end)
  {
    StudyResult result;
    result.study_case = study_case;
    result.quantities.assign(parameters.study.quantity_list().size(),
                             std::numeric_limits<double>::quiet_NaN());
    if (simulated)
      simulate(result, path, goes_on, saves_end);
    else
      {
        log.open(path + ".log");
        analyse_modes(result);
      }
    result.peak_memory_bytes = peak_memory(comm);
    result.worth_a_look      = log.counts();
    return result;
  }

  void
  StudyRun::simulate(StudyResult       &result,
                     const std::string &path,
                     const bool         goes_on,
                     const bool         saves_end)
  {
    std::vector<std::unique_ptr<Observer>> observers;
    observers.push_back(std::make_unique<LastRow>(*columns));
    const auto &last = static_cast<const LastRow &>(*observers.front());
    // Iterations are counted in all steps; explicit steps have none.
    const bool is_explicit =
      parameters.simulation.time_integrator.selected().is_explicit();
    const OutputTimes times{is_explicit ? parameters.output.steps_between_rows :
                                          1,
                            parameters.output.time_between_results};
    const Json                        values = file.values();
    Checkpoints                       checkpoints(parameters.checkpoint,
                            path,
                            path + ".log",
                            values,
                            simulated->body(),
                            log);
    std::unique_ptr<CheckpointReader> checkpoint;
    try
      {
        if (goes_on)
          checkpoint = checkpoints.newest();
        // A run may continue with some changed entries, such as another time
        // step, but in a study that is another run.
        if (checkpoint && compared_entries(checkpoint->parameters()) !=
                            compared_entries(values))
          checkpoint.reset();
      }
    catch (const InputError &)
      {
        // The checkpoint has other parameters, as finished runs of the study
        // may have.
        checkpoint.reset();
      }
    try
      {
        if (checkpoint)
          checkpoints.resume(*simulated, observers, times, *checkpoint);
        else
          {
            log.open(path + ".log");
            simulated->start(observers, times);
          }
        checkpoints.run(*simulated, saves_end);
      }
    catch (const ComputationError &error)
      {
        result.status  = "failed";
        result.message = error.what();
      }
    take(result, last.summary);
    if (result.steps > 0)
      result.mean_time_step =
        (last.summary.end_time - simulated->start_time()) / result.steps;
    result.newton_iterations = last.newton_iterations;
    result.linear_iterations = last.linear_iterations;
    if (result.status == "done")
      result.quantities = pick(last.row);
    else
      result.errors.reset();
  }

  void
  StudyRun::analyse_modes(StudyResult &result)
  {
    try
      {
        analysis->compute();
      }
    catch (const ComputationError &error)
      {
        result.status  = "failed";
        result.message = error.what();
      }
    take(result, analysis->summary());
    result.linear_iterations = analysis->n_linear_iterations();
    if (result.status == "done")
      result.quantities = pick(frequencies());
  }

  Json
  StudyRun::frequencies() const
  {
    Json result;
    for (unsigned int i = 0; i < parameters.simulation.modes.number; ++i)
      result[fmt::format("frequency_{}", i + 1)] =
        i < analysis->modes().size() ? analysis->modes()[i].frequency :
                                       std::numeric_limits<double>::quiet_NaN();
    return result;
  }

  std::vector<double>
  StudyRun::pick(const Json &values) const
  {
    std::vector<double> result;
    for (const auto &quantity : parameters.study.quantity_list())
      {
        if (!values.contains(quantity.name))
          {
            std::vector<std::string> names;
            for (const auto &[name, value] : values.items())
              names.push_back(name);
            throw InputError(quantities_entry,
                             fmt::format("the quantity '{}' is unknown; "
                                         "allowed are {}",
                                         shortened(quantity.name),
                                         join(names)));
          }
        // A value that is not a number has become null in a checkpoint.
        const Json &value = values.at(quantity.name);
        result.push_back(value.is_null() ? NAN : value.get<double>());
      }
    return result;
  }
} // namespace corotet
