// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/log.h>
#include <corotet/base/memory.h>
#include <corotet/base/mpi.h>
#include <corotet/base/programs.h>
#include <corotet/base/stop_signals.h>
#include <corotet/output/csv.h>
#include <corotet/output/directory_lock.h>
#include <corotet/output/modes_writer.h>
#include <corotet/output/observers.h>
#include <corotet/output/output_directory.h>
#include <corotet/output/result_size.h>
#include <corotet/simulation/simulation.h>
#include <corotet/studies/convergence_study.h>
#include <corotet/studies/run_command.h>
#include <corotet/studies/run_parameters.h>
#include <corotet/studies/unused_parameters.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "earlier_run.h"
#include "page_of_run.h"

namespace corotet
{
  namespace
  {
    void
    compute_modes(ModalAnalysis &analysis, ModesWriter &writer)
    {
      try
        {
          analysis.compute();
        }
      catch (const ComputationError &error)
        {
          writer.write(error.what());
          throw;
        }
      writer.write("");
    }
  } // namespace

  void
  check_standard_output()
  {
    std::cout.flush();
    if (!std::cout)
      throw MachineError(
        "the standard output cannot be written (is the disk full?)");
  }

  void
  with_places(const CommandLine           &command,
              const ParameterFile         &file,
              const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const InputError &error)
      {
        if (error.entry.empty())
          throw;
        const bool by_option =
          command.output_directory && error.entry == "Output/Directory";
        const std::string place =
          by_option ? "--output" : file.location(error.entry);
        throw InputError("", place + ": " + error.entry + ": " + error.what());
      }
  }

  namespace
  {
    // One run of the program; its parameters must have been declared.
    class Command
    {
    public:
      Command(const CommandLine &command,
              ParameterFile     &file,
              RunParameters     &parameters,
              const MPI_Comm     comm)
        : command(command)
        , file(file)
        , parameters(parameters)
        , comm(comm)
        , log(comm, command.quiet)
      {
        file.read(command.parameter_file, command.overrides, comm);
        if (command.restart && parameters.simulation.type == RunType::modes)
          throw InputError("Type",
                           "--restart: found 'modes'; allowed: 'simulation', "
                           "or 'convergence study', whose finished runs are "
                           "kept");
        for (const std::string &line : unused_parameters(file, parameters))
          log.warning(line);
        if (has_unused_density(file, parameters.simulation))
          log.line("Material/Density: has no effect, as statics has no inertia "
                   "and there is no gravity");
        directory = parameters.output.directory_of_run(command.parameter_file);
        on_root(comm,
                [&] { file.check_effective(directory + "/parameters.prm"); });
        // Checked before the work starts; nothing is removed before all input
        // is checked.
        if (command.restart)
          // If there is a checkpoint, existing results stay.
          check_directory_of_restart(directory, comm);
        else
          // With --validate, results are mentioned at the end only.
          check_output_directory(
            directory, parameters.output.overwrite || command.validate, comm);
      }

      void
      run()
      {
        if (!command.validate)
          ignore_closed_pipes();
        try
          {
            compute();
          }
        catch (const ComputationError &error)
          {
            log.note(std::string("error: ") + error.what());
            write_report();
            throw;
          }
        catch (const Stopped &)
          {
            write_report();
            throw;
          }
        write_report();
      }

    private:
      void
      compute()
      {
        switch (parameters.simulation.type)
          {
            case RunType::convergence_study:
              run_study();
              break;
            case RunType::modes:
              run_modes();
              break;
            case RunType::simulation:
              run_simulation();
              break;
          }
      }

      void
      write_report()
      {
        if (!command.report || command.validate)
          return;
        if (from_root(comm, [&] {
              return run_installed_script("report", directory);
            }))
          log.line("The page of the run is " + directory + "/report.html");
        else
          log.warning("the page of the run could not be written; " +
                      command_for_page(directory) + " says why");
      }

      // A restart without a checkpoint begins anew and replaces results.
      bool
      may_overwrite() const
      {
        return parameters.output.overwrite || command.restart;
      }

      // The checkpoint to continue from; if it is null, the results of a run
      // that was killed are replaced.
      std::unique_ptr<CheckpointReader>
      take_checkpoint(const Checkpoints &checkpoints)
      {
        if (!command.validate)
          lock.emplace(directory, comm, log);
        auto checkpoint = checkpoints.newest();
        if (checkpoint)
          return checkpoint;
        if (!parameters.output.overwrite)
          check_new_beginning(directory, file, checkpoints.has_any(), comm);
        log.line("--restart: there is no checkpoint in " + directory +
                 "; the run begins anew");
        return nullptr;
      }

      void
      run_study()
      {
        ConvergenceStudy study(
          command, parameters.study, parameters.checkpoint, comm, log);
        parameters.verification.initialize(study.columns());
        const bool is_other =
          holds_any(directory, {"history.csv", "modes.csv"}, comm);
        if (command.restart && is_other && !parameters.output.overwrite)
          throw InputError("Output/Directory",
                           "--restart: found results of a run that is no "
                           "study in '" +
                             directory +
                             "'; allowed: another directory, or "
                             "Output/Overwrite = true to begin anew");
        const auto other =
          command.restart ? other_run_in(directory, file, comm) : std::nullopt;
        if (other && !parameters.output.overwrite)
          throw InputError(other->entry, other->message);
        const bool goes_on = command.restart && !is_other && !other;
        record("study.csv", goes_on, [&] {
          log.open(directory + "/log.txt");
          write_parameters();
          study.run(directory);
        });
      }

      void
      run_modes()
      {
        parameters.verification.initialize(
          column_names(modes_example(parameters.output)));
        ModalAnalysis analysis(parameters.simulation, file.folder(), comm, log);
        ModesWriter   writer(parameters.output, directory, analysis, log);
        record("modes.csv", false, [&] {
          log.open(directory + "/log.txt");
          write_parameters();
          compute_modes(analysis, writer);
        });
      }

      void
      run_simulation()
      {
        const OutputParameters &output = parameters.output;
        parameters.verification.initialize(column_names(
          history_example(output, parameters.simulation.forces.obstacles())));
        Simulation simulation(parameters.simulation, file.folder(), comm, log);
        const auto observers =
          make_observers(output,
                         directory,
                         HistoryColumns(output, simulation, log),
                         comm,
                         simulation.start_time(),
                         simulation.end_time(),
                         log,
                         simulation.obstacles());
        warn_of_size(output,
                     directory,
                     simulation.body(),
                     simulation.planned_steps(),
                     simulation.end_time() - simulation.start_time(),
                     log);
        const nlohmann::ordered_json values = file.values();
        Checkpoints                  checkpoints(parameters.checkpoint,
                                directory,
                                directory + "/log.txt",
                                values,
                                simulation.body(),
                                log);
        const auto                   checkpoint =
          command.restart ? take_checkpoint(checkpoints) : nullptr;
        const OutputTimes times{output.steps_between_rows,
                                output.time_between_results};
        const std::vector<std::unique_ptr<Observer>> no_files;
        if (!checkpoint)
          simulation.check(times);
        else if (command.validate)
          simulation.resume(no_files, times, *checkpoint);
        record("history.csv", checkpoint != nullptr, [&] {
          if (checkpoint)
            {
              checkpoints.resume(simulation, observers, times, *checkpoint);
              // The run has not ended any longer.
              on_root(comm, [&] {
                for (const char *const name :
                     {"summary.json", "verification.csv", "report.html"})
                  std::filesystem::remove(directory + "/" + name);
              });
            }
          else
            log.open(directory + "/log.txt");
          write_parameters();
          if (!checkpoint)
            simulation.start(observers, times);
          checkpoints.run(simulation);
        });
      }

      void
      warn_of_results()
      {
        if (!parameters.output.overwrite && is_filled(directory, comm))
          log.warning("the output directory '" + directory +
                      "' holds results: a run takes another one, or needs "
                      "Output/Overwrite = true" +
                      (parameters.simulation.type == RunType::modes ?
                         "" :
                         " or --restart"));
      }

      // Runs the computation, and checks the resulting table.
      void
      record(const std::string           &table,
             const bool                   goes_on,
             const std::function<void()> &action)
      {
        if (command.validate)
          {
            if (!command.restart)
              warn_of_results();
            log.line(command.parameter_file + ": valid");
            on_root(comm, check_standard_output);
            return;
          }
        if (!lock)
          lock.emplace(directory, comm, log);
        if (!goes_on)
          prepare_output_directory(directory, may_overwrite(), comm);
        release_library_pages();
        action();
        say_where_results_are(table);
        parameters.verification.compare(
          std::filesystem::path(command.parameter_file).stem().string(),
          directory,
          table,
          comm,
          log);
      }

      void
      say_where_results_are(const std::string &table)
      {
        const bool is_study =
          parameters.simulation.type == RunType::convergence_study;
        log.line("Results are in " + directory + ": " + table +
                 (is_study ? "" : ", solution.vtkhdf for ParaView") +
                 (command.report ? "" :
                                   ("; " + command_for_page(directory) +
                                    " makes a page of them")));
        const std::string counts = log.counts();
        if (!counts.empty())
          log.line("Worth a look above, or in log.txt: " + counts);
      }

      void
      write_parameters() const
      {
        on_root(comm,
                [&] { file.write_effective(directory + "/parameters.prm"); });
      }

      const CommandLine           &command;
      ParameterFile               &file;
      RunParameters               &parameters;
      const MPI_Comm               comm;
      Log                          log;
      std::string                  directory;
      std::optional<DirectoryLock> lock;
    };
  } // namespace

  void
  run_command(const CommandLine &command,
              ParameterFile     &file,
              const MPI_Comm     comm)
  {
    RunParameters parameters;
    parameters.declare_parameters(file.handler());
    if (command.print_parameters)
      {
        if (!command.parameter_file.empty())
          file.read(command.parameter_file, command.overrides, comm);
        on_root(comm, [&] {
          file.print(std::cout, *command.print_parameters);
          check_standard_output();
        });
      }
    else
      {
        Command(command, file, parameters, comm).run();
        // Makes room for pages that the end of the process reads.
        release_free_memory();
      }
  }
} // namespace corotet
