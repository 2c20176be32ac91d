// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/point_orbits.h>
#include <corotet/discretization/tetrahedron.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  namespace
  {
    using Coordinates = std::array<double, 4>;

    // The tolerance for equal coordinates: far above round-off, far below the
    // distance of points.
    constexpr double tolerance = 1e-8;

    Coordinates
    barycentric(const dealii::Point<3> &x)
    {
      return {{1 - x[0] - x[1] - x[2], x[0], x[1], x[2]}};
    }

    /// The orbit of the point @p x; its coordinates start with those that occur
    /// once.
    PointOrbit
    orbit_of(const dealii::Point<3> &x)
    {
      using Kind    = PointOrbit::Kind;
      Coordinates c = barycentric(x);
      std::sort(c.begin(), c.end());
      const auto same = [&](const int i) {
        return c[i + 1] - c[i] < tolerance;
      };
      if (same(0) && same(1) && same(2))
        return {Kind::centre, {{0.25, 0.25, 0.25}}};
      if (same(1) && same(2))
        return {Kind::vertices, {{c[0], (c[1] + c[2] + c[3]) / 3}}};
      if (same(0) && same(1))
        return {Kind::vertices, {{c[3], (c[0] + c[1] + c[2]) / 3}}};
      if (same(0) && same(2))
        return {Kind::edges, {{(c[0] + c[1]) / 2, (c[2] + c[3]) / 2}}};
      if (same(0))
        return {Kind::directed_edges, {{c[2], c[3], (c[0] + c[1]) / 2}}};
      if (same(1))
        return {Kind::directed_edges, {{c[0], c[3], (c[1] + c[2]) / 2}}};
      AssertThrow(same(2), dealii::ExcInternalError());
      return {Kind::directed_edges, {{c[0], c[1], (c[2] + c[3]) / 2}}};
    }

    Coordinates
    point_of(const PointOrbit &orbit, const unsigned int i)
    {
      using Kind             = PointOrbit::Kind;
      const auto &c          = orbit.coordinates;
      Coordinates result     = {};
      const auto  set_others = [&](const double value) {
        result = {{value, value, value, value}};
      };
      switch (orbit.kind)
        {
          case Kind::centre:
            set_others(c[0]);
            break;
          case Kind::vertices:
            set_others(c[1]);
            result[i] = c[0];
            break;
          case Kind::edges:
            set_others(c[1]);
            for (const int v : tetrahedron::edges[i])
              result[v] = c[0];
            break;
          case Kind::directed_edges:
            set_others(c[2]);
            result[tetrahedron::edges[i / 2][i % 2]]     = c[0];
            result[tetrahedron::edges[i / 2][1 - i % 2]] = c[1];
            break;
        }
      return result;
    }

    double
    distance(const Coordinates &a, const Coordinates &b)
    {
      double result = 0;
      for (int k = 0; k < 4; ++k)
        result = std::max(result, std::abs(a[k] - b[k]));
      return result;
    }
  } // namespace

  std::vector<PointOrbit>
  sort_into_orbits(std::vector<dealii::Point<3>> &points,
                   std::vector<double>           &weights)
  {
    std::vector<PointOrbit> orbits;
    unsigned int            n_sorted = 0;
    while (n_sorted < points.size())
      {
        PointOrbit orbit = orbit_of(points[n_sorted]);
        orbit.weight     = weights[n_sorted];
        for (unsigned int i = 0; i < orbit.n_points(); ++i, ++n_sorted)
          {
            const Coordinates wanted = point_of(orbit, i);
            unsigned int      q      = n_sorted;
            while (q < points.size() &&
                   (distance(barycentric(points[q]), wanted) > tolerance ||
                    std::abs(weights[q] - orbit.weight) >
                      tolerance * std::abs(orbit.weight)))
              ++q;
            AssertThrow(q < points.size(), dealii::ExcInternalError());
            std::swap(points[q], points[n_sorted]);
            std::swap(weights[q], weights[n_sorted]);
            points[n_sorted]  = {wanted[1], wanted[2], wanted[3]};
            weights[n_sorted] = orbit.weight;
          }
        orbits.push_back(orbit);
      }
    return orbits;
  }

  void
  set_factors(PointOrbit &orbit, const unsigned int degree)
  {
    using Kind     = PointOrbit::Kind;
    const double a = orbit.coordinates[0], b = orbit.coordinates[1],
                 c = orbit.coordinates[2];
    auto &f        = orbit.factors;
    f              = {};
    if (degree == 2)
      switch (orbit.kind)
        {
          case Kind::centre:
            f = {{a}};
            break;
          case Kind::vertices:
          case Kind::edges:
            f = {{b, a - b}};
            break;
          case Kind::directed_edges:
            f = {{c, a - c, b - c}};
            break;
        }
    else if (degree == 3)
      switch (orbit.kind)
        {
          case Kind::centre:
            f = {{a * a}};
            break;
          case Kind::vertices:
            f = {{b * b, a * a - b * b, 2 * b * (a - b)}};
            break;
          case Kind::edges:
            f = {{b * b, 2 * b * (a - b), a * a - b * b, 2 * a * (a - b)}};
            break;
          case Kind::directed_edges:
            f = {{c * c,
                  -2 * c * c,
                  a * a - c * c,
                  2 * a * c,
                  b * b - c * c,
                  2 * b * c,
                  2 * (a * b - a * c - b * c)}};
            break;
        }
    for (unsigned int i = 0; i < PointOrbit::n_factors; ++i)
      {
        f[i] *= degree;
        orbit.weighted_factors[i] = orbit.weight * f[i];
      }
  }
} // namespace corotet
