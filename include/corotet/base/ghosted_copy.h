// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_ghosted_copy_h
#define corotet_base_ghosted_copy_h

#include <corotet/base/vector.h>

namespace corotet
{
  /// copy = vector, with ghost entries up to date (assignment leaves them as
  /// they are). Collective.
  inline void
  copy_with_ghosts(Vector &copy, const Vector &vector)
  {
    copy.copy_locally_owned_data_from(vector);
    copy.update_ghost_values();
  }

  /**
   * Brings the ghost entries of a vector up to date during its own lifetime,
   * unless they are in use already. The vector must live as long. Collective.
   */
  class GhostsInUse
  {
  public:
    explicit GhostsInUse(const Vector &vector)
      : vector(vector)
      , fetched(!vector.has_ghost_elements())
    {
      if (fetched)
        vector.update_ghost_values();
    }

    GhostsInUse(const GhostsInUse &) = delete;
    GhostsInUse &
    operator=(const GhostsInUse &) = delete;

    ~GhostsInUse()
    {
      if (fetched)
        vector.zero_out_ghost_values();
    }

  private:
    const Vector &vector;
    const bool    fetched;
  };
} // namespace corotet

#endif
