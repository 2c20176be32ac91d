// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "sewing.h"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

namespace corotet::gmsh_program
{
  namespace
  {
    // The surfaces that meet at each curve.
    struct Joints
    {
      // The surfaces that have each curve at their edge; a surface that closes
      // there (a cylinder, say) is listed twice.
      std::map<int, std::vector<int>> surfaces;

      explicit Joints(const gmsh::vectorpair &all)
      {
        for (const auto &surface : all)
          {
            gmsh::vectorpair curves;
            gmsh::model::getBoundary({surface}, curves, false, false);
            for (const auto &[dimension, curve] : curves)
              surfaces[curve].push_back(surface.second);
          }
      }


      // The number of curves where one surface ends alone, or more than two
      // meet.
      unsigned int
      count_open() const
      {
        return std::ranges::count_if(surfaces, [](const auto &joint) {
          return joint.second.size() != 2;
        });
      }


      // Sets of surfaces that are connected by curves.
      std::vector<std::vector<int>>
      shells(const gmsh::vectorpair &all) const
      {
        std::map<int, int> root;
        for (const auto &[dimension, surface] : all)
          root[surface] = surface;
        const auto find = [&](int surface) {
          while (root[surface] != surface)
            surface = root[surface] = root[root[surface]];
          return surface;
        };
        for (const auto &[curve, meeting] : surfaces)
          for (const int surface : meeting)
            root[find(surface)] = find(meeting.front());
        std::map<int, std::vector<int>> parts;
        for (const auto &[dimension, surface] : all)
          parts[find(surface)].push_back(surface);
        std::vector<std::vector<int>> result;
        for (const auto &[first, part] : parts)
          result.push_back(part);
        return result;
      }
    };



    void
    import(const GmshRequest &request, const bool sew, const double tolerance)
    {
      gmsh::clear();
      gmsh::option::setNumber("Geometry.OCCSewFaces", sew ? 1 : 0);
      gmsh::option::setNumber("Geometry.Tolerance", tolerance);
      gmsh::vectorpair shapes;
      gmsh::model::occ::importShapes(request.path,
                                     shapes,
                                     true,
                                     request.format);
      gmsh::model::occ::synchronize();
    }



    // A closed surface, and the volume inside.
    struct Shell
    {
      int    loop;
      int    volume;
      double content;
      // The lowest and highest coordinates of the volume.
      std::array<double, 6> box = {};
      // The index of the smallest shell around this one, and the number of
      // shells around it.
      int          parent = -1;
      unsigned int depth  = 0;
    };


    std::vector<Shell>
    fill(const std::vector<std::vector<int>> &shells)
    {
      std::vector<Shell> result;
      for (const auto &surfaces : shells)
        {
          const int loop    = gmsh::model::occ::addSurfaceLoop(surfaces);
          const int volume  = gmsh::model::occ::addVolume({loop});
          double    content = 0;
          gmsh::model::occ::getMass(3, volume, content);
          result.push_back({loop, volume, content});
        }
      gmsh::model::occ::synchronize();
      for (auto &[loop, volume, content, x, parent, depth] : result)
        gmsh::model::getBoundingBox(
          3, volume, x[0], x[1], x[2], x[3], x[4], x[5]);
      // Sorted by volume, the first shell around another one is its parent.
      std::ranges::sort(result, {}, &Shell::content);
      return result;
    }


    // The corners of a volume, and the middles of its surfaces, unless a
    // surface has a hole there.
    std::vector<double>
    points_around(const int volume)
    {
      std::vector<double> result, low, high, point;
      gmsh::vectorpair    parts;
      gmsh::model::getBoundary({{3, volume}}, parts, false, false, true);
      for (const auto &[dimension, corner] : parts)
        {
          gmsh::model::getValue(0, corner, {}, point);
          result.insert(result.end(), point.begin(), point.end());
        }
      gmsh::model::getBoundary({{3, volume}}, parts, false, false);
      for (const auto &[dimension, surface] : parts)
        {
          gmsh::model::getParametrizationBounds(2, surface, low, high);
          const std::vector<double> middle = {(low[0] + high[0]) / 2,
                                              (low[1] + high[1]) / 2};
          if (gmsh::model::isInside(2, surface, middle, true) == 0)
            continue;
          gmsh::model::getValue(2, surface, middle, point);
          result.insert(result.end(), point.begin(), point.end());
        }
      return result;
    }



