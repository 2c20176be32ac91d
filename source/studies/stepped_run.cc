// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/log.h>
#include <corotet/base/mpi.h>
#include <corotet/output/directory_lock.h>
#include <corotet/output/observers.h>
#include <corotet/output/output_directory.h>
#include <corotet/simulation/simulation.h>
#include <corotet/studies/run_command.h>
#include <corotet/studies/run_parameters.h>
#include <corotet/studies/stepped_run.h>
#include <corotet/studies/unused_parameters.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>
#include <stdexcept>
#include <utility>

namespace corotet
{
  struct SteppedRun::Parts
  {
    Parts(const CommandLine &command, const MPI_Comm comm);

    ParameterFile                          file;
    RunParameters                          parameters;
    Log                                    log;
    std::optional<DirectoryLock>           lock;
    std::optional<Simulation>              simulation;
    std::vector<std::unique_ptr<Observer>> observers;
    bool                                   is_over = false;

  private:
    void
    start(const CommandLine &command, const MPI_Comm comm);
  };

  SteppedRun::Parts::Parts(const CommandLine &command, const MPI_Comm comm)
    : log(comm, command.quiet)
  {
    parameters.declare_parameters(file.handler());
    with_places(command, file, [&] { start(command, comm); });
  }

  void
  SteppedRun::Parts::start(const CommandLine &command, const MPI_Comm comm)
  {
    std::vector<std::string> overrides = command.overrides;
    if (command.output_directory)
      overrides.push_back("Output/Directory = " + *command.output_directory);
    file.read(command.parameter_file, overrides, comm);
    if (parameters.simulation.type != RunType::simulation)
      throw InputError("Type",
                       "found '" +
                         name_of(run_types, parameters.simulation.type) +
                         "'; allowed in a run step by step: 'simulation'");

    for (const std::string &line : unused_parameters(file, parameters))
      log.warning(line);
    const nlohmann::ordered_json values = file.values();
    for (const char *const section : {"Checkpoint", "Verification"})
      for (const auto &[entry, value] : values.at(section).items())
        if (const std::string path = std::string(section) + "/" + entry;
            value.is_string() && file.is_set(path))
          log.warning(fmt::format("{}: no effect on a run step by step: {}",
                                  file.location(path),
                                  path));

    const OutputParameters &output = parameters.output;
    const std::string       directory =
      output.directory_of_run(command.parameter_file);
    on_root(comm, [&] { file.check_effective(directory + "/parameters.prm"); });
    check_output_directory(directory, output.overwrite, comm);
    simulation.emplace(parameters.simulation, file.folder(), comm, log);
    observers = make_observers(output,
                               directory,
                               HistoryColumns(output, *simulation, log),
                               comm,
                               simulation->start_time(),
                               simulation->end_time(),
                               log,
                               simulation->obstacles());
    const OutputTimes times{output.steps_between_rows,
                            output.time_between_results};
    simulation->check(times);
    lock.emplace(directory, comm, log);
    prepare_output_directory(directory, output.overwrite, comm);
    log.open(directory + "/log.txt");
    on_root(comm, [&] { file.write_effective(directory + "/parameters.prm"); });
    simulation->start(observers, times);
  }

  namespace
  {
    // @p comm, if MPI has been started.
    MPI_Comm
    usable(const MPI_Comm comm)
    {
      int is_started = 0;
      MPI_Initialized(&is_started);
      if (is_started == 0)
        throw std::logic_error(
          "SteppedRun needs MPI, which has not been started");
      return comm;
    }
  } // namespace

  SteppedRun::SteppedRun(const CommandLine &command, const MPI_Comm comm)
    : parts(std::make_unique<Parts>(command, usable(comm)))
  {}

  SteppedRun::~SteppedRun() = default;

  bool
  SteppedRun::is_done() const
  {
    return parts->is_over || parts->simulation->is_done();
  }

  void
  SteppedRun::step()
  {
    if (is_done())
      throw std::logic_error("SteppedRun::step(): the run is over");
    try
      {
        parts->simulation->step();
      }
    catch (...)
      {
        parts->is_over = true;
        throw;
      }
  }

  void
  SteppedRun::finish()
  {
    if (!std::exchange(parts->is_over, true))
      parts->simulation->finish();
  }

  double
  SteppedRun::time() const
  {
    return parts->simulation->record().time;
  }

  const Vector &
  SteppedRun::displacement() const
  {
    return parts->simulation->displacement();
  }

  const Vector &
  SteppedRun::velocity() const
  {
    return parts->simulation->velocity();
  }

  const StepRecord &
  SteppedRun::record() const
  {
    return parts->simulation->record();
  }

  const Discretization &
  SteppedRun::discretization() const
  {
    return parts->simulation->body().discretization;
  }
} // namespace corotet
