// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_negligible_h
#define corotet_base_negligible_h

namespace corotet
{
  /**
   * Norms below this are as good as zero, in any unit: those of forces of a
   * body that has come to rest. Solvers divide products of two of them, which
   * from some 1e-154 on are zero.
   */
  constexpr double negligible = 1e-100;
} // namespace corotet

#endif
