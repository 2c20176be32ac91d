// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_negligible_h
#define corotet_base_negligible_h

namespace corotet
{
  /**
   * Norms below this value count as zero, in any unit, such as those of forces
   * of a body that has come to rest. Solvers divide by products of two norms,
   * which underflow to zero below norms of some 1e-154.
   */
  constexpr double negligible = 1e-100;
} // namespace corotet

#endif
