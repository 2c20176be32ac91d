// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_not_finite_h
#define corotet_base_not_finite_h

#include <mpi.h>

#include <optional>
#include <string>

namespace corotet
{
  /**
   * A formula of the user that was infinite or not a number where it was
   * evaluated.
   */
  struct NotFinite
  {
    /// The parameter that has it, "Section/Entry".
    std::string entry;
    /// What was found, where and when.
    std::string message;
  };

  /**
   * Expressions note the first value of theirs that is not finite: sums of
   * many, which are what is looked at, do not tell whose it was. This is the
   * one noted since the last call, on the lowest rank that has one; from then
   * on the next is noted. Collective.
   */
  std::optional<NotFinite>
  take_not_finite(const MPI_Comm comm);
} // namespace corotet

#endif
