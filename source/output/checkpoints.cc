// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>
#include <corotet/base/mpi.h>
#include <corotet/base/stop_signals.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>
#include <corotet/output/checkpoints.h>
#include <corotet/output/table_checksums.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>

namespace corotet
{
  namespace
  {
    namespace fs = std::filesystem;
    using Json   = nlohmann::ordered_json;

    // The limit of wall time counts from the start of the program, for all its
    // runs.
    const auto program_start = std::chrono::steady_clock::now();


    // Requests to a run, as bits.
    enum Request : int
    {
      none       = 0,
      save       = 1,
      terminate  = 2,
      interrupt  = 4,
      time_limit = 8,
      cpu_limit  = 16,
      hangup     = 32
    };

    double
    seconds_since(const std::chrono::steady_clock::time_point since)
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                           since)
        .count();
    }

    // The requests to stop that this rank knows of; rank 0 has the clock.
    int
    requests_to_stop(const CheckpointParameters &parameters,
                     const MPI_Comm              comm)
    {
      int mine = none;
      switch (StopSignals::received())
        {
          case SIGTERM:
            mine = terminate;
            break;
          case SIGINT:
            mine = interrupt;
            break;
          case SIGHUP:
            mine = hangup;
            break;
          case SIGXCPU:
            mine = cpu_limit;
            break;
          default:
            break;
        }
      if (dealii::Utilities::MPI::this_mpi_process(comm) == 0 &&
          parameters.wall_time_limit > 0 &&
          seconds_since(program_start) >= parameters.wall_time_limit)
        mine |= time_limit;
      return mine;
    }

    int
    on_any_rank(const int mine, const MPI_Comm comm)
    {
      int all = none;
      MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_BOR, comm);
      return all;
    }

    // The reason of a request to stop; empty if there is none.
    std::string
    reason_of(const int requests)
    {
      if ((requests & terminate) != 0)
        return "SIGTERM";
      if ((requests & interrupt) != 0)
        return "SIGINT";
      if ((requests & hangup) != 0)
        return "SIGHUP";
      if ((requests & cpu_limit) != 0)
        return "the limit of CPU time (SIGXCPU)";
      return (requests & time_limit) != 0 ? "the wall time limit" : "";
    }
  } // namespace

  void
  CheckpointParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Steps between checkpoints",
                      steps_between,
                      "Number of steps from one checkpoint to the next [-]: "
                      "one is written after each step whose number is a "
                      "multiple of this or, if that step has no row in "
                      "history.csv, after the next step that has one. 0: none "
                      "by the number of steps.",
                      dealii::Patterns::Integer(0));
    prm.add_parameter("Minutes between checkpoints",
                      minutes_between,
                      "Wall time from one checkpoint to the next [min]. 0: "
                      "none by time. If this or 'Steps between checkpoints' is "
                      "not 0, there is also a checkpoint at the end of the "
                      "run, from which it can go on to a later end time.",
                      dealii::Patterns::Double(0));
    prm.add_parameter("Keep",
                      keep,
                      "Number of checkpoints that are kept, the newest ones "
                      "[-].",
                      dealii::Patterns::Integer(1, 1000));
    prm.add_parameter(
      "Wall time limit",
      wall_time_limit,
      "Wall time since the start of the program [s] after which the run is "
      "saved and ends with status 4; --restart goes on with it. 0: no limit. "
      "No effect on modes.",
      dealii::Patterns::Double(0));
  }

  std::string
  reason_to_stop(const CheckpointParameters &parameters, const MPI_Comm comm)
  {
    return reason_of(on_any_rank(requests_to_stop(parameters, comm), comm));
  }

  Checkpoints::Checkpoints(const CheckpointParameters &parameters,
                           const std::string          &directory,
                           const std::string          &log_file,
                           const Json                 &values,
                           const Body                 &body,
                           Log                        &log)
    : parameters(parameters)
    , directory(directory + "/checkpoint")
    , log_file(log_file)
    , values(values)
    , body(body)
    , discretization(body.discretization)
    , comm(discretization.communicator())
    , log(log)
  {}

  const FileOrder &
  Checkpoints::order_of_nodes() const
  {
    if (!order)
      order = FileOrder::of_nodes(discretization, discretization);
    return *order;
  }

  bool
  Checkpoints::has_any() const
  {
    return from_root(comm, [&] { return !places().empty(); });
  }

  std::unique_ptr<CheckpointReader>
  Checkpoints::newest() const
  {
    const auto all = from_root(comm, [&] { return places(); });
    for (const Place &place : all)
      {
        std::unique_ptr<CheckpointReader> reader;
        try
          {
            reader = std::make_unique<CheckpointReader>(path_of(place),
                                                        discretization,
                                                        order_of_nodes());
          }
        catch (const InputError &error)
          {
            log.warning(fmt::format("{}; {}",
                                    error.what(),
                                    place == all.back() ?
                                      "there is none before it" :
                                      "the checkpoint before it is used"));
            continue;
          }
        check_entries(*reader);
        reader->check_mesh();
        check_tables(*reader);
        return reader;
      }
    return nullptr;
  }

  void
  Checkpoints::resume(Simulation                                   &simulation,
                      const std::vector<std::unique_ptr<Observer>> &observers,
                      const OutputTimes                            &recording,
                      CheckpointReader                             &checkpoint)
  {
    std::int64_t log_size = 0;
    checkpoint.transfer("log_size", log_size);
    // A restarted run may make other steps: the checkpoint is found by its
    // files, as its place within a step may not exist any more.
    for (const Place &place : from_root(comm, [&] { return places(); }))
      if (path_of(place) == checkpoint.base_path())
        written_place = place;
    // This may throw; then the log stays as it was.
    simulation.resume(observers, recording, checkpoint);
    log.resume(log_file, log_size);
    log.line(fmt::format("Restarted from {}, t = {:.6g} s",
                         in_words(*written_place),
                         simulation.time()));
    on_root(comm, [&] {
      // Newer checkpoints are damaged.
      for (const Place &place : places())
        if (*written_place < place)
          for (const char *suffix : {".json", ".h5"})
            fs::remove(path_of(place) + suffix);
      remove_unfinished();
    });
  }

  void
  Checkpoints::run(Simulation &simulation, const bool saves_end)
  {
    const StopSignals signals;
    int               asked = none;
    while (!simulation.is_done())
      {
        simulation.step({.after_step =
                           [&] {
                             has_advanced = true;
                             asked |= requests();
                             return asked != none;
                           },
                         .within_step = [&] { return is_urgent(); }});
        has_advanced = true;
        asked |= requests();
        if (simulation.is_done())
          break;
        if ((asked & ~save) != 0)
          {
            write(simulation, true);
            const std::string message =
              fmt::format("{} (t = {:.6g} s): {}; the run is saved, "
                          "--restart goes on with it",
                          in_words(place_of(simulation)),
                          simulation.time(),
                          reason_of(asked));
            log.note(message);
            simulation.stop(message);
            throw Stopped(message);
          }
        const unsigned int interval = parameters.steps_between;
        if ((asked & save) != 0 ||
            (interval > 0 && place_of(simulation).last_whole_step() / interval >
                               last_whole_step_written() / interval))
          write(simulation, true);
        asked = none;
      }
    simulation.finish();
    if (saves_end && parameters.are_written())
      write(simulation, false);
  }

  int
  Checkpoints::requests()
  {
    int mine = requests_to_stop(parameters, comm);
    if (StopSignals::take_save_request())
      mine |= save;
    // Only the clock of rank 0 counts.
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0 &&
        parameters.minutes_between > 0 &&
        seconds_since(written) >= 60 * parameters.minutes_between)
      mine |= save;
    return on_any_rank(mine, comm);
  }

  bool
  Checkpoints::is_urgent() const
  {
    // Most steps end in this time [s]; a process that does not stop is usually
    // killed after twice this time or more.
    constexpr double patience = 5;
    if (StopSignals::waiting_time() > patience)
      return true;
    // Without has_advanced, a limit shorter than a step would stop each restart
    // where it began.
    return parameters.wall_time_limit > 0 && has_advanced &&
           dealii::Utilities::MPI::this_mpi_process(comm) == 0 &&
           seconds_since(program_start) > parameters.wall_time_limit + patience;
  }

  void
  Checkpoints::write(Simulation &simulation, const bool durable)
  {
    const Place place = place_of(simulation);
    written           = Clock::now();
    // This state has been saved already.
    if (place == written_place)
      return;
    release_free_memory();
    on_root(comm, [&] { fs::create_directories(directory); });
    // Files that the checkpoint refers to must be on the disk before it is.
    if (durable)
      on_all_ranks(comm, [&] { sync_file_system(directory); });
    CheckpointWriter writer(path_of(place), discretization, order_of_nodes());
    std::int64_t     log_size  = log.size();
    Json             checksums = table_checksums(body.tables);
    for (Json &table : checksums)
      table["time"] = simulation.time();
    std::string tables = checksums.dump();
    writer.transfer("log_size", log_size);
    writer.transfer("tables", tables);
    simulation.save_state(writer);
    writer.finish(values, durable);
    written_place = place;
    on_root(comm, [&] { remove_old(); });
  }
} // namespace corotet
