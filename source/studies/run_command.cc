// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/log.h>
#include <corotet/base/mpi.h>
#include <corotet/output/csv.h>
#include <corotet/output/history_writer.h>
#include <corotet/output/modes_writer.h>
#include <corotet/output/observers.h>
#include <corotet/output/output_directory.h>
#include <corotet/simulation/simulation.h>
#include <corotet/studies/convergence_study.h>
#include <corotet/studies/run_command.h>
#include <corotet/studies/run_parameters.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <iostream>

namespace corotet
{
  namespace
  {
    void
    compute_modes(ModalAnalysis &analysis, ModesWriter &writer)
    {
      std::string failure;
      try
        {
          analysis.compute();
        }
      catch (const ComputationError &error)
        {
          failure = error.what();
        }
      writer.write(failure);
      if (!failure.empty())
        throw ComputationError(failure);
    }
  } // namespace

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

  void
  run_command(const CommandLine &command,
              ParameterFile     &file,
              const MPI_Comm     comm)
  {
    RunParameters parameters;
    parameters.declare_parameters(file.handler());
    if (command.print_parameters)
      return on_root(comm,
                     [&] { file.print(std::cout, *command.print_parameters); });

    file.read(command.parameter_file, command.overrides, comm);
    const SimulationParameters &simulation_parameters = parameters.simulation;
    const OutputParameters     &output                = parameters.output;
    Verification               &verification          = parameters.verification;
    const bool                  is_study =
      simulation_parameters.type == RunType::convergence_study;
    if (command.restart && !is_study)
      throw InputError("Type",
                       "--restart: found '" +
                         name_of(run_types, simulation_parameters.type) +
                         "'; allowed: 'convergence study', whose finished "
                         "runs are kept");
    const std::string directory =
      output.directory_of_run(command.parameter_file);
    // Before the work starts; nothing is removed before all input is checked.
    if (!command.validate && !command.restart)
      check_output_directory(directory, output.overwrite, comm);

    Log        log(comm, command.quiet);
    const auto record = [&](const std::string           &table,
                            const std::function<void()> &compute) {
      if (command.validate)
        return log.line(command.parameter_file + ": valid");
      if (!command.restart)
        prepare_output_directory(directory, output.overwrite, comm);
      log.open(directory + "/log.txt");
      on_root(comm,
              [&] { file.write_effective(directory + "/parameters.prm"); });
      compute();
      log.line("Results are in " + directory);
      verification.compare(
        std::filesystem::path(command.parameter_file).stem().string(),
        directory,
        table,
        comm,
        log);
    };

    if (is_study)
      {
        ConvergenceStudy study(command, parameters.study, comm, log);
        verification.initialize(study.columns());
        return record("study.csv", [&] { study.run(directory); });
      }
    if (simulation_parameters.type == RunType::modes)
      {
        verification.initialize(column_names(modes_example(output)));
        ModalAnalysis analysis(simulation_parameters, file.folder(), comm, log);
        ModesWriter   writer(output, directory, analysis);
        return record("modes.csv", [&] { compute_modes(analysis, writer); });
      }
    verification.initialize(column_names(history_example(output)));
    Simulation simulation(simulation_parameters, file.folder(), comm, log);
    const auto observers = make_observers(output,
                                          directory,
                                          simulation.body().discretization,
                                          simulation.end_time(),
                                          log);
    record("history.csv", [&] {
      simulation.run(observers,
                     {output.steps_between_rows, output.time_between_results});
    });
  }
} // namespace corotet
