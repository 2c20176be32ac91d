// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/disjoint_sets.h>
#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>
#include <corotet/mesh/triangle_surface.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface_lines.h"

namespace corotet
{
  namespace
  {
    using dealii::Point;
    using Triangle = TriangleSurface::Triangle;



    // The normal of a triangle with the length of twice its area.
    dealii::Tensor<1, 3>
    area_vector(const TriangleSurface &surface, const Triangle &triangle)
    {
      const Point<3> &p = surface.vertices[triangle[0]];
      return dealii::cross_product_3d(surface.vertices[triangle[1]] - p,
                                      surface.vertices[triangle[2]] - p);
    }



    // The solid angle of all triangles of a shell as seen from a point, divided
    // by that of a sphere: 1 or -1 inside, 0 outside.
    // A. van Oosterom, J. Strackee: The solid angle of a plane triangle. IEEE
    // Transactions on Biomedical Engineering 30 (1983).
    double
    winding_number(const TriangleSurface           &surface,
                   const std::vector<unsigned int> &shell,
                   const Point<3>                  &x)
    {
      double angle = 0;
      for (const unsigned int t : shell)
        {
          const Triangle            &triangle = surface.triangles[t];
          const dealii::Tensor<1, 3> a = surface.vertices[triangle[0]] - x,
                                     b = surface.vertices[triangle[1]] - x,
                                     c = surface.vertices[triangle[2]] - x;
          angle +=
            2 * std::atan2(a * dealii::cross_product_3d(b, c),
                           a.norm() * b.norm() * c.norm() + (a * b) * c.norm() +
                             (b * c) * a.norm() + (c * a) * b.norm());
        }
      return angle / (4 * std::numbers::pi);
    }
  } // namespace



  TriangleSurface
  read_triangle_file(const std::string &path, const MeshFormat format)
  {
    TriangleSurface surface;
    surface.origin    = path;
    std::string bytes = read_whole_file(path);
    // Text has no zero bytes.
    if (bytes.starts_with(byte_order_mark) &&
        bytes.find('\0') == std::string::npos)
      bytes.erase(0, byte_order_mark.size());
    if (format == MeshFormat::stl)
      surface_files::read_stl(bytes, surface);
    else if (format == MeshFormat::ply)
      surface_files::read_ply(bytes, surface);
    else if (format == MeshFormat::obj)
      surface_files::read_obj(bytes, surface);
    else
      surface_files::read_off(bytes, surface);
    if (surface.triangles.empty())
      throw InputError("", path + ": the file has no triangle");
    return surface;
  }



  std::vector<SurfaceEdge>
  surface_edges(const TriangleSurface &surface)
  {
    std::vector<std::array<unsigned int, 3>> halves;
    halves.reserve(3 * surface.triangles.size());
    for (unsigned int t = 0; t < surface.triangles.size(); ++t)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int a = surface.triangles[t][i];
          const unsigned int b = surface.triangles[t][(i + 1) % 3];
          halves.push_back({{std::min(a, b), std::max(a, b), t}});
        }
    std::sort(halves.begin(), halves.end());
    std::vector<SurfaceEdge> edges;
    edges.reserve(halves.size() / 2);
    for (std::size_t i = 0; i + 1 < halves.size(); i += 2)
      edges.push_back(
        {halves[i][0], halves[i][1], {{halves[i][2], halves[i + 1][2]}}});
    return edges;
  }



  SurfaceShells
  surface_shells(const TriangleSurface          &surface,
                 const std::vector<SurfaceEdge> &edges)
  {
    SurfaceShells result;
    DisjointSets  pieces(surface.triangles.size());
    for (const SurfaceEdge &edge : edges)
      pieces.unite(edge.triangles[0], edge.triangles[1]);
    result.of_triangle = pieces.numbers().first;

    struct Shell
    {
      std::vector<unsigned int> triangles;
      Point<3>                  low, high;
      std::vector<unsigned int> around;
    };
    std::vector<Shell> shells;
    for (unsigned int t = 0; t < surface.triangles.size(); ++t)
      {
        shells.resize(
          std::max<std::size_t>(shells.size(), result.of_triangle[t] + 1));
        Shell &shell = shells[result.of_triangle[t]];
        if (shell.triangles.empty())
          shell.low = shell.high = surface.vertices[surface.triangles[t][0]];
        shell.triangles.push_back(t);
        for (const unsigned int v : surface.triangles[t])
          for (unsigned int d = 0; d < 3; ++d)
            {
              shell.low[d]  = std::min(shell.low[d], surface.vertices[v][d]);
              shell.high[d] = std::max(shell.high[d], surface.vertices[v][d]);
            }
      }
    // Shells do not cross, so one vertex tells whether the whole shell is
    // inside.
    for (Shell &shell : shells)
      {
        const Point<3> &x =
          surface.vertices[surface.triangles[shell.triangles[0]][0]];
        for (unsigned int other = 0; other < shells.size(); ++other)
          {
            const Shell &around      = shells[other];
            bool         can_contain = &around != &shell;
            for (unsigned int d = 0; d < 3; ++d)
              can_contain =
                can_contain && around.low[d] < x[d] && x[d] < around.high[d];
            if (can_contain &&
                std::abs(winding_number(surface, around.triangles, x)) > 0.5)
              shell.around.push_back(other);
          }
      }
    std::vector<unsigned int> body_of_shell(shells.size());
    for (unsigned int s = 0; s < shells.size(); ++s)
      if (shells[s].around.size() % 2 == 0)
        {
          body_of_shell[s] = result.bodies.size();
          result.bodies.push_back({{s}});
        }
    for (unsigned int s = 0; s < shells.size(); ++s)
      if (shells[s].around.size() % 2 == 1)
        for (const unsigned int other : shells[s].around)
          if (shells[other].around.size() + 1 == shells[s].around.size())
            result.bodies[body_of_shell[other]].shells.push_back(s);
    return result;
  }



  std::vector<unsigned int>
  surface_patches(const TriangleSurface          &surface,
                  const std::vector<SurfaceEdge> &edges,
                  const double                    feature_angle)
  {
    const double least = std::cos(feature_angle * std::numbers::pi / 180);
    DisjointSets pieces(surface.triangles.size());
    for (const SurfaceEdge &edge : edges)
      {
        const auto [i, j] = edge.triangles;
        const auto a      = area_vector(surface, surface.triangles[i]),
                   b      = area_vector(surface, surface.triangles[j]);
        if (surface.groups[i] == surface.groups[j] &&
            a * b >= least * a.norm() * b.norm())
          pieces.unite(i, j);
      }
    return pieces.numbers().first;
  }
} // namespace corotet
