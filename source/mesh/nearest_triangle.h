// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_nearest_triangle_h
#define corotet_source_mesh_nearest_triangle_h

#include <corotet/mesh/triangle_surface.h>

#include <deal.II/numerics/rtree.h>


namespace corotet
{
  /// The distance of a point from a triangle.
  double
  distance_from_triangle(const dealii::Point<3>                &x,
                         const std::array<dealii::Point<3>, 3> &corners);

  /// Finds triangles of a surface, which must outlive this object.
  class NearestTriangle
  {
  public:
    explicit NearestTriangle(const TriangleSurface &surface);

    /// The number of the triangle that is nearest to a point.
    unsigned int
    operator()(const dealii::Point<3> &x) const;

  private:
    using Entry = std::pair<dealii::BoundingBox<3>, unsigned int>;

    const TriangleSurface &surface;
    dealii::RTree<Entry>   tree;

    std::array<dealii::Point<3>, 3>
    corners(const unsigned int t) const;
  };
} // namespace corotet

#endif
