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
} // namespace corotet

#endif
