// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_scaling_h
#define corotet_solvers_scaling_h

#include <corotet/operators/block_matrix.h>

namespace corotet
{
  /**
   * Units in which numbers of any size fit into single precision. They are
   * powers of two, so that division by them is exact.
   */

  /// The largest power of two that is not above @p size; 1 if that is not a
  /// positive number.
  double
  power_of_two(const double size);

  /// The power of two of the largest absolute entry of A on all ranks.
  /// Collective.
  double
  unit_of(const BlockMatrix &A);
} // namespace corotet

#endif
