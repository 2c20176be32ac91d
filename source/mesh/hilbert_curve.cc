// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/hilbert_curve.h>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <utility>
#include <vector>

namespace corotet
{
  namespace
  {
    // The orientation of the curve in a cube.
    struct Orientation
    {
      // For each axis of the curve, the coordinate along it, and whether it
      // runs backwards.
      std::array<unsigned int, 3> axes{{0, 1, 2}};
      std::array<unsigned int, 3> is_reversed{{0, 0, 0}};
      // Whether the curve runs from its end to its beginning.
      unsigned int is_backward = 0;

      auto
      operator<=>(const Orientation &) const = default;
    };



    // Finds the cube at @p octant of a cube with the orientation @p from, which
    // is divided into eight; @p octant has a bit for each coordinate, the first
    // one highest. Returns the number of cubes that the curve passes before,
    // and the orientation in the found cube.
    std::pair<unsigned int, Orientation>
    step(const Orientation &from, const unsigned int octant)
    {
      std::array<unsigned int, 3> bits;
      for (unsigned int i = 0; i < 3; ++i)
        bits[i] = (octant >> (2 - from.axes[i]) & 1u) ^ from.is_reversed[i];
      Orientation to = from;
      for (unsigned int i = 0; i < 3; ++i)
        if (bits[i] == 1)
          to.is_reversed[0] ^= 1u;
        else
          {
            std::swap(to.axes[0], to.axes[i]);
            std::swap(to.is_reversed[0], to.is_reversed[i]);
          }
      // Gray code.
      bits[1] ^= bits[0];
      bits[2] ^= bits[1];
      to.is_backward ^= bits[2];
      const unsigned int n_before = bits[0] << 2 | bits[1] << 1 | bits[2];
      return {from.is_backward == 1 ? 7 - n_before : n_before, to};
    }



    // The results of step() for two bits of each coordinate at a time.
    class Table
    {
    public:
      // The result for a cube in a larger one: the number of cubes that the
      // curve passes before, and the index of its orientation.
      struct Entry
      {
        std::uint8_t n_before;
        std::uint8_t orientation;
      };

      Table()
      {
        // Orientations in the order of their first occurrence.
        std::vector<Orientation> orientations(1);
        const auto               number = [&](const Orientation &orientation) {
          const auto place =
            std::find(orientations.begin(), orientations.end(), orientation);
          const std::size_t n = place - orientations.begin();
          if (place == orientations.end())
            orientations.push_back(orientation);
          return static_cast<std::uint8_t>(n);
        };
        for (std::size_t n = 0; n < orientations.size(); ++n)
          for (unsigned int octant = 0; octant < 8; ++octant)
            {
              const auto [n_before, half] = step(orientations[n], octant);
              if (n == 0)
                first[octant] = {static_cast<std::uint8_t>(n_before),
                                 number(half)};
              for (unsigned int inner = 0; inner < 8; ++inner)
                {
                  const auto [n_inner, quarter] = step(half, inner);
                  entries.push_back(
                    {static_cast<std::uint8_t>(8 * n_before + n_inner),
                     number(quarter)});
                }
            }
      }

      // The place of a point. @p interleaved has the bits of the three
      // coordinates in turns.
      std::uint64_t
      place(const std::uint64_t interleaved) const
      {
        static_assert(hilbert_bits % 2 == 1);
        Entry         entry = first[interleaved >> (3 * (hilbert_bits - 1))];
        std::uint64_t place = entry.n_before;
        for (int shift = 3 * (hilbert_bits - 3); shift >= 0; shift -= 6)
          {
            entry = entries[std::size_t(64) * entry.orientation +
                            (interleaved >> shift & 63)];
            place = place << 6 | entry.n_before;
          }
        return place;
      }

    private:
      // The entries for the eight cubes of the whole cube, as the number of
      // bits is odd.
      std::array<Entry, 8> first;
      // The entries for the 64 cubes of a quarter of the size, for each
      // orientation.
      std::vector<Entry> entries;
    };



    // Puts two zeros between the bits of @p x.
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

  std::uint64_t
  place_on_hilbert_curve(const std::array<std::uint32_t, 3> &x)
  {
    static const Table table;
    return table.place(spread(x[0]) << 2 | spread(x[1]) << 1 | spread(x[2]));
  }
} // namespace corotet
