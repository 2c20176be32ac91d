// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Positions on the Hilbert curve are the same as deal.II's.

#include <corotet/mesh/hilbert_curve.h>

#include <deal.II/base/utilities.h>

#include <gtest/gtest.h>

#include <random>

using namespace corotet;

TEST(HilbertCurve, PlacesAreThoseOfDealII)
{
  constexpr std::uint32_t                      most = (1u << hilbert_bits) - 1;
  std::mt19937                                 random;
  std::vector<std::array<std::uint32_t, 3>>    points{{{0, 0, 0}},
                                                      {{most, most, most}},
                                                      {{most, 0, 0}},
                                                      {{0, 0, most}},
                                                      {{1, 2, 4}}};
  std::uniform_int_distribution<std::uint32_t> below(0, most);
  // Coordinates have all magnitudes, down to those of the smallest cubes.
  for (unsigned int i = 0; i < 1000; ++i)
    points.push_back({{below(random) >> i % hilbert_bits,
                       below(random),
                       below(random) >> i % 7}});
  std::vector<std::array<std::uint64_t, 3>> wide;
  for (const auto &point : points)
    wide.push_back({{point[0], point[1], point[2]}});
  const auto expected =
    dealii::Utilities::inverse_Hilbert_space_filling_curve<3>(wide,
                                                              hilbert_bits);
  for (unsigned int i = 0; i < points.size(); ++i)
    EXPECT_EQ(place_on_hilbert_curve(points[i]),
              dealii::Utilities::pack_integers<3>(expected[i], hilbert_bits))
      << i;
}
