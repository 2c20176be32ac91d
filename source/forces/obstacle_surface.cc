// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Obstacles as triangles, to be drawn.

#include <corotet/forces/obstacle.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    constexpr unsigned int n_around = 48, n_rings = 24;

    // Two directions normal to a unit vector and to each other.
    std::pair<Tensor<1, 3>, Tensor<1, 3>>
    tangents(const Tensor<1, 3> &n)
    {
      Tensor<1, 3> axis;
      unsigned int smallest = 0;
      for (unsigned int a = 1; a < 3; ++a)
        if (std::abs(n[a]) < std::abs(n[smallest]))
          smallest = a;
      axis[smallest]       = 1;
      Tensor<1, 3> tangent = cross_product_3d(n, axis);
      tangent /= tangent.norm();
      return {tangent, cross_product_3d(n, tangent)};
    }

    Obstacle::Surface
    square(const Point<3> &middle, const Tensor<1, 3> &n, const double half)
    {
      const auto [s, t] = tangents(n);
      return {{middle - half * s - half * t,
               middle + half * s - half * t,
               middle + half * s + half * t,
               middle - half * s + half * t},
              {{{0, 1, 2}}, {{0, 2, 3}}}};
    }

    Obstacle::Surface
    box(const Point<3> &a, const Point<3> &b)
    {
      Obstacle::Surface result;
      for (unsigned int corner = 0; corner < 8; ++corner)
        {
          Point<3> x;
          for (unsigned int d = 0; d < 3; ++d)
            x[d] = (corner >> d) % 2 == 0 ? std::min(a[d], b[d]) :
                                            std::max(a[d], b[d]);
          result.points.push_back(x);
        }
      // Bit d of a corner's number is set on the upper side along d.
      for (unsigned int d = 0; d < 3; ++d)
        {
          const unsigned int s = 1u << (d + 1) % 3, t = 1u << (d + 2) % 3;
          result.triangles.push_back({{0, t, s + t}});
          result.triangles.push_back({{0, s + t, s}});
          const unsigned int upper = 1u << d;
          result.triangles.push_back({{upper, upper + s + t, upper + t}});
          result.triangles.push_back({{upper, upper + s, upper + s + t}});
        }
      return result;
    }

    // The surface of revolution about the axis through @p origin that rings
    // make, given as (distance along the axis, radius); the first and the last
    // ring are points.
    Obstacle::Surface
    revolve(const Point<3>                               &origin,
            const Tensor<1, 3>                           &axis,
            const std::vector<std::pair<double, double>> &rings)
    {
      const auto [s, t] = tangents(axis);
      Obstacle::Surface result;
      for (const auto &[along, radius] : rings)
        for (unsigned int i = 0; i < (radius == 0 ? 1 : n_around); ++i)
          {
            const double angle = 2 * dealii::numbers::PI * i / n_around;
            result.points.push_back(
              origin + along * axis +
              radius * (std::cos(angle) * s + std::sin(angle) * t));
          }
      const unsigned int last = result.points.size() - 1;
      for (unsigned int i = 0; i < n_around; ++i)
        {
          const unsigned int next = (i + 1) % n_around;
          result.triangles.push_back({{0, 1 + next, 1 + i}});
          for (unsigned int ring = 0; ring + 3 < rings.size(); ++ring)
            {
              const unsigned int lower = 1 + ring * n_around,
                                 upper = lower + n_around;
              result.triangles.push_back(
                {{lower + i, lower + next, upper + next}});
              result.triangles.push_back(
                {{lower + i, upper + next, upper + i}});
            }
          result.triangles.push_back(
            {{last, last - n_around + i, last - n_around + next}});
        }
      return result;
    }
  } // namespace

  Obstacle::Surface
  Obstacle::surface(const Point<3> &middle, const double half) const
  {
    const auto point = [&](const unsigned int i) {
      return Point<3>(numbers[i], numbers[i + 1], numbers[i + 2]);
    };
    switch (kind)
      {
        case Kind::plane:
          return square(middle - ((middle - point(0)) * direction) * direction,
                        direction,
                        half);
        case Kind::box:
          return box(point(0), point(3));
        case Kind::sphere:
          {
            std::vector<std::pair<double, double>> rings;
            for (unsigned int i = 0; i <= n_rings; ++i)
              {
                const double angle = dealii::numbers::PI * i / n_rings;
                rings.emplace_back(-numbers[3] * std::cos(angle),
                                   i % n_rings == 0 ?
                                     0. :
                                     numbers[3] * std::sin(angle));
              }
            return revolve(point(0), Tensor<1, 3>({0, 0, 1}), rings);
          }
        case Kind::cylinder:
          {
            const double length = point(3).distance(point(0));
            return revolve(
              point(0),
              direction,
              {{0., 0.}, {0., numbers[6]}, {length, numbers[6]}, {length, 0.}});
          }
      }
    return {};
  }
} // namespace corotet
