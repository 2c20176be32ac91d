// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/text.h>
#include <corotet/discretization/rigid_motions.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

namespace corotet
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    // Rounds numbers that differ by round-off to the same number: a multiple of
    // some 1e-9 of a length.
    double
    without_round_off(const double x, const double length)
    {
      const double unit = std::pow(10., std::floor(std::log10(length)) - 9);
      // Adding 0. makes -0. positive.
      return std::round(x / unit) * unit + 0.;
    }

    std::string
    place(const Point<3> &x, const double length)
    {
      return fmt::format("({:.4g}, {:.4g}, {:.4g})",
                         without_round_off(x[0], length),
                         without_round_off(x[1], length),
                         without_round_off(x[2], length));
    }

    // The name of an axis, or its components with the first nonzero one
    // positive.
    std::string
    direction(Tensor<1, 3> d)
    {
      d /= d.norm();
      unsigned int n_zero = 0, last = 0;
      for (unsigned int a = 3; a-- > 0;)
        if (std::abs(d[a]) < 1e-6)
          ++n_zero;
        else
          last = a;
      if (n_zero == 2)
        return std::string(1, "xyz"[last]);
      return place(Point<3>(d[last] > 0 ? d : -d), 1.);
    }

    struct RigidRotation
    {
      // The direction of the axis, of unit length.
      Tensor<1, 3> axis;
      // The point of the axis that is nearest to the centre.
      Point<3> point;
      // Translation along the axis [m per radian].
      double pitch;
      // The translation of the centre [m per radian].
      Tensor<1, 3> translation;
    };

    // Whether there is a point that three rotations leave in its place, and
    // where.
    bool
    have_common_point(const std::vector<RigidRotation> &rotations,
                      const Point<3>                   &centre,
                      const double                      radius,
                      Point<3>                         &point)
    {
      if (rotations.size() != 3)
        return false;
      // The axes are x, y, z, so sum_k e_k x (e_k x d) = -2 d.
      Tensor<1, 3> d;
      for (const RigidRotation &rotation : rotations)
        d += 0.5 * cross_product_3d(rotation.axis, rotation.translation);
      point = centre + d;
      return std::all_of(
        rotations.begin(), rotations.end(), [&](const RigidRotation &rotation) {
          return (rotation.translation + cross_product_3d(rotation.axis, d))
                   .norm() < 1e-6 * radius;
        });
    }

    std::vector<std::string>
    rotations_in_words(const std::vector<RigidRotation> &rotations,
                       const Point<3>                   &centre,
                       const double                      radius)
    {
      const double length = centre.norm() + radius;
      Point<3>     point;
      if (have_common_point(rotations, centre, radius, point))
        return {"rotate about any axis through " + place(point, length)};
      std::vector<std::string> words;
      for (const RigidRotation &rotation : rotations)
        {
          words.push_back(
            fmt::format("rotate about the axis through {} along {}",
                        place(rotation.point, length),
                        direction(rotation.axis)));
          if (std::abs(rotation.pitch) > 1e-6 * radius)
            words.back() +=
              fmt::format(" while it moves along it by {:.4g} m per radian",
                          without_round_off(rotation.pitch, length));
        }
      return words;
    }

    // "a, b and c"
    std::string
    enumeration(std::vector<std::string> words)
    {
      if (words.size() == 1)
        return words[0];
      const std::string last = words.back();
      words.pop_back();
      return join(words) + " and " + last;
    }
  } // namespace

  std::string
  describe(const std::vector<RigidMotions::Numbers> &motions,
           const Point<3>                           &centre,
           const double                              radius)
  {
    if (motions.size() == 6)
      return "move in any direction and rotate about any axis";
    std::vector<std::string>   directions, words;
    std::vector<RigidRotation> rotations;
    for (const RigidMotions::Numbers &m : motions)
      {
        Tensor<1, 3> t({m[0], m[1], m[2]}), w({m[3], m[4], m[5]});
        if (w.norm() < 1e-6 * t.norm())
          {
            directions.push_back(direction(t));
            continue;
          }
        // Scales the motion to one radian.
        t *= radius / w.norm();
        w /= w.norm();
        rotations.push_back(
          {w, centre + Tensor<1, 3>(cross_product_3d(w, t)), t * w, t});
      }
    if (directions.size() == 3)
      words.emplace_back("move in any direction");
    else if (!directions.empty())
      words.push_back("move along " + enumeration(directions));
    for (const std::string &text :
         rotations_in_words(rotations, centre, radius))
      words.push_back(text);
    return enumeration(words);
  }

  namespace
  {
    std::string
    name_of_part(const ConnectedParts &parts,
                 const unsigned int    part,
                 const MeshNames      &names)
    {
      const auto &centre = parts.centres[part];
      std::string text =
        "the part at " + place(centre, centre.norm() + parts.radii[part]);
      if (names.all().size() > 1)
        {
          std::vector<std::string> of_part;
          for (const unsigned int region : parts.regions[part])
            of_part.push_back("'" + names.name(region) + "'");
          text += (of_part.size() == 1 ? " of region " : " of regions ") +
                  enumeration(of_part);
        }
      return text;
    }

    // Numbers of parts depend on the number of ranks: sorts parts by their
    // places instead.
    std::vector<unsigned int>
    in_order_of_places(const ConnectedParts            &parts,
                       const std::vector<unsigned int> &some)
    {
      double length = 0;
      for (unsigned int part = 0; part < parts.n_parts; ++part)
        length =
          std::max(length, parts.centres[part].norm() + parts.radii[part]);
      std::vector<std::tuple<double, double, double, unsigned int>> order;
      for (const unsigned int part : some)
        order.emplace_back(without_round_off(parts.centres[part][0], length),
                           without_round_off(parts.centres[part][1], length),
                           without_round_off(parts.centres[part][2], length),
                           part);
      std::sort(order.begin(), order.end());
      std::vector<unsigned int> result;
      for (const auto &[x, y, z, part] : order)
        result.push_back(part);
      return result;
    }

    // The largest number of parts that are listed.
    constexpr unsigned int max_parts = 3;
  } // namespace

  std::string
  RigidMotions::name(const unsigned int part) const
  {
    return parts.n_parts == 1 ?
             "the body" :
             name_of_part(parts, part, discretization.mesh().regions());
  }

  std::string
  unconnected_parts(const Discretization &discretization,
                    const ConnectedParts &parts)
  {
    const auto [numbers, n_bodies] =
      parts.bodies(discretization.communicator());
    if (n_bodies == 1)
      return "";
    // Names the first part of each body, in the order of places.
    std::vector<unsigned int> all(parts.n_parts);
    std::iota(all.begin(), all.end(), 0u);
    std::set<unsigned int>   known;
    std::vector<std::string> words;
    for (const unsigned int part : in_order_of_places(parts, all))
      if (known.insert(numbers[part]).second && words.size() < max_parts)
        words.push_back(
          name_of_part(parts, part, discretization.mesh().regions()));
    if (n_bodies > max_parts)
      words.push_back(fmt::format("{} more", n_bodies - max_parts));
    return fmt::format(
      "there are {} bodies without a common node, and each moves "
      "on its own: {}",
      n_bodies,
      enumeration(words));
  }

  std::string
  RigidMotions::description() const
  {
    std::vector<unsigned int> moving;
    for (unsigned int part = 0; part < parts.n_parts; ++part)
      if (!motions_of(part).empty())
        moving.push_back(part);
    std::vector<std::string> words;
    for (const unsigned int part : in_order_of_places(parts, moving))
      if (words.size() < max_parts)
        words.push_back(
          name(part) + " can " +
          describe(motions_of(part), parts.centres[part], parts.radii[part]));
    std::string text = join(words, "; ");
    if (moving.size() > max_parts)
      text +=
        fmt::format("; {} more parts can move", moving.size() - max_parts);
    return text;
  }
} // namespace corotet
