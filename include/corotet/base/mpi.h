// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_mpi_h
#define corotet_base_mpi_h

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <functional>
#include <type_traits>
#include <vector>

namespace corotet
{
  // Actions that can fail on one rank run inside of one of the functions below,
  // which make the outcome the same on all ranks, so that no rank throws while
  // others wait. Lack of memory and errors of the file system count as a
  // MachineError. Any other exception is a bug and leaves the function on its
  // own rank only.

  /**
   * Runs @p action on rank 0 of @p comm only. An Error that it throws there is
   * thrown on every rank, with the same kind, entry and message. Costs one
   * number sent to all ranks. Collective.
   */
  void
  on_root(const MPI_Comm comm, const std::function<void()> &action);

  /**
   * The value of @p action, which runs on rank 0 of @p comm only, on every
   * rank; errors as in on_root(). Collective.
   */
  template <typename Action>
  auto
  from_root(const MPI_Comm comm, const Action &action)
  {
    decltype(action()) value{};
    on_root(comm, [&] { value = action(); });
    return dealii::Utilities::MPI::broadcast(comm, value, 0);
  }

  /**
   * Runs @p action on every rank. If it throws an Error on some ranks, every
   * rank throws the Error of the lowest of these ranks. @p action must not
   * communicate. Collective.
   */
  void
  on_all_ranks(const MPI_Comm comm, const std::function<void()> &action);

  /**
   * Sends an array of numbers, or of structures of numbers, to another rank,
   * which calls receive_array(). The array may have any length, also above 2
   * GiB.
   */
  template <typename T>
  void
  send_array(const std::vector<T> &array,
             const unsigned int    receiver,
             const MPI_Comm        comm)
  {
    static_assert(std::is_trivially_destructible_v<T>);
    const std::uint64_t n_bytes = sizeof(T) * array.size();
    const auto          type =
      dealii::Utilities::MPI::create_mpi_data_type_n_bytes(n_bytes);
    MPI_Send(&n_bytes, 1, MPI_UINT64_T, receiver, 0, comm);
    MPI_Send(array.data(), 1, *type, receiver, 0, comm);
  }

  /// Receives an array that another rank sends by send_array().
  template <typename T>
  void
  receive_array(std::vector<T>    &array,
                const unsigned int sender,
                const MPI_Comm     comm)
  {
    std::uint64_t n_bytes = 0;
    MPI_Recv(&n_bytes, 1, MPI_UINT64_T, sender, 0, comm, MPI_STATUS_IGNORE);
    array.resize(n_bytes / sizeof(T));
    const auto type =
      dealii::Utilities::MPI::create_mpi_data_type_n_bytes(n_bytes);
    MPI_Recv(array.data(), 1, *type, sender, 0, comm, MPI_STATUS_IGNORE);
  }

  /**
   * Runs a whole @p program on every rank and returns its exit status: 0, that
   * of the Error which it throws, or 3 for any other exception. Rank 0 shows
   * the error on stderr, once.
   *
   * An exception that leaves @p program on some ranks only is a bug: the others
   * may wait for it in vain. When they have not ended within @p patience
   * seconds, the rank shows its error itself and ends all by MPI_Abort().
   */
  int
  run_program(const MPI_Comm               comm,
              const std::function<void()> &program,
              const double                 patience = 10);
} // namespace corotet

#endif
