// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/studies/recorded_run.h>

#include <deal.II/base/mpi.h>

#include <iostream>

namespace
{
  // Shows an error once, not once per rank.
  int
  report(const int exit_status, const std::string &message)
  {
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      // In one piece: mpirun may lose some of several when the program fails.
      std::cerr << "corotet: error: " + message + "\n";
    return exit_status;
  }
} // namespace

int
main(int argc, char **argv)
{
  using namespace corotet;

  // deal.II hands its arguments on to PETSc, which warns about unknown ones.
  int                                      n_passed_on    = 1;
  char                                    *passed_on[]    = {argv[0], nullptr};
  char                                   **first_argument = passed_on;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_passed_on, first_argument, 1);

  CommandLine   command;
  ParameterFile file;
  try
    {
      command = parse_command_line(argc, argv);
      if (command.message)
        {
          on_root(MPI_COMM_WORLD, [&] { std::cout << *command.message; });
          return 0;
        }
      if (command.output_directory)
        command.overrides.push_back("Output/Directory = " +
                                    *command.output_directory);
      recorded_run(command, file, MPI_COMM_WORLD);
      return 0;
    }
  catch (const InputError &error)
    {
      if (error.entry.empty())
        return report(error.exit_status, error.what());
      const bool by_option =
        command.output_directory && error.entry == "Output/Directory";
      const std::string place =
        by_option ? "--output" : file.location(error.entry);
      return report(error.exit_status,
                    place + ": " + error.entry + ": " + error.what());
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
