// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_mpi_h
#define corotet_base_mpi_h

#include <mpi.h>

#include <functional>

namespace corotet
{
  /**
   * Runs @p action on rank 0 of @p comm only. An Error that it throws there is
   * thrown on every rank, with the same kind, entry and message; so no rank is
   * left waiting. Collective.
   */
  void
  on_root(const MPI_Comm comm, const std::function<void()> &action);

  /**
   * Runs @p action on every rank. If it throws an Error on some ranks, every
   * rank throws the one of the lowest of them.
   * @p action must not communicate. Collective.
   */
  void
  on_all_ranks(const MPI_Comm comm, const std::function<void()> &action);
} // namespace corotet

#endif
