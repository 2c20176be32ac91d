// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/log.h>
#include <corotet/base/mpi.h>
#include <corotet/output/modes_writer.h>
#include <corotet/output/observers.h>
#include <corotet/output/output_directory.h>
#include <corotet/output/recorded_run.h>
#include <corotet/simulation/simulation.h>

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
  recorded_run(const CommandLine &command,
               ParameterFile     &file,
               const MPI_Comm     comm)
  {
    SimulationParameters parameters;
    OutputParameters     output;
    parameters.declare_parameters(file.handler());
    file.handler().enter_subsection("Output");
    output.declare_parameters(file.handler());
    file.handler().leave_subsection();
    if (command.print_parameters)
      return on_root(comm,
                     [&] { file.print(std::cout, *command.print_parameters); });

    file.read(command.parameter_file, command.overrides);
    const std::string directory =
      output.directory_of_run(command.parameter_file);
    // Before the work starts; nothing is removed before all input is checked.
    if (!command.validate)
      check_output_directory(directory, output.overwrite, comm);

    Log        log(comm, command.quiet);
    const auto record = [&](const std::function<void()> &compute) {
      if (command.validate)
        return log.line(command.parameter_file + ": valid");
      prepare_output_directory(directory, output.overwrite, comm);
      log.open(directory + "/log.txt");
      on_root(comm,
              [&] { file.write_effective(directory + "/parameters.prm"); });
      compute();
      log.line("Results are in " + directory);
    };

    if (parameters.type == "modes")
      {
        ModalAnalysis analysis(parameters, file.folder(), comm, log);
        ModesWriter   writer(output, directory, analysis);
        return record([&] { compute_modes(analysis, writer); });
      }
    Simulation simulation(parameters, file.folder(), comm, log);
    const auto observers = make_observers(output,
                                          directory,
                                          simulation.discretization(),
                                          simulation.end_time(),
                                          log);
    record([&] {
      simulation.run(observers,
                     {output.steps_between_rows, output.time_between_results});
    });
  }
} // namespace corotet
