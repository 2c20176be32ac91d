// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/mpi.h>
#include <corotet/mesh/file_mesh.h>
#include <corotet/mesh/mesh_report.h>
#include <corotet/mesh/mesh_target.h>
#include <corotet/studies/choices.h>
#include <corotet/studies/program.h>
#include <corotet/studies/run_command.h>

#include <deal.II/base/init_finalize.h>

#include <csignal>
#include <cstdlib>
#include <iostream>

namespace corotet
{
  namespace
  {
    void
    report_mesh(const MeshCommand &asked)
    {
      // Checked before the mesh is made, which may take long.
      if (!asked.out.empty())
        check_mesh_target(asked.out, asked.file);
      const SerialMesh mesh = read_mesh_file(asked.file,
                                             asked.element_size,
                                             asked.geometry_degree,
                                             asked.feature_angle);
      std::cout << mesh_report(mesh);
      if (asked.out.empty())
        return;
      write_mesh(asked.out, mesh);
      std::cout << "written: " << asked.out << '\n';
    }



    void
    run_command(const int argc, const char *const *argv)
    {
      CommandLine command = parse_command_line(argc, argv);
      if (command.message || command.list || command.mesh)
        {
          on_root(MPI_COMM_WORLD, [&] {
            if (command.message)
              std::cout << *command.message;
            else if (command.list)
              std::cout << list_choices();
            else
              report_mesh(*command.mesh);
            check_standard_output();
          });
          return;
        }
      if (command.output_directory)
        command.overrides.push_back("Output/Directory = " +
                                    *command.output_directory);

      ParameterFile file;
      with_places(command, file, [&] {
        run_command(command, file, MPI_COMM_WORLD);
      });
    }
    // Settings for a process that was not started by a launcher and is alone.
    // Launchers set one of these variables, by which Open MPI itself recognizes
    // them. Settings of the user are not changed.
    // - Open MPI would leave the memory that ranks of one machine share in
    //   /dev/shm when such a process ends: it needs none.
    // - Looking for graphics cards, by hwloc's plugins, takes a tenth of the
    //   start.
    void
    settings_if_alone()
    {
      for (const char *const set_by_launcher : {"PMIX_NAMESPACE",
                                                "PMIX_RANK",
                                                "PMI_RANK",
                                                "PMI_FD",
                                                "OMPI_COMM_WORLD_SIZE"})
        if (std::getenv(set_by_launcher) != nullptr)
          return;
      setenv("OMPI_MCA_btl", "self", 0);
      setenv("HWLOC_PLUGINS_PATH", "/dev/null", 0);
    }
  } // namespace

  int
  run_program(const int argc, char **argv)
  {
    int is_started = 0;
    MPI_Initialized(&is_started);
    if (is_started == 1)
      {
        std::cerr << "corotet: error: internal: run_program(argc, argv) starts "
                     "MPI, which has been started before; with "
                     "run_program(MPI_COMM_WORLD, ...) the caller starts it\n";
        return 3;
      }
    settings_if_alone();
    // A file that reaches the size limit then fails to be written, as on a full
    // disk.
    std::signal(SIGXFSZ, SIG_IGN);
    // SIGUSR1 is a request to save, which is handled during steps; before and
    // after them there is nothing to save.
    std::signal(SIGUSR1, SIG_IGN);

    // UCX, which MPI may load, would use SIGHUP for messages about itself.
    struct sigaction hangup{};
    sigaction(SIGHUP, nullptr, &hangup);

    // PETSc, Zoltan and p4est are not used, so they are not started.
    int                  n_passed_on    = 1;
    char                *passed_on[]    = {argv[0], nullptr};
    char               **first_argument = passed_on;
    dealii::InitFinalize libraries(n_passed_on,
                                   first_argument,
                                   dealii::InitializeLibrary::MPI |
                                     dealii::InitializeLibrary::Kokkos,
                                   1);
    sigaction(SIGHUP, &hangup, nullptr);

    return run_program(MPI_COMM_WORLD, [&] { run_command(argc, argv); });
  }
} // namespace corotet
