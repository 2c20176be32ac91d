// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/studies/recorded_run.h>

#include <csignal>
#include <iostream>

namespace
{
  using namespace corotet;

  void
  run(const int argc, const char *const *argv)
  {
    CommandLine command = parse_command_line(argc, argv);
    if (command.message)
      return on_root(MPI_COMM_WORLD, [&] { std::cout << *command.message; });
    if (command.output_directory)
      command.overrides.push_back("Output/Directory = " +
                                  *command.output_directory);

    ParameterFile file;
    try
      {
        recorded_run(command, file, MPI_COMM_WORLD);
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
} // namespace

int
main(int argc, char **argv)
{
  // A file that reaches a limit is an error of writing, like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);

  // deal.II hands its arguments on to PETSc, which warns about unknown ones.
  int                                      n_passed_on    = 1;
  char                                    *passed_on[]    = {argv[0], nullptr};
  char                                   **first_argument = passed_on;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_passed_on, first_argument, 1);

  return run_program(MPI_COMM_WORLD, [&] { run(argc, argv); });
}
