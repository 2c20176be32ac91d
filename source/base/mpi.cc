// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>
#include <corotet/base/mpi.h>
#include <corotet/base/text.h>

#include <boost/serialization/utility.hpp>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <string>
#include <thread>
#include <utility>

namespace corotet
{
  namespace
  {
    using dealii::Utilities::MPI::this_mpi_process;

    // Exit status (0: no error), entry and message of an Error.
    struct Outcome
    {
      int         exit_status = 0;
      std::string entry;
      std::string message;
    };

    Outcome
    outcome_of(const std::function<void()> &action)
    {
      try
        {
          action();
        }
      catch (const InputError &error)
        {
          return {error.exit_status, error.entry, error.what()};
        }
      catch (const Error &error)
        {
          return {error.exit_status, "", error.what()};
        }
      catch (const std::filesystem::filesystem_error &error)
        {
          return {3,
                  "",
                  error.path1().string() + ": " + error.code().message()};
        }
      catch (const std::ios_base::failure &error)
        {
          return {3, "", error.what()};
        }
      catch (const std::exception &error)
        {
          if (!is_lack_of_memory(error))
            throw;
          return {3, "", lack_of_memory()};
        }
      return {};
    }

    // Throws on every rank what @p outcome says on rank @p root.
    void
    throw_outcome_of(const unsigned int root,
                     const Outcome     &outcome,
                     const MPI_Comm     comm)
    {
      int exit_status = outcome.exit_status;
      MPI_Bcast(&exit_status, 1, MPI_INT, root, comm);
      if (exit_status == 0)
        return;
      const auto [entry, message] = dealii::Utilities::MPI::broadcast(
        comm, std::make_pair(outcome.entry, outcome.message), root);
      switch (exit_status)
        {
          case 1:
            throw InputError(entry, message);
          case 2:
            throw ComputationError(message);
          default:
            throw MachineError(message);
        }
    }

    // Whether all ranks call this within so many seconds of each other.
    bool
    all_arrive(const MPI_Comm comm, const double seconds)
    {
      using Clock     = std::chrono::steady_clock;
      const auto  end = Clock::now() + std::chrono::duration<double>(seconds);
      MPI_Request request = MPI_REQUEST_NULL;
      MPI_Ibarrier(comm, &request);
      for (int done = 0;;)
        {
          MPI_Test(&request, &done, MPI_STATUS_IGNORE);
          if (done != 0)
            return true;
          if (Clock::now() > end)
            return false;
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
  } // namespace

  void
  on_root(const MPI_Comm comm, const std::function<void()> &action)
  {
    Outcome outcome;
    if (this_mpi_process(comm) == 0)
      outcome = outcome_of(action);
    throw_outcome_of(0, outcome, comm);
  }

  void
  on_all_ranks(const MPI_Comm comm, const std::function<void()> &action)
  {
    const Outcome      outcome = outcome_of(action);
    const unsigned int none    = dealii::Utilities::MPI::n_mpi_processes(comm);
    const unsigned int first   = dealii::Utilities::MPI::min(
      outcome.exit_status != 0 ? this_mpi_process(comm) : none, comm);
    if (first != none)
      throw_outcome_of(first, outcome, comm);
  }

  int
  run_program(const MPI_Comm               comm,
              const std::function<void()> &program,
              const double                 patience)
  {
    // A communicator of its own, so that messages which other ranks wait for do
    // not interfere.
    const MPI_Comm for_the_end =
      dealii::Utilities::MPI::duplicate_communicator(comm);
    Outcome outcome;
    bool    is_bug = true;
    try
      {
        outcome = outcome_of(program);
        is_bug  = false;
      }
    catch (const std::exception &error)
      {
        outcome = {3, "", std::string("internal: ") + error.what()};
      }
    catch (...)
      {
        outcome = {3, "", "internal: an exception of unknown kind"};
      }
    if (outcome.exit_status != 0)
      {
        const bool is_agreed = all_arrive(for_the_end, patience);
        if (!is_agreed || this_mpi_process(comm) == 0)
          // The message is written in one piece: mpirun may lose some of
          // several pieces when the program fails.
          std::cerr
            << (outcome.exit_status == Stopped::status ? "corotet: stopped: " :
                                                         "corotet: error: ") +
                 printable((outcome.entry.empty() ? "" : outcome.entry + ": ") +
                             outcome.message,
                           /* keep_lines = */ is_bug) +
                 "\n"
            << std::flush;
        if (!is_agreed)
          MPI_Abort(comm, outcome.exit_status);
      }
    dealii::Utilities::MPI::free_communicator(for_the_end);
    return outcome.exit_status;
  }
} // namespace corotet
