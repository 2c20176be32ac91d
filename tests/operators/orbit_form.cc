// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Values at the points of every kind of orbit compared with Bernstein
// polynomials, the transpose, and the order of points in orbits.

#include <corotet/discretization/bernstein.h>
#include <corotet/discretization/point_orbits.h>
#include <corotet/operators/orbit_form.h>

#include <deal.II/base/exceptions.h>

#include <gtest/gtest.h>

#include <random>

#include "lanes.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  using V    = Simd<double>;
  using Kind = PointOrbit::Kind;

  /// One orbit of each kind, each with its own weight.
  std::vector<PointOrbit>
  some_orbits()
  {
    return {{Kind::centre, {{0.25, 0.25, 0.25}}, 0.1},
            {Kind::vertices, {{0.7, 0.1}}, 0.05},
            {Kind::edges, {{0.35, 0.15}}, 0.03},
            {Kind::directed_edges, {{0.5, 0.3, 0.1}}, 0.04}};
  }

  /// Barycentric coordinates of the points, as the kinds are defined.
  std::vector<std::array<double, 4>>
  points_of(const PointOrbit &orbit)
  {
    const auto                        &c = orbit.coordinates;
    std::vector<std::array<double, 4>> result;
    if (orbit.kind == Kind::centre)
      result.push_back({{c[0], c[0], c[0], c[0]}});
    else if (orbit.kind == Kind::vertices)
      for (int i = 0; i < 4; ++i)
        {
          result.push_back({{c[1], c[1], c[1], c[1]}});
          result.back()[i] = c[0];
        }
    else
      for (const auto &edge : tetrahedron::edges)
        for (int first = 0; first < (orbit.kind == Kind::edges ? 1 : 2);
             ++first)
          {
            const bool   directed = orbit.kind == Kind::directed_edges;
            const double other    = directed ? c[2] : c[1];
            result.push_back({{other, other, other, other}});
            result.back()[edge[first]]     = c[0];
            result.back()[edge[1 - first]] = directed ? c[1] : c[0];
          }
    return result;
  }

  // The tolerance is the round-off of some dozen products of numbers up to
  // three.
  constexpr double tolerance = 1e-14;

  /// Compares forms for derivatives of degree p functions, which have degree p
  /// - 1.
  template <int p>
  void
  compare()
  {
    constexpr int n = bernstein::size<p - 1>;
    V             c[n];
    for (int i = 0; i < n; ++i)
      c[i] = some_numbers(i);
    const OrbitSums<n> sums(c);
    for (PointOrbit &orbit : some_orbits())
      {
        set_factors(orbit, p);
        const auto points = points_of(orbit);
        ASSERT_EQ(points.size(), orbit.n_points());
        std::vector<V> values(points.size()), given(points.size());
        sums.evaluate(orbit, [&](const int i) -> V & { return values[i]; });
        V expected_sums[n] = {};
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            V expected{};
            given[q] = some_numbers(100 + q);
            for (int i = 0; i < n; ++i)
              {
                const double B =
                  p * bernstein::value(bernstein::multi_indices<p - 1>[i],
                                       points[q]);
                expected += B * c[i];
                expected_sums[i] += B * given[q];
              }
            expect_same(values[q], expected, tolerance);
          }
        for (const bool weighted : {false, true})
          {
            OrbitSums<n> transposed;
            V            found[n];
            transposed.add(orbit,
                           weighted ? orbit.weighted_factors : orbit.factors,
                           [&](const int i) -> const V & { return given[i]; });
            transposed.coefficients(found);
            for (int i = 0; i < n; ++i)
              expect_same(found[i],
                          (weighted ? orbit.weight : 1.) * expected_sums[i],
                          tolerance);
          }
      }
  }
} // namespace

TEST(OrbitSums, AreValuesOfBernsteinPolynomials)
{
  compare<2>();
  compare<3>();
}

TEST(PointOrbits, AreFoundInAnyOrder)
{
  std::vector<dealii::Point<3>> points;
  std::vector<double>           weights;
  for (const PointOrbit &orbit : some_orbits())
    for (const auto &lambda : points_of(orbit))
      {
        points.emplace_back(lambda[1], lambda[2], lambda[3]);
        weights.push_back(orbit.weight);
      }
  std::vector<unsigned int> order(points.size());
  for (unsigned int q = 0; q < order.size(); ++q)
    order[q] = q;
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  std::vector<dealii::Point<3>> shuffled;
  std::vector<double>           shuffled_weights;
  for (const unsigned int q : order)
    {
      shuffled.push_back(points[q]);
      shuffled_weights.push_back(weights[q]);
    }

  const auto   orbits = sort_into_orbits(shuffled, shuffled_weights);
  unsigned int q      = 0;
  ASSERT_EQ(orbits.size(), 4u);
  for (const PointOrbit &orbit : orbits)
    for (const auto &lambda : points_of(orbit))
      {
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(shuffled[q][k], lambda[k + 1], 1e-15);
        EXPECT_EQ(shuffled_weights[q], orbit.weight);
        ++q;
      }
  EXPECT_EQ(q, points.size());

  // Points are refused if one is missing, or if a weight differs in an orbit.
  points.pop_back();
  weights.pop_back();
  auto cut         = points;
  auto cut_weights = weights;
  EXPECT_THROW(sort_into_orbits(cut, cut_weights), dealii::ExcInternalError);
  points.resize(5);
  weights.resize(5);
  weights[3] += 0.01;
  EXPECT_THROW(sort_into_orbits(points, weights), dealii::ExcInternalError);
}
