// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/forces/obstacle.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    const std::string allowed_shapes =
      "'plane x y z nx ny nz', 'box x y z x y z', 'sphere x y z radius', "
      "'cylinder x y z x y z radius', and 'not' before one of them for all that "
      "is outside of it";

    Point<3>
    point(const std::vector<double> &numbers, const unsigned int i)
    {
      return {numbers[i], numbers[i + 1], numbers[i + 2]};
    }

    Tensor<1, 3>
    unit_vector(const Tensor<1, 3> &v)
    {
      const double length = v.norm();
      // At the centre of a sphere or on an axis, any direction is a normal.
      return length > 0 ? v / length : Tensor<1, 3>({0, 0, 1});
    }

    // A box is where all pairs of opposite planes are.
    Obstacle::Gap
    gap_of_box(const Point<3> &x, const Point<3> &a, const Point<3> &b)
    {
      Obstacle::Gap gap{-std::numeric_limits<double>::infinity(), {}};
      for (unsigned int d = 0; d < 3; ++d)
        for (const double sign : {-1., 1.})
          {
            const double at =
              sign < 0 ? std::min(a[d], b[d]) : std::max(a[d], b[d]);
            const double distance = sign * (x[d] - at);
            if (distance > gap.distance)
              {
                gap           = {distance, {}};
                gap.normal[d] = sign;
              }
          }
      return gap;
    }

    Obstacle::Gap
    gap_of_cylinder(const Point<3>     &x,
                    const Point<3>     &from,
                    const Point<3>     &to,
                    const Tensor<1, 3> &axis,
                    const double        radius)
    {
      const double       length = to.distance(from);
      const double       along  = (x - from) * axis;
      const Tensor<1, 3> aside  = (x - from) - along * axis;
      Obstacle::Gap      gap{aside.norm() - radius, unit_vector(aside)};
      if (-along > gap.distance)
        gap = {-along, -axis};
      if (along - length > gap.distance)
        gap = {along - length, axis};
      return gap;
    }
  } // namespace

  Obstacle::Obstacle(const std::string &name,
                     const std::string &shape,
                     const std::string &entry)
    : the_name(name)
  {
    const auto refuse = [&](const std::string &what) {
      throw InputError(entry,
                       fmt::format("obstacle '{}': {}: found '{}'; allowed "
                                   "are {}",
                                   shortened(name),
                                   what,
                                   shortened(shape),
                                   allowed_shapes));
    };
    std::istringstream       text(shape);
    std::vector<std::string> words{std::istream_iterator<std::string>(text),
                                   std::istream_iterator<std::string>()};
    if (!words.empty() && words[0] == "not")
      {
        hollow = true;
        words.erase(words.begin());
      }
    const std::map<std::string, std::pair<Kind, std::size_t>> kinds{
      {"plane", {Kind::plane, 6}},
      {"box", {Kind::box, 6}},
      {"sphere", {Kind::sphere, 4}},
      {"cylinder", {Kind::cylinder, 7}}};
    const auto found = kinds.find(words.empty() ? "" : words[0]);
    if (found == kinds.end())
      refuse("this is no shape");
    kind = found->second.first;
    for (std::size_t i = 1; i < words.size(); ++i)
      if (const auto number = parse_number(words[i]);
          number && std::isfinite(*number))
        numbers.push_back(*number);
      else
        refuse("a shape has a word that is no number");
    if (numbers.size() != found->second.second)
      refuse("a shape has another number of numbers");
    if (kind == Kind::plane && point(numbers, 3).norm() == 0)
      refuse("a direction is zero");
    if (kind == Kind::cylinder && point(numbers, 0) == point(numbers, 3))
      refuse("an axis has no length");
    if ((kind == Kind::sphere || kind == Kind::cylinder) && numbers.back() <= 0)
      refuse("a radius is not positive");
    if (kind == Kind::box)
      for (unsigned int d = 0; d < 3; ++d)
        if (numbers[d] == numbers[3 + d])
          refuse("a box has no thickness");
    if (kind == Kind::plane)
      direction = unit_vector(point(numbers, 3));
    if (kind == Kind::cylinder)
      direction = unit_vector(point(numbers, 3) - point(numbers, 0));
  }

  void
  Obstacle::set_motion(const std::string    &displacement,
                       const std::string    &entry,
                       const TableFunctions &tables)
  {
    motion.emplace(displacement, 3, entry, tables);
    motion_entry = entry;
    if (motion->depends_on_space())
      throw InputError(entry,
                       fmt::format("found '{}' for '{}'; allowed: expressions "
                                   "in t, as obstacles are rigid",
                                   shortened(displacement),
                                   shortened(the_name)));
  }

  Tensor<1, 3>
  Obstacle::displacement(const double time) const
  {
    if (!motion)
      return {};
    const Tensor<1, 3> u = motion->vector_value({}, time);
    if (!std::isfinite(u.norm_square()))
      throw WrongValueError(InputError(
        motion_entry,
        fmt::format("obstacle '{}' has the displacement ({:g}, {:g}, {:g}) at "
                    "t = {:g}; allowed: finite values",
                    shortened(the_name),
                    u[0],
                    u[1],
                    u[2],
                    time)));
    return u;
  }

  Tensor<1, 3>
  Obstacle::velocity(const double time) const
  {
    Tensor<1, 3> v;
    if (!is_moving())
      return v;
    // The width matters only where the derivative is not finite.
    constexpr double width = 1e-6;
    for (unsigned int d = 0; d < 3; ++d)
      v[d] = motion->time_derivatives({}, time, width, d)[0];
    if (!std::isfinite(v.norm_square()))
      throw WrongValueError(InputError(
        motion_entry,
        fmt::format("obstacle '{}' has the velocity ({:g}, {:g}, {:g}) at t = "
                    "{:g}; allowed: finite values",
                    shortened(the_name),
                    v[0],
                    v[1],
                    v[2],
                    time)));
    return v;
  }

  double
  Obstacle::size() const
  {
    const std::size_t n    = kind == Kind::plane ? 3 : numbers.size();
    double            size = 0;
    for (std::size_t i = 0; i < n; ++i)
      size = std::max(size, std::abs(numbers[i]));
    return size;
  }

  Obstacle::Gap
  Obstacle::gap_of_shape(const Point<3> &x) const
  {
    switch (kind)
      {
        case Kind::plane:
          return {(x - point(numbers, 0)) * direction, direction};
        case Kind::box:
          return gap_of_box(x, point(numbers, 0), point(numbers, 3));
        case Kind::sphere:
          {
            const Tensor<1, 3> from_centre = x - point(numbers, 0);
            return {from_centre.norm() - numbers[3], unit_vector(from_centre)};
          }
        case Kind::cylinder:
          return gap_of_cylinder(
            x, point(numbers, 0), point(numbers, 3), direction, numbers[6]);
      }
    return {};
  }

  Obstacle::Gap
  Obstacle::gap(const Point<3> &x) const
  {
    Gap gap = gap_of_shape(x);
    if (hollow)
      {
        gap.distance = -gap.distance;
        gap.normal   = -gap.normal;
      }
    return gap;
  }
} // namespace corotet