    // Whether one shell is inside of another, or touches it from inside.
    bool
    is_inside(const Shell &inner, const Shell &outer)
    {
      for (unsigned int d = 0; d < 3; ++d)
        {
          // The accuracy of bounding boxes is some 1e-7 of their size.
          const double gap = 1e-5 * (outer.box[3 + d] - outer.box[d]);
          if (inner.box[d] < outer.box[d] - gap ||
              inner.box[3 + d] > outer.box[3 + d] + gap)
            return false;
        }
      const std::vector<double> points = points_around(inner.volume);
      return gmsh::model::isInside(3, outer.volume, points) ==
             static_cast<int>(points.size() / 3);
    }



    // Makes solids without the hollows in them: from the outside to the inside,
    // every second shell encloses a hollow. (Solids may touch from outside.)
    gmsh::vectorpair
    solids_between(std::vector<Shell> shells)
    {
      for (std::size_t i = shells.size(); i-- > 0;)
        for (std::size_t j = i + 1; j < shells.size(); ++j)
          if (is_inside(shells[i], shells[j]))
            {
              shells[i].parent = j;
              shells[i].depth  = shells[j].depth + 1;
              break;
            }
      gmsh::vectorpair result;
      for (std::size_t j = 0; j < shells.size(); ++j)
        if (shells[j].depth % 2 == 0)
          {
            std::vector<int> loops = {shells[j].loop};
            for (std::size_t i = 0; i < j; ++i)
              if (shells[i].parent == static_cast<int>(j))
                loops.push_back(shells[i].loop);
            const int hollow =
              loops.size() > 1 ? gmsh::model::occ::addVolume(loops) : 0;
            result.emplace_back(3, hollow > 0 ? hollow : shells[j].volume);
            if (hollow > 0)
              gmsh::model::occ::remove({{3, shells[j].volume}});
          }
        else
          gmsh::model::occ::remove({{3, shells[j].volume}});
      gmsh::model::occ::synchronize();
      // Solids have copies of surfaces that were mended: the unused ones are
      // removed.
      gmsh::vectorpair surfaces, unused;
      gmsh::model::getEntities(surfaces, 2);
      for (const auto &surface : surfaces)
        {
          std::vector<int> solids, curves;
          gmsh::model::getAdjacencies(2, surface.second, solids, curves);
          if (solids.empty())
            unused.push_back(surface);
        }
      gmsh::model::occ::remove(unused);
      gmsh::model::occ::synchronize();
      return result;
    }
  } // namespace



  gmsh::vectorpair
  sew_solids(const GmshRequest &request, std::string &remark)
  {
    // Surfaces that end in a point, such as that of a cone, get a degenerate
    // edge there.
    gmsh::option::setNumber("Geometry.OCCFixDegenerated", 1);
    double accuracy = 0;
    gmsh::option::getNumber("Geometry.Tolerance", accuracy);
    import(request, false, accuracy);
    gmsh::vectorpair surfaces;
    gmsh::model::getEntities(surfaces, 2);
    if (surfaces.empty())
      throw std::runtime_error(
        "the geometry has neither solids nor surfaces: is the rest missing?");
    double x[6];
    gmsh::model::getBoundingBox(-1, -1, x[0], x[1], x[2], x[3], x[4], x[5]);
    const double size = std::hypot(x[3] - x[0], x[4] - x[1], x[5] - x[2]);

    unsigned int n_open = 0;
    for (const double gap : {1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3})
      {
        import(request, true, gap * size);
        gmsh::model::getEntities(surfaces, 2);
        const Joints joints(surfaces);
        n_open = joints.count_open();
        if (n_open == 0)
          {
            gmsh::option::setNumber("Geometry.Tolerance", accuracy);
            char length[32];
            std::snprintf(length, sizeof(length), "%.2g", gap * size);
            remark = "surfaces are sewn to solids, with gaps of less than " +
                     std::string(length) + " between their edges";
            return solids_between(fill(joints.shells(surfaces)));
          }
      }
    throw std::runtime_error(
      "the geometry has no solid: found " + std::to_string(surfaces.size()) +
      " surfaces, which do not close (edges where there are not two: " +
      std::to_string(n_open) +
      "); needed are solids, or surfaces around them with gaps of at most a "
      "thousandth of the size of all");
  }
} // namespace corotet::gmsh_program
