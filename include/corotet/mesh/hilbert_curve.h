// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_hilbert_curve_h
#define corotet_mesh_hilbert_curve_h

#include <array>
#include <cstdint>

namespace corotet
{
  /// The number of bits of a coordinate; a place on the curve has 63 bits.
  inline constexpr unsigned int hilbert_bits = 21;

  /**
   * The place of a point @p x on Hilbert's curve through a cube [skilling2004].
   * It is that of dealii::Utilities::inverse_Hilbert_space_filling_curve, with
   * the bits of its three numbers in one, and is computed from a table of the
   * curve's turns. Coordinates are below 2^hilbert_bits.
   */
  std::uint64_t
  place_on_hilbert_curve(const std::array<std::uint32_t, 3> &x);
} // namespace corotet

#endif
