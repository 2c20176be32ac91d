// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>

#include <deal.II/base/mpi.h>

#include <string>
#include <tuple>

namespace corotet
{
  namespace
  {
    // Exit status (0: no error), entry and message of an Error, as they travel
    // between ranks.
    using Outcome = std::tuple<int, std::string, std::string>;

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
      return {0, "", ""};
    }

    void
    throw_if_error(const Outcome &outcome)
    {
      const auto &[exit_status, entry, message] = outcome;
      switch (exit_status)
        {
          case 0:
            return;
          case 1:
            throw InputError(entry, message);
          case 2:
            throw ComputationError(message);
          default:
            throw MachineError(message);
        }
    }
  } // namespace

  void
  on_root(const MPI_Comm comm, const std::function<void()> &action)
  {
    Outcome outcome{0, "", ""};
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      outcome = outcome_of(action);
    throw_if_error(dealii::Utilities::MPI::broadcast(comm, outcome, 0));
  }

  void
  on_all_ranks(const MPI_Comm comm, const std::function<void()> &action)
  {
    const Outcome      outcome = outcome_of(action);
    const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(comm);
    const unsigned int none    = dealii::Utilities::MPI::n_mpi_processes(comm);
    const unsigned int first =
      dealii::Utilities::MPI::min(std::get<0>(outcome) != 0 ? rank : none,
                                  comm);
    if (first != none)
      throw_if_error(dealii::Utilities::MPI::broadcast(comm, outcome, first));
  }
} // namespace corotet
