// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/base/programs.h>
#include <corotet/base/stop_signals.h>
#include <corotet/base/text.h>
#include <corotet/base/timing.h>
#include <corotet/base/version.h>
#include <corotet/base/whole_file.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/studies/convergence_study.h>
#include <corotet/studies/study_table.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace corotet
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    // The text of a file on all ranks; empty if it does not exist.
    std::string
    read_file(const std::string &path, const MPI_Comm comm)
    {
      return from_root(comm, [&] {
        return std::filesystem::exists(path) ? read_whole_file(path) : "";
      });
    }

    // Removes the checkpoints of a finished run, in its own folder.
    void
    remove_checkpoints(const std::string &folder, const MPI_Comm comm)
    {
      on_root(comm, [&] {
        std::error_code error;
        std::filesystem::remove_all(folder, error);
      });
    }
  } // namespace

  ConvergenceStudy::ConvergenceStudy(const CommandLine          &command,
                                     const StudyParameters      &parameters,
                                     const CheckpointParameters &checkpoints,
                                     const MPI_Comm              comm,
                                     Log                        &log)
    : command(command)
    , parameters(parameters)
    , checkpoints(checkpoints)
    , cases(parameters.cases())
    , quantities(parameters.quantity_list())
    , comm(comm)
    , log(log)
  {
    const bool modes = parameters.run == RunType::modes;
    if (parameters.reference == StudyReference::none && quantities.empty())
      throw InputError("Convergence study/Quantities",
                       "there is nothing to compare: found no quantities and "
                       "no reference; allowed: quantities, or another value of "
                       "Convergence study/Reference");
    if (modes && parameters.reference == StudyReference::exact_solution)
      throw InputError("Convergence study/Reference",
                       "found 'exact solution' for modes; allowed: 'none' or "
                       "'finer run'");
    const auto require_finer_run = [&](const bool depends_on_time_step) {
      if (parameters.reference == StudyReference::finer_run &&
          parameters.further_refinements == 0 &&
          !(depends_on_time_step && parameters.time_steps.size() > 1))
        throw InputError("Convergence study/Further refinements",
                         "found 0: the run of the highest degree on the finest "
                         "mesh would be compared with itself; allowed: 1 to 3, "
                         "or 0 with several 'Time steps' of a simulation with "
                         "steps of given length, whose finer run has a shorter "
                         "step");
    };
    require_finer_run(!modes);
    std::set<std::string> checked;
    for (StudyCase one : cases)
      {
        one.refinements = cases.front().refinements;
        // The shortest time step, with which a run has the most steps.
        if (one.time_step)
          one.time_step = parameters.time_steps.back();
        if (!checked.insert(one.name()).second)
          continue;
        const StudyRun run(command.parameter_file,
                           command.overrides,
                           one,
                           comm);
        require_finer_run(!modes && run.depends_on_time_step());
        if (!modes)
          {
            run.check_times();
            check_finest(run.simulation()->body().discretization);
          }
        if (!modes && parameters.reference == StudyReference::finer_run &&
            run.simulation()->body().mesh.geometry_degree() > 1)
          throw InputError(
            "Convergence study/Reference",
            "found 'finer run' for curved cells; allowed: 'exact "
            "solution' or 'none', or straight cells");
      }
  }

  void
  ConvergenceStudy::check_finest(const Discretization &coarsest) const
  {
    unsigned int most = 0;
    for (const StudyCase &one : cases)
      most = std::max(most, one.refinements);
    const unsigned int further =
      parameters.reference == StudyReference::finer_run ?
        parameters.further_refinements :
        0;
    const double n_cells =
      static_cast<double>(coarsest.n_global_cells()) *
      std::pow(8., double(most + further) - cases.front().refinements);
    if (n_cells > largest_number_of_cells(0))
      throw InputError("Convergence study/Refinements",
                       fmt::format("too many cells: found {} refinements{}, "
                                   "which make {:.3g} cells; at most {:.3g} "
                                   "are allowed",
                                   most,
                                   further > 0 ?
                                     fmt::format(" and {} more of the finer "
                                                 "run",
                                                 further) :
                                     "",
                                   n_cells,
                                   largest_number_of_cells(0)));
  }

  std::vector<std::string>
  ConvergenceStudy::columns() const
  {
    // Makes a table without numbers.
    const bool has_norms = parameters.run != RunType::modes &&
                           parameters.reference != StudyReference::none;
    std::vector<StudyResult> results;
    for (const StudyCase &one : cases)
      {
        StudyResult result;
        result.study_case = one;
        result.quantities.resize(quantities.size());
        if (has_norms)
          result.errors = ErrorNorms();
        results.push_back(result);
      }
    auto references = quantities;
    for (auto &quantity : references)
      if (parameters.reference == StudyReference::finer_run &&
          !quantity.reference)
        quantity.reference = 0;
    const std::string text = StudyTable(results, references).csv();
    return split_outside_brackets(text.substr(0, text.find('\n')), ',');
  }

  void
  ConvergenceStudy::run(const std::string &output_directory)
  {
    directory = output_directory;
    on_root(comm, [&] {
      std::error_code error;
      std::filesystem::create_directories(directory + "/rows", error);
      if (error)
        throw MachineError(
          directory + "/rows: the folder cannot be made: " + error.message());
    });
    std::vector<StudyResult> results;
    unsigned int             n_failed = 0;
    // Signals are also handled while runs are set up: finished runs are kept.
    const StopSignals signals;
    for (const StudyCase &one : cases)
      {
        log.progress(fmt::format("run {} of {}: {}",
                                 results.size() + 1,
                                 cases.size(),
                                 one.name()),
                     static_cast<double>(results.size()) / cases.size());
        const unsigned int n_before = n_computed;
        try
          {
            results.push_back(result_of(one));
          }
        catch (const Stopped &stop)
          {
            log.note(stop.what());
            write(results, "stopped", stop.what());
            throw;
          }
        log.line(fmt::format("Run {} of {}, {}: {}",
                             results.size(),
                             cases.size(),
                             one.name(),
                             describe(results.back(),
                                      results.back().study_case.name())));
        n_failed += results.back().status == "done" ? 0 : 1;
        if (!failure_of_finer_run.empty())
          {
            write(results, "failed", failure_of_finer_run);
            throw ComputationError(failure_of_finer_run);
          }
        // Writes all results so far, in case that the study is killed.
        write(results, "unfinished", "");
        // The study is not stopped before this start of the program has
        // computed a run.
        if (n_computed > n_before && results.size() < cases.size())
          stop_if_asked(results);
      }
    remove_checkpoints(directory + "/rows/finer_run", comm);
    const std::string failures =
      n_failed == 0 ? "" :
                      fmt::format("{} of {} runs of the study have failed",
                                  n_failed,
                                  cases.size());
    write(results, n_failed == 0 ? "done" : "failed", failures);
    const StudyTable table(results, quantities);
    for (const std::string &line : table.lines())
      log.line(line);
    for (const std::string &text : table.not_converging())
      log.warning(text);
    if (parameters.pictures)
      draw();
    if (n_failed > 0)
      throw ComputationError(failures);
  }

  void
  ConvergenceStudy::stop_if_asked(const std::vector<StudyResult> &results)
  {
    const std::string reason = reason_to_stop(checkpoints, comm);
    if (reason.empty())
      return;
    const std::string message =
      fmt::format("{} of {} runs: {}; they are saved, --restart goes on with "
                  "the others",
                  results.size(),
                  cases.size(),
                  reason);
    log.note(message);
    write(results, "stopped", message);
    throw Stopped(message);
  }

  std::optional<StudyResult>
  ConvergenceStudy::kept_result(const std::string &path,
                                const Json        &problem,
                                const StudyCase   &study_case)
  {
    const Json kept = Json::parse(read_file(path, comm), nullptr, false);
    if (!kept.is_object() || !kept.contains("result") ||
        kept.value("problem", Json()) != problem)
      return {};
    const auto warn_of_damage = [&] {
      log.warning(path + ": the result is damaged; the run is made again");
    };
    try
      {
        StudyResult result = result_from_json(study_case, kept.at("result"));
        if (result.quantities.size() != quantities.size())
          return {};
        if (kept.value("git_revision", "") != git_revision &&
            !keeps_other_revisions)
          {
            log.warning(path + ": the result of another revision of corotet is "
                               "kept, as are others of that kind; without "
                               "--restart all runs are made again");
            keeps_other_revisions = true;
          }
        if (kept.contains("finer_run"))
          take_finer_result(
            result_from_json(finer_case(), kept.at("finer_run")));
        return result;
      }
    catch (const Json::exception &)
      {
        warn_of_damage();
      }
    catch (const std::logic_error &)
      {
        // A text is not a number.
        warn_of_damage();
      }
    return {};
  }

  StudyResult
  ConvergenceStudy::result_of(const StudyCase &study_case)
  {
    const std::string         path = directory + "/rows/" + study_case.name();
    std::unique_ptr<StudyRun> run;
    try
      {
        run = std::make_unique<StudyRun>(command.parameter_file,
                                         command.overrides,
                                         study_case,
                                         comm);
      }
    catch (const InputError &error)
      {
        return failed_result(study_case, error);
      }
    compare_parts(*run, study_case);
    Json problem          = run->fingerprint();
    problem["quantities"] = Json::array();
    for (const auto &quantity : quantities)
      problem["quantities"].push_back(quantity.name);
    problem["reference"] = parameters.reference == StudyReference::finer_run ?
                             finer_case().name() :
                             name_of(study_references, parameters.reference);
    problem["ranks"]     = dealii::Utilities::MPI::n_mpi_processes(comm);

    if (const auto kept = kept_result(path + ".json", problem, study_case))
      return *kept;

    ++n_computed;
    StudyResult result = run->compute(path, command.restart, false);
    Json        file{{"problem", problem}, {"git_revision", git_revision}};
    if (parameters.reference == StudyReference::finer_run)
      {
        compare_with_finer_run(result, *run);
        if (!failure_of_finer_run.empty())
          return result;
        file["finer_run"] = result_to_json(*finer_result);
      }
    file["result"] = result_to_json(result);
    on_root(comm, [&] { write_json_file(path + ".json", file, "the result"); });
    remove_checkpoints(path, comm);
    return result;
  }

  void
  ConvergenceStudy::write(const std::vector<StudyResult> &results,
                          const std::string              &status,
                          const std::string              &message)
  {
    on_root(comm, [&] {
      if (!results.empty())
        {
          const StudyTable table(results, quantities);
          write_whole_file(directory + "/study.csv", table.csv(), "the study");
          write_whole_file(directory + "/study.tex",
                           table.latex(),
                           "the study");
        }
      const auto n_failed =
        std::count_if(results.begin(), results.end(), [](const auto &result) {
          return result.status != "done";
        });
      Json summary{{"status", status}};
      if (!message.empty())
        summary["message"] = message;
      summary["version"]        = version;
      summary["git_revision"]   = git_revision;
      summary["dealii_version"] = DEAL_II_PACKAGE_VERSION;
      summary["ranks"]          = dealii::Utilities::MPI::n_mpi_processes(comm);
      summary["runs"]           = cases.size();
      summary["finished_runs"]  = results.size() - n_failed;
      summary["failed_runs"]    = n_failed;
      double        wall_time   = 0;
      std::uint64_t peak_memory = 0;
      const auto    count       = [&](const StudyResult &result) {
        wall_time += result.total_wall_time;
        peak_memory =
          std::max<std::uint64_t>(peak_memory, result.peak_memory_bytes);
      };
      std::for_each(results.begin(), results.end(), count);
      if (finer_result)
        count(*finer_result);
      summary["wall_time"]         = {{"total", wall_time}};
      summary["peak_memory_bytes"] = peak_memory;
      write_json_file(directory + "/summary.json", summary, "the summary");
    });
  }

  void
  ConvergenceStudy::draw() const
  {
    on_root(comm, [&] {
      if (!run_installed_script("draw_study", directory))
        log.warning("the pictures of the study could not be drawn; "
                    "scripts/draw_study, which needs Python and matplotlib, "
                    "says why");
    });
  }
} // namespace corotet
