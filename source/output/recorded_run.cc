// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/log.h>
#include <corotet/base/mpi.h>
#include <corotet/output/observers.h>
#include <corotet/output/output_directory.h>
#include <corotet/output/recorded_run.h>
#include <corotet/simulation/simulation.h>

#include <iostream>

namespace corotet
{
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
    Simulation simulation(parameters, file.folder(), comm, log);
    const auto observers = make_observers(output,
                                          directory,
                                          simulation.discretization(),
                                          simulation.end_time(),
                                          log);
    if (command.validate)
      return log.line(command.parameter_file + ": valid");

    prepare_output_directory(directory, output.overwrite, comm);
    log.open(directory + "/log.txt");
    on_root(comm, [&] { file.write_effective(directory + "/parameters.prm"); });
    simulation.run(observers,
                   {output.steps_between_rows, output.time_between_results});
    log.line("Results are in " + directory);
  }
} // namespace corotet
