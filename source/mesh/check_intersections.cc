// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/triangle_surface.h>

#include <deal.II/numerics/rtree.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace corotet
{
  namespace
  {
    using dealii::Point;
    using Triangle    = TriangleSurface::Triangle;
    using BoundingBox = dealii::BoundingBox<3>;
    using Vector      = dealii::Tensor<1, 3>;

    // Differences below this fraction of the lengths involved are round-off, in
    // double and in extended precision.
    constexpr double crossing_tolerance = 1e-13;
    constexpr auto   extended_tolerance =
      8 * std::numeric_limits<long double>::epsilon();



    // The sign of a number, or zero if its size is at most round-off.
    int
    sign(const long double value, const long double round_off)
    {
      if (std::abs(value) <= round_off)
        return 0;
      return value > 0 ? 1 : -1;
    }



    // The orientation of four points, the sign of the tetrahedron's volume:
    // zero if they lie in one plane, up to round-off of the extended precision.
    // Corners are rounded, mostly to single precision, so plane faces are
    // slightly bent in files: signs must be right even then, or neighbouring
    // triangles seem to touch.
    int
    orientation(const Point<3> &a,
                const Point<3> &b,
                const Point<3> &c,
                const Point<3> &d)
    {
      const Vector ab = b - a, ac = c - a, ad = d - a;
      const double size   = ab.norm() * ac.norm() * ad.norm();
      const double volume = dealii::cross_product_3d(ab, ac) * ad;
      if (const int known = sign(volume, crossing_tolerance * size); known != 0)
        return known;
      std::array<long double, 3> x, y, z;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const long double origin = a[i];
          x[i]                     = b[i] - origin;
          y[i]                     = c[i] - origin;
          z[i]                     = d[i] - origin;
        }
      return sign((x[1] * y[2] - x[2] * y[1]) * z[0] +
                    (x[2] * y[0] - x[0] * y[2]) * z[1] +
                    (x[0] * y[1] - x[1] * y[0]) * z[2],
                  extended_tolerance * size);
    }



    // The orientation of three points in a plane: the sign of the triangle's
    // area.
    int
    orientation(const std::array<double, 2> &a,
                const std::array<double, 2> &b,
                const std::array<double, 2> &c)
    {
      const long double x0 = a[0], y0 = a[1];
      const long double x1 = b[0] - x0, y1 = b[1] - y0, x2 = c[0] - x0,
                        y2 = c[1] - y0;
      return sign(x1 * y2 - x2 * y1,
                  extended_tolerance * std::hypot(x1, y1) * std::hypot(x2, y2));
    }



    // Whether a segment and a triangle in one plane have a point in common.
    bool
    touch_in_plane(const std::array<Point<3>, 2> &segment,
                   const std::array<Point<3>, 3> &corners)
    {
      // Projects along the axis that is nearest to the normal.
      const Vector normal = dealii::cross_product_3d(corners[1] - corners[0],
                                                     corners[2] - corners[0]);
      unsigned int axis   = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (std::abs(normal[d]) > std::abs(normal[axis]))
          axis = d;
      using Flat      = std::array<double, 2>;
      const auto flat = [&](const Point<3> &x) {
        return Flat{{x[(axis + 1) % 3], x[(axis + 2) % 3]}};
      };
      const Flat                p = flat(segment[0]), q = flat(segment[1]);
      const std::array<Flat, 3> t{
        {flat(corners[0]), flat(corners[1]), flat(corners[2])}};
      const auto is_inside = [&](const Flat &x) {
        const int a = orientation(t[0], t[1], x),
                  b = orientation(t[1], t[2], x),
                  c = orientation(t[2], t[0], x);
        return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
      };
      if (is_inside(p) || is_inside(q))
        return true;
      // If neither end is inside, the segment crosses an edge or nothing.
      for (unsigned int i = 0; i < 3; ++i)
        {
          const Flat &a = t[i], &b = t[(i + 1) % 3];
          if (orientation(a, b, p) * orientation(a, b, q) < 0 &&
              orientation(p, q, a) * orientation(p, q, b) < 0)
            return true;
        }
      return false;
    }



    // Whether a segment and a triangle have a point in common.
    bool
    touch(const std::array<Point<3>, 2> &segment,
          const std::array<Point<3>, 3> &corners)
    {
      const int p = orientation(corners[0], corners[1], corners[2], segment[0]);
      const int q = orientation(corners[0], corners[1], corners[2], segment[1]);
      if (p == 0 && q == 0)
        return touch_in_plane(segment, corners);
      if ((p > 0 && q > 0) || (p < 0 && q < 0))
        return false;
      const int a = orientation(segment[0], segment[1], corners[0], corners[1]);
      const int b = orientation(segment[0], segment[1], corners[1], corners[2]);
      const int c = orientation(segment[0], segment[1], corners[2], corners[0]);
      return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
    }



    BoundingBox
    box_of(const std::vector<Point<3>> &points)
    {
      BoundingBox  box(points);
      const double size = box.get_boundary_points().second.distance(
        box.get_boundary_points().first);
      box.extend(crossing_tolerance * size);
      return box;
    }



    // Whether the triangles at an edge lie on each other.
    bool
    is_folded(const TriangleSurface &surface, const SurfaceEdge &edge)
    {
      const Point<3> &a   = surface.vertices[edge.from];
      const Vector    ab  = surface.vertices[edge.to] - a;
      const auto      off = [&](const unsigned int t) {
        for (const unsigned int v : surface.triangles[t])
          if (v != edge.from && v != edge.to)
            {
              const Vector r = surface.vertices[v] - a;
              return r - (r * ab) / (ab * ab) * ab;
            }
        return Vector();
      };
      const Vector r = off(edge.triangles[0]), s = off(edge.triangles[1]);
      return r * s > 0 && dealii::cross_product_3d(r, s).norm() <=
                            crossing_tolerance * r.norm() * s.norm();
    }
  } // namespace



  void
  check_intersections(const TriangleSurface &surface)
  {
    std::vector<std::pair<BoundingBox, unsigned int>> boxes;
    boxes.reserve(surface.triangles.size());
    const auto corners_of = [&](const Triangle &t) {
      return std::array<Point<3>, 3>{{surface.vertices[t[0]],
                                      surface.vertices[t[1]],
                                      surface.vertices[t[2]]}};
    };
    for (unsigned int t = 0; t < surface.triangles.size(); ++t)
      {
        const auto corners = corners_of(surface.triangles[t]);
        boxes.emplace_back(box_of({corners.begin(), corners.end()}), t);
      }
    const auto              tree = dealii::pack_rtree(boxes);
    std::set<unsigned int>  wrong;
    std::optional<Point<3>> first;
    const auto              add =
      [&](const unsigned int s, const unsigned int t, const Point<3> &x) {
        wrong.insert({s, t});
        if (!first)
          first = x;
      };
    std::vector<std::pair<BoundingBox, unsigned int>> near;
    for (const SurfaceEdge &edge : surface_edges(surface))
      {
        const std::array<Point<3>, 2> segment{
          {surface.vertices[edge.from], surface.vertices[edge.to]}};
        const Point<3> middle = segment[0] + (segment[1] - segment[0]) / 2;
        if (is_folded(surface, edge))
          add(edge.triangles[0], edge.triangles[1], middle);
        near.clear();
        tree.query(boost::geometry::index::intersects(
                     box_of({segment.begin(), segment.end()})),
                   std::back_inserter(near));
        for (const auto &[box, t] : near)
          {
            const Triangle &triangle = surface.triangles[t];
            const bool      shares_vertex =
              std::any_of(triangle.begin(),
                          triangle.end(),
                          [&](const unsigned int v) {
                            return v == edge.from || v == edge.to;
                          });
            if (!shares_vertex && touch(segment, corners_of(triangle)))
              add(edge.triangles[0], t, middle);
          }
      }
    if (!wrong.empty())
      throw InputError(
        "",
        fmt::format("{}: the surface crosses or touches itself: found {} "
                    "triangles, the first near {}; needed is a surface that "
                    "does neither",
                    surface.origin,
                    wrong.size(),
                    position(*first)));
  }
} // namespace corotet
