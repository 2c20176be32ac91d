// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "nearest_triangle.h"
#include "selection.h"

namespace corotet::selections
{
  namespace
  {
    using dealii::Point;
    using Vector  = dealii::Tensor<1, 3>;
    using Numbers = std::vector<double>;

    struct Kind
    {
      /// The number of required numbers, and of optional ones.
      std::size_t n_numbers, n_optional;
      std::string allowed;
    };

    const std::map<std::string, Kind> kinds{
      {"box", {6, 0, "box x y z x y z"}},
      {"sphere", {4, 0, "sphere x y z radius"}},
      {"cylinder", {7, 0, "cylinder x y z x y z radius"}},
      {"plane", {6, 0, "plane x y z nx ny nz"}},
      {"normal", {3, 1, "normal nx ny nz [angle]"}},
      {"patch", {3, 1, "patch x y z [angle]"}},
      {"sharp", {0, 1, "sharp [angle]"}}};

    // The default angles [degree]: between normals and a direction, and at the
    // edges of a patch or sharp edges.
    constexpr double default_angle = 5, default_feature_angle = 40;



    [[noreturn]] void
    refuse_shape(const std::string              &what,
                 const std::vector<std::string> &words,
                 const std::string              &allowed,
                 const std::string              &entry)
    {
      throw InputError(entry,
                       fmt::format("{}: found '{}'; allowed {}",
                                   what,
                                   shortened(join(words, " ")),
                                   allowed));
    }



    // Throws the InputError about a shape that is for members of another kind.
    [[noreturn]] void
    refuse_kind(const std::string              &reason,
                const std::vector<std::string> &words,
                const Members                  &members,
                const std::string              &entry)
    {
      std::vector<std::string> allowed;
      for (const auto &[name, kind] : kinds)
        {
          const bool is_of_faces = name == "normal" || name == "patch";
          if (is_of_faces ? members.surface != nullptr || members.has_normals :
                            name != "sharp" || members.has_angles)
            allowed.push_back("'" + kind.allowed + "'");
        }
      refuse_shape("a " + members.kind + " " + reason,
                   words,
                   "are " + join(allowed),
                   entry);
    }



    Point<3>
    point(const Numbers &numbers, const std::size_t i)
    {
      return {numbers[i], numbers[i + 1], numbers[i + 2]};
    }



    // The greatest distance of the points of each member.
    template <typename Distance>
    std::vector<double>
    of_farthest_point(const Members &members, const Distance &distance)
    {
      std::vector<double> result;
      result.reserve(members.size());
      for (auto x = members.points.begin(); x != members.points.end();)
        {
          double farthest = std::numeric_limits<double>::lowest();
          for (unsigned int i = 0; i < members.n_points; ++i)
            farthest = std::max(farthest, distance(*x++));
          result.push_back(farthest - members.tolerance);
        }
      return result;
    }



    double
    distance_from_box(const Point<3> &x, const Point<3> &a, const Point<3> &b)
    {
      Vector outside;
      for (unsigned int d = 0; d < 3; ++d)
        outside[d] = std::max(
          {0., std::min(a[d], b[d]) - x[d], x[d] - std::max(a[d], b[d])});
      return outside.norm();
    }



    double
    distance_from_cylinder(const Point<3> &x,
                           const Point<3> &from,
                           const Point<3> &to,
                           const double    radius)
    {
      const Vector axis   = (to - from) / to.distance(from);
      const double along  = (x - from) * axis;
      const double beyond = std::max({0., -along, along - to.distance(from)});
      const double aside  = ((x - from) - along * axis).norm() - radius;
      return std::hypot(beyond, std::max(0., aside));
    }



    // The key of the nearest face on all ranks; the lowest key if several are
    // equally near.
    std::uint64_t
    nearest_face(const Members &faces, const std::vector<double> &distances)
    {
      namespace MPI   = dealii::Utilities::MPI;
      double shortest = std::numeric_limits<double>::infinity();
      for (const double distance : distances)
        shortest = std::min(shortest, distance);
      shortest          = MPI::min(shortest, faces.communicator);
      std::uint64_t key = std::numeric_limits<std::uint64_t>::max();
      for (std::size_t f = 0; f < distances.size(); ++f)
        if (distances[f] == shortest)
          key = std::min(key, faces.keys[f]);
      return MPI::min(key, faces.communicator);
    }



    // Adds to a patch the faces that are connected with it on this rank.
    void
    spread(std::vector<unsigned char> &is_in_patch,
           const Members              &faces,
           const double                angle)
    {
      std::vector<unsigned int> patch;
      for (unsigned int f = 0; f < is_in_patch.size(); ++f)
        if (is_in_patch[f])
          patch.push_back(f);
      for (std::size_t i = 0; i < patch.size(); ++i)
        for (const unsigned int other : faces.neighbours[patch[i]])
          if (!is_in_patch[other] &&
              degrees_between(faces.normals[patch[i]], faces.normals[other]) <=
                angle)
            {
              is_in_patch[other] = 1;
              patch.push_back(other);
            }
    }



    // A remark if the patch may have been meant to be larger: coarse meshes
    // have edges of such angles within a fillet or a hole. Otherwise empty.
    std::string
    remark_on_border(const Members                    &faces,
                     const std::vector<unsigned char> &is_in_patch,
                     const double                      angle)
    {
      constexpr double doubtful = 20;
      double           smallest = std::numeric_limits<double>::max();
      for (std::size_t f = 0; f < is_in_patch.size(); ++f)
        if (is_in_patch[f])
          for (const unsigned int other : faces.neighbours[f])
            if (!is_in_patch[other])
              smallest = std::min(smallest,
                                  degrees_between(faces.normals[f],
                                                  faces.normals[other]));
      smallest = dealii::Utilities::MPI::min(smallest, faces.communicator);
      if (smallest > angle + doubtful)
        return "";
      return fmt::format("ends at edges of {:.3g} degrees, as it does at all "
                         "above {:g}",
                         smallest,
                         angle);
    }



