// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_simulation_complete_run_h
#define corotet_tests_simulation_complete_run_h

#include <corotet/base/exceptions.h>
#include <corotet/simulation/simulation.h>

#include <memory>
#include <string>
#include <vector>

#include "../body.h"
#include "../temporary_folder.h"

namespace corotet::tests
{
  /// Keeps what an observer is shown.
  class Recorder : public Observer
  {
  public:
    void
    start(const Snapshot &initial) override
    {
      keep(initial);
    }

    void
    step(const Snapshot &state) override
    {
      keep(state);
      steps.push_back(state.record);
    }

    void
    save(const Snapshot &state) override
    {
      saved.push_back(state.record);
      last         = state.last;
      displacement = state.displacement;
    }

    void
    finish(const RunSummary &run_summary) override
    {
      summary = run_summary;
    }

    /// All records, those of steps, and those of saved states.
    std::vector<StepRecord> records, steps, saved;
    RunSummary              summary;
    /// The displacement of the last state.
    Vector      displacement;
    std::size_t cells = 0;
    bool        last  = false;

  private:
    void
    keep(const Snapshot &state)
    {
      records.push_back(state.record);
      cells        = state.cell_results().det_F.size();
      last         = state.last;
      displacement = state.displacement;
    }
  };

  /// A simulation and its recorder, which is the only observer.
  struct CompleteRun
  {
    explicit CompleteRun(const std::string &text,
                         const MPI_Comm     comm = MPI_COMM_WORLD)
      : parameters(text)
      , log(comm, true)
      , simulation(parameters, "", comm, log)
    {
      observers.push_back(std::make_unique<Recorder>());
    }

    /// Returns why the computation failed; an empty text if it succeeded.
    std::string
    run(const OutputTimes &recording = {})
    {
      try
        {
          simulation.run(observers, recording);
        }
      catch (const ComputationError &error)
        {
          return error.what();
        }
      return "";
    }

    const Recorder &
    recorder() const
    {
      return static_cast<const Recorder &>(*observers.front());
    }

    Parameters                             parameters;
    Log                                    log;
    Simulation                             simulation;
    std::vector<std::unique_ptr<Observer>> observers;
  };

  /// The warnings of the run so far, on all ranks. Collective.
  inline std::vector<std::string>
  warnings(CompleteRun &run)
  {
    const TemporaryFolder folder;
    run.log.open(folder / "log.txt");
    const std::string        mark = "warning: ";
    std::vector<std::string> result;
    for (const std::string &line :
         dealii::Utilities::split_string_list(folder.read("log.txt"), '\n'))
      if (line.starts_with(mark))
        result.push_back(line.substr(mark.size()));
    // Rank 0 has the log.
    return dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, result);
  }

  inline bool
  on_one_rank()
  {
    return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
  }
} // namespace corotet::tests

#endif
