// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "nearest_triangle.h"

#include <algorithm>
#include <limits>

namespace corotet
{
  namespace
  {
    using dealii::Point;

    double
    distance_from_segment(const Point<3> &x,
                          const Point<3> &a,
                          const Point<3> &b)
    {
      const auto   ab = b - a;
      const double s  = std::clamp((x - a) * ab / (ab * ab), 0., 1.);
      return x.distance(a + s * ab);
    }
  } // namespace



  double
  distance_from_triangle(const Point<3>                &x,
                         const std::array<Point<3>, 3> &corners)
  {
    const auto [a, b, c] = corners;
    const auto   normal  = dealii::cross_product_3d(b - a, c - a);
    const double area_2  = normal * normal;
    // The foot of the perpendicular is in the triangle if it is on the inner
    // side of all edges.
    const bool is_above =
      dealii::cross_product_3d(b - a, x - a) * normal >= 0 &&
      dealii::cross_product_3d(c - b, x - b) * normal >= 0 &&
      dealii::cross_product_3d(a - c, x - c) * normal >= 0;
    if (is_above && area_2 > 0)
      return std::abs((x - a) * normal) / std::sqrt(area_2);
    return std::min({distance_from_segment(x, a, b),
                     distance_from_segment(x, b, c),
                     distance_from_segment(x, c, a)});
  }



  NearestTriangle::NearestTriangle(const TriangleSurface &surface)
    : surface(surface)
  {
    std::vector<Entry> boxes;
    boxes.reserve(surface.triangles.size());
    for (unsigned int t = 0; t < surface.triangles.size(); ++t)
      {
        const auto points = corners(t);
        boxes.emplace_back(dealii::BoundingBox<3>(std::vector<Point<3>>(
                             points.begin(), points.end())),
                           t);
      }
    tree = dealii::pack_rtree(boxes);
  }



  unsigned int
  NearestTriangle::operator()(const Point<3> &x) const
  {
    namespace bgi       = boost::geometry::index;
    unsigned int result = 0;
    double       least  = std::numeric_limits<double>::max();
    // The query returns boxes in the order of their distances.
    for (auto entry = tree.qbegin(bgi::nearest(x, tree.size()));
         entry != tree.qend() &&
         boost::geometry::distance(x, entry->first) <= least;
         ++entry)
      if (const double distance =
            distance_from_triangle(x, corners(entry->second));
          distance < least)
        {
          least  = distance;
          result = entry->second;
        }
    return result;
  }



  std::array<Point<3>, 3>
  NearestTriangle::corners(const unsigned int t) const
  {
    const TriangleSurface::Triangle &triangle = surface.triangles[t];
    return {{surface.vertices[triangle[0]],
             surface.vertices[triangle[1]],
             surface.vertices[triangle[2]]}};
  }
} // namespace corotet
