// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/log.h>
#include <corotet/base/mpi.h>
#include <corotet/base/parameter_file.h>
#include <corotet/output/observers.h>
#include <corotet/output/output_directory.h>
#include <corotet/simulation/command_line.h>
#include <corotet/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <iostream>

namespace
{
  using namespace corotet;

  void
  run(const CommandLine &command, ParameterFile &file)
  {
    SimulationParameters parameters;
    OutputParameters     output;
    parameters.declare_parameters(file.handler());
    file.handler().enter_subsection("Output");
    output.declare_parameters(file.handler());
    file.handler().leave_subsection();
    const MPI_Comm comm = MPI_COMM_WORLD;
    if (command.print_parameters)
      return on_root(comm,
                     [&] { file.print(std::cout, *command.print_parameters); });
    file.read(command.parameter_file, command.overrides);

    Log               log(comm, command.quiet);
    Simulation        simulation(parameters, file.folder(), comm, log);
    const std::string directory =
      output.directory_of_run(command.parameter_file);
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
    simulation.run(observers);
    log.line("Results are in " + directory);
  }

  int
  report(const int exit_status, const std::string &message)
  {
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cerr << "corotet: error: " << message << std::endl;
    return exit_status;
  }
} // namespace

int
main(int argc, char **argv)
{
  // deal.II hands the arguments on to PETSc, which warns about unknown ones.
  int                                      n_known         = 1;
  char                                    *known[]         = {argv[0], nullptr};
  char                                   **known_arguments = known;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_known, known_arguments, 1);
  ParameterFile                            file;
  try
    {
      CommandLine command = parse_command_line(argc, argv);
      if (command.output_directory)
        command.overrides.push_back("Output/Directory = " +
                                    *command.output_directory);
      if (command.message)
        on_root(MPI_COMM_WORLD, [&] { std::cout << *command.message; });
      else
        run(command, file);
      return 0;
    }
  catch (const InputError &error)
    {
      const std::string place =
        error.entry.empty() ? "" : file.location(error.entry) + ": ";
      const std::string entry = error.entry.empty() ? "" : error.entry + ": ";
      return report(error.exit_status, place + entry + error.what());
    }
  catch (const Error &error)
    {
      return report(error.exit_status, error.what());
    }
  catch (const std::exception &error)
    {
      // Not foreseen, so perhaps on this rank only: take the others along.
      std::cerr << "corotet: error: internal: " << error.what() << std::endl;
      MPI_Abort(MPI_COMM_WORLD, 3);
    }
}