    // The distances of faces from a patch: zero for its faces, the distance
    // from the point for others.
    std::vector<double>
    distances_from_patch(const Members  &faces,
                         const Point<3> &x,
                         const double    angle,
                         std::string    &remark)
    {
      std::vector<double> result;
      for (auto p = faces.points.begin(); p != faces.points.end(); p += 3)
        result.push_back(distance_from_triangle(x, {{p[0], p[1], p[2]}}));
      const std::uint64_t        nearest = nearest_face(faces, result);
      std::vector<unsigned char> is_in_patch(result.size());
      for (std::size_t f = 0; f < result.size(); ++f)
        is_in_patch[f] = faces.keys[f] == nearest ? 1 : 0;
      // Repeated until no rank finds more faces.
      for (bool has_grown = true; has_grown;)
        {
          const std::vector<unsigned char> before = is_in_patch;
          spread(is_in_patch, faces, angle);
          faces.update(is_in_patch);
          has_grown = dealii::Utilities::MPI::max(is_in_patch != before ? 1 : 0,
                                                  faces.communicator) == 1;
        }
      remark = remark_on_border(faces, is_in_patch, angle);
      // A face that touches the point but does not belong to the patch is
      // outside.
      for (std::size_t f = 0; f < result.size(); ++f)
        result[f] = is_in_patch[f] ?
                      0 :
                      std::max(result[f], std::numeric_limits<double>::min());
      return result;
    }



    // The shape for edges and corners: each is as near as the nearest of its
    // faces.
    Shape
    of_nearest_face(const Shape &of_faces, const Members &members)
    {
      Shape shape{of_faces.text, of_faces.unit, {}, of_faces.remark};
      for (const std::vector<unsigned int> &faces : members.faces)
        {
          double distance = std::numeric_limits<double>::infinity();
          for (const unsigned int f : faces)
            distance = std::min(distance, of_faces.distances[f]);
          shape.distances.push_back(distance);
        }
      return shape;
    }
  } // namespace



  double
  degrees_between(const Vector &a, const Vector &b)
  {
    return std::atan2(dealii::cross_product_3d(a, b).norm(), a * b) * 180 /
           std::numbers::pi;
  }



  bool
  is_shape(const std::string &word, const Members &members)
  {
    return kinds.contains(word) &&
           (word != "sharp" || members.surface != nullptr);
  }



  Shape
  measure(const std::vector<std::string> &words,
          const Members                  &members,
          const std::string              &entry)
  {
    const std::string &name = words[0];
    const Kind        &kind = kinds.at(name);
    Numbers            n;
    const auto         refuse = [&](const std::string &what) {
      refuse_shape(what, words, "is '" + kind.allowed + "'", entry);
    };
    for (std::size_t i = 1; i < words.size(); ++i)
      if (const auto number = parse_number(words[i]))
        n.push_back(*number);
      else
        refuse("a shape has a word that is no number");
    if (n.size() < kind.n_numbers ||
        n.size() > kind.n_numbers + kind.n_optional)
      refuse("a shape has another number of numbers");
    Shape      shape{join(words, " "), "m", {}};
    const auto set_distances = [&](const auto &distance) {
      shape.distances = of_farthest_point(members, distance);
    };
    const bool is_of_faces = name == "normal" || name == "patch";
    if (is_of_faces && members.surface != nullptr)
      return of_nearest_face(measure(words, *members.surface, entry), members);
    if (is_of_faces && !members.has_normals)
      refuse_kind("has no normal and is on no patch", words, members, entry);
    if (name == "sharp" && !members.has_angles)
      refuse_kind("is not between two faces", words, members, entry);
    if ((name == "plane" && point(n, 3).norm() == 0) ||
        (name == "normal" && point(n, 0).norm() == 0))
      refuse("a direction is zero");
    if (name == "cylinder" && point(n, 0) == point(n, 3))
      refuse("an axis has no length");
    if ((name == "sphere" || name == "cylinder") && n.back() <= 0)
      refuse("a radius is not positive");
    if (((is_of_faces && n.size() > 3) || (name == "sharp" && !n.empty())) &&
        n.back() < 0)
      refuse("an angle is negative");

    if (name == "box")
      set_distances([&](const Point<3> &x) {
        return distance_from_box(x, point(n, 0), point(n, 3));
      });
    else if (name == "sphere")
      set_distances(
        [&](const Point<3> &x) { return x.distance(point(n, 0)) - n[3]; });
    else if (name == "cylinder")
      set_distances([&](const Point<3> &x) {
        return distance_from_cylinder(x, point(n, 0), point(n, 3), n[6]);
      });
    else if (name == "plane")
      set_distances([&](const Point<3> &x) {
        return std::abs((x - point(n, 0)) * point(n, 3)) / point(n, 3).norm();
      });
    else if (name == "sharp")
      {
        shape.unit = "degrees";
        for (const double angle : members.angles)
          shape.distances.push_back((n.empty() ? default_feature_angle : n[0]) -
                                    angle);
      }
    else if (name == "normal")
      {
        shape.unit = "degrees";
        for (const Vector &normal : members.normals)
          shape.distances.push_back(degrees_between(normal, point(n, 0)) -
                                    (n.size() > 3 ? n[3] : default_angle));
      }
    else
      shape.distances =
        distances_from_patch(members,
                             point(n, 0),
                             n.size() > 3 ? n[3] : default_feature_angle,
                             shape.remark);
    return shape;
  }
} // namespace corotet::selections
