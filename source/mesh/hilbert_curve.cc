// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/hilbert_curve.h>

#include <algorithm>
#include <cstddef>

namespace corotet
{
  namespace
  {
    // Points side by side, which the compiler computes with in one register.
    constexpr unsigned int n_lanes = 16;
    using Lanes                    = std::array<std::uint32_t, n_lanes>;

    // All bits set where bit @p bit of x is.
    std::uint32_t
    mask(const std::uint32_t x, const unsigned int bit)
    {
      return 0u - (x >> bit & 1u);
    }

    // The curve in a cube of half the size is turned and reflected: from the
    // largest cube to the smallest, that is undone.
    void
    turn_back(std::array<Lanes, 3> &x)
    {
      for (unsigned int bit = hilbert_bits - 1; bit > 0; --bit)
        {
          const std::uint32_t below = (1u << bit) - 1;
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int lane = 0; lane < n_lanes; ++lane)
              {
                const std::uint32_t is_set = mask(x[i][lane], bit);
                // Zero for i = 0.
                const std::uint32_t swapped = (x[0][lane] ^ x[i][lane]) & below;
                x[0][lane] ^= (is_set & below) | (~is_set & swapped);
                x[i][lane] ^= ~is_set & swapped;
              }
        }
    }

    // Gray's code.
    void
    encode(std::array<Lanes, 3> &x)
    {
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        {
          x[1][lane] ^= x[0][lane];
          x[2][lane] ^= x[1][lane];
          std::uint32_t last = 0;
          for (unsigned int bit = hilbert_bits - 1; bit > 0; --bit)
            last ^= mask(x[2][lane], bit) & ((1u << bit) - 1);
          for (unsigned int i = 0; i < 3; ++i)
            x[i][lane] ^= last;
        }
    }

    // Puts two zeros between the bits.
    std::uint64_t
    spread(const std::uint32_t x)
    {
      std::uint64_t y = x;
      y               = (y | y << 32) & 0x001f00000000ffff;
      y               = (y | y << 16) & 0x001f0000ff0000ff;
      y               = (y | y << 8) & 0x100f00f00f00f00f;
      y               = (y | y << 4) & 0x10c30c30c30c30c3;
      return (y | y << 2) & 0x1249249249249249;
    }
  } // namespace

  std::vector<std::uint64_t>
  places_on_hilbert_curve(
    const std::vector<std::array<std::uint32_t, 3>> &coordinates)
  {
    std::vector<std::uint64_t> places(coordinates.size());
    for (std::size_t begin = 0; begin < places.size(); begin += n_lanes)
      {
        const unsigned int n =
          std::min<std::size_t>(n_lanes, places.size() - begin);
        std::array<Lanes, 3> x{};
        for (unsigned int lane = 0; lane < n; ++lane)
          for (unsigned int i = 0; i < 3; ++i)
            x[i][lane] = coordinates[begin + lane][i];
        turn_back(x);
        encode(x);
        for (unsigned int lane = 0; lane < n; ++lane)
          places[begin + lane] = spread(x[0][lane]) << 2 |
                                 spread(x[1][lane]) << 1 | spread(x[2][lane]);
      }
    return places;
  }
} // namespace corotet
