// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_obstacle_h
#define corotet_forces_obstacle_h

#include <corotet/base/expression.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * A rigid shape that bodies touch, as a user writes it:
   * - plane x y z nx ny nz: all that is behind the plane through a point; the
   *   normal points to where the body is,
   * - box x y z x y z: between two corners [m],
   * - sphere x y z r: around a point [m],
   * - cylinder x y z x y z r: around the axis between two points [m],
   * - not SHAPE: all that is outside of a shape, which the body is inside of.
   *
   * It moves without turning.
   */
  class Obstacle
  {
  public:
    /// The place of a point relative to the obstacle.
    struct Gap
    {
      /// The distance [m] of a point inside of a shape from its surface, less
      /// than zero; for points outside, at most their distance. The other way
      /// round with "not".
      double distance;
      /// The gradient of the distance, of length one: the outward normal of the
      /// surface.
      dealii::Tensor<1, 3> normal;
    };

    /// Triangles, without the obstacle's motion.
    struct Surface
    {
      std::vector<dealii::Point<3>>            points;
      std::vector<std::array<unsigned int, 3>> triangles;
    };

    /// Throws InputError that blames @p entry if @p shape is none.
    Obstacle(const std::string &name,
             const std::string &shape,
             const std::string &entry);

    /// Moves the obstacle by a displacement [m], an expression of three
    /// components in t, given by @p entry. Throws InputError.
    void
    set_motion(const std::string    &displacement,
               const std::string    &entry,
               const TableFunctions &tables);

    const std::string &
    name() const
    {
      return the_name;
    }

    bool
    is_moving() const
    {
      return motion && motion->depends_on_time();
    }

    /// The displacement at a time [m]. Throws WrongValueError if it is not
    /// finite, as does velocity().
    dealii::Tensor<1, 3>
    displacement(const double time) const;

    /// The velocity at a time [m/s].
    dealii::Tensor<1, 3>
    velocity(const double time) const;

    /// The largest coordinate or radius of the shape [m].
    double
    size() const;

    /// Whether the body is inside of the shape ("not").
    bool
    is_hollow() const
    {
      return hollow;
    }

    /// Its surface; of planes a square around the point nearest to @p middle,
    /// whose sides have twice the length @p half [m].
    Surface
    surface(const dealii::Point<3> &middle, const double half) const;

    /// The gap of a point, the obstacle being where it is without motion.
    Gap
    gap(const dealii::Point<3> &x) const;

  private:
    enum class Kind
    {
      plane,
      box,
      sphere,
      cylinder
    };

    Gap
    gap_of_shape(const dealii::Point<3> &x) const;

    std::string         the_name;
    Kind                kind;
    bool                hollow = false;
    std::vector<double> numbers;
    /// The normal of a plane, or the direction of a cylinder's axis.
    dealii::Tensor<1, 3>      direction;
    std::optional<Expression> motion;
    std::string               motion_entry;
  };
} // namespace corotet

#endif
