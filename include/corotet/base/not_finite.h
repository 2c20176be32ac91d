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
    /// The parameter with the formula, "Section/Entry".
    std::string entry;
    /// The value, the place and the time.
    std::string message;
  };

  /**
   * Expressions note their first value that is not finite, because the sums
   * that are checked later do not tell which formula caused it. Returns the
   * value noted since the last call, on the lowest rank that has one; from then
   * on the next one is noted. Collective.
   */
  std::optional<NotFinite>
  take_not_finite(const MPI_Comm comm);
} // namespace corotet

#endif
