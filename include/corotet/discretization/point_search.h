// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_point_search_h
#define corotet_discretization_point_search_h

#include <corotet/discretization/discretization.h>
#include <corotet/mesh/curved_cells.h>

#include <array>
#include <optional>
#include <vector>

namespace corotet
{
  /**
   * Finds points of the body at rest in cells, however thin and curved these
   * are.
   *
   * A curved cell is divided into eight parts recursively, wherever a part may
   * contain the point, until the map of the part is almost affine: from there
   * Newton's method finds the point if it is in the part. Bounds of the map
   * exclude parts that cannot contain the point, so none is missed.
   *
   * @p discretization must outlive this object.
   */
  class PointSearch
  {
  public:
    /// The distance by which a point may be beyond a face of a cell and yet
    /// belong to it, in lengths of the cell's longest edge: coordinates of
    /// points on the surface have round-off.
    static constexpr double tolerance = 1e-8;

    /// A bound of polynomials of degree 2 or 3 that are zero at the vertices,
    /// as a multiple of their largest value at the nodes: the sum of the
    /// absolute values of the other nodes' functions is at most 1.5 and 2.77.
    static constexpr double growth = 3;

    explicit PointSearch(const Discretization &discretization);

    /// The reference coordinates of the point @p x [m] in local cell @p cell,
    /// if the point belongs to it. Not collective.
    std::optional<dealii::Point<3>>
    find(const unsigned int cell, const dealii::Point<3> &x) const;

  private:
    /// A point that is sought in a curved cell.
    struct Target
    {
      unsigned int     cell;
      dealii::Point<3> x;
      /// The distance that is allowed [m].
      double distance;
    };

    /// A part of a curved cell: a tetrahedron in reference coordinates.
    struct Part
    {
      unsigned int                    level;
      std::array<dealii::Point<3>, 4> corners;
      /// Images of the part's own map points, minus the point sought [m].
      std::vector<dealii::Point<3>> nodes;
    };

    /// Bounds of f = d . (x(xi) - x) in a part, for a direction d [1/m].
    struct Bounds
    {
      /// Whether f is zero somewhere in the part, or nearly.
      bool may_contain;
      /// The largest difference at the nodes between f and the affine function
      /// with the same values at the corners.
      double deviation;
    };

    std::optional<dealii::Point<3>>
    find_in_part(const Target &target, const Part &part) const;

    std::optional<dealii::Point<3>>
    find_from(const Target &target, const dealii::Point<3> &start) const;

    Bounds
    bounds(const Target               &target,
           const Part                 &part,
           const dealii::Tensor<1, 3> &direction) const;

    Part
    child(const Part &part, const unsigned int number) const;

    const Discretization               *discretization;
    const std::vector<dealii::Point<3>> points;
    /// The map points of the eight children of a part.
    const MapAtPoints children;
  };
} // namespace corotet

#endif
