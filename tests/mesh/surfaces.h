// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_mesh_surfaces_h
#define corotet_tests_mesh_surfaces_h

#include <corotet/mesh/triangle_surface.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

#include "tools.h"

namespace corotet::tests
{
  using Corners = std::vector<dealii::Point<3>>;
  /// Triangles, each of which has its own corners.
  using Triangles = std::vector<Corners>;

  /// The surface of a box; with @p inwards its triangles face inwards.
  inline Triangles
  box_triangles(const dealii::Point<3> &low,
                const dealii::Point<3> &high,
                const bool              inwards = false)
  {
    const auto corner = [&](const unsigned int i) {
      return dealii::Point<3>((i & 1 ? high : low)[0],
                              (i & 2 ? high : low)[1],
                              (i & 4 ? high : low)[2]);
    };
    // The sides: bottom, top, front, back, left, right.
    const unsigned int faces[6][4] = {{0, 2, 3, 1},
                                      {4, 5, 7, 6},
                                      {0, 1, 5, 4},
                                      {2, 6, 7, 3},
                                      {0, 4, 6, 2},
                                      {1, 3, 7, 5}};
    Triangles          result;
    for (const auto &face : faces)
      for (const unsigned int i : {1u, 2u})
        result.push_back({corner(face[0]),
                          corner(face[inwards ? i + 1 : i]),
                          corner(face[inwards ? i : i + 1])});
    return result;
  }

  /// The surface of a sphere around the origin: an octahedron whose triangles
  /// are divided @p n times.
  inline Triangles
  sphere_triangles(const unsigned int n, const double radius = 1)
  {
    Triangles triangles;
    for (unsigned int i = 0; i < 8; ++i)
      {
        const dealii::Point<3> x((i & 1 ? -1 : 1) * radius, 0, 0),
          y(0, (i & 2 ? -1 : 1) * radius, 0),
          z(0, 0, (i & 4 ? -1 : 1) * radius);
        triangles.push_back((i == 0 || i == 3 || i == 5 || i == 6) ?
                              Corners{x, y, z} :
                              Corners{x, z, y});
      }
    for (unsigned int k = 0; k < n; ++k)
      {
        Triangles finer;
        for (const Corners &t : triangles)
          {
            Corners m;
            for (unsigned int i = 0; i < 3; ++i)
              {
                const auto middle = t[i] + (t[(i + 1) % 3] - t[i]) / 2;
                m.push_back(dealii::Point<3>(middle / middle.norm() * radius));
              }
            finer.push_back({t[0], m[0], m[2]});
            finer.push_back({m[0], t[1], m[1]});
            finer.push_back({m[2], m[1], t[2]});
            finer.push_back({m[0], m[1], m[2]});
          }
        triangles = finer;
      }
    return triangles;
  }

  inline Triangles
  operator+(Triangles a, const Triangles &b)
  {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  /// The volume inside of closed triangles that face outwards.
  inline double
  volume_inside(const Triangles &triangles)
  {
    double sum = 0;
    for (const Corners &t : triangles)
      sum += t[0] * dealii::cross_product_3d(t[1], t[2]) / 6;
    return sum;
  }

  inline std::string
  stl_text(const Triangles &triangles, const std::string &name = "")
  {
    std::string text = "solid " + name + "\n";
    for (const Corners &t : triangles)
      {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (const auto &x : t)
          text += fmt::format("      vertex {} {} {}\n", x[0], x[1], x[2]);
        text += "    endloop\n  endfacet\n";
      }
    return text + "endsolid " + name + "\n";
  }

  inline std::string
  stl_bytes(const Triangles &triangles)
  {
    // Binary files may begin with "solid", too.
    std::string header = "solid of a program that writes binary files";
    header.resize(80, ' ');
    const auto append = [&](const auto &number) {
      header.append(reinterpret_cast<const char *>(&number), sizeof(number));
    };
    append(static_cast<std::uint32_t>(triangles.size()));
    for (const Corners &t : triangles)
      {
        for (unsigned int i = 0; i < 3; ++i)
          append(0.f);
        for (const auto &x : t)
          for (unsigned int d = 0; d < 3; ++d)
            append(static_cast<float>(x[d]));
        append(std::uint16_t(0));
      }
    return header;
  }

  /// Vertices and the triangles that share them, as other formats have them.
  struct SharedVertices
  {
    Corners                                vertices;
    std::vector<std::vector<unsigned int>> triangles;

    explicit SharedVertices(const Triangles &from)
    {
      std::map<std::array<double, 3>, unsigned int> numbers;
      for (const Corners &t : from)
        {
          triangles.emplace_back();
          for (const auto &x : t)
            {
              const auto [found, is_new] =
                numbers.emplace(std::array<double, 3>{{x[0], x[1], x[2]}},
                                vertices.size());
              if (is_new)
                vertices.push_back(x);
              triangles.back().push_back(found->second);
            }
        }
    }
  };

  inline std::string
  obj_text(const Triangles &from)
  {
    const SharedVertices shared(from);
    std::string          text = "# A comment\nmtllib none.mtl\n";
    for (const auto &x : shared.vertices)
      text += fmt::format("v {} {} {}\n", x[0], x[1], x[2]);
    text += "vn 0 0 1\ns off\n";
    for (const auto &t : shared.triangles)
      text +=
        fmt::format("f {}//1 {}//1 {}//1\n", t[0] + 1, t[1] + 1, t[2] + 1);
    return text;
  }

  inline std::string
  off_text(const Triangles &from)
  {
    const SharedVertices shared(from);
    std::string          text = fmt::format("OFF\n# A comment\n{} {} 0\n",
                                   shared.vertices.size(),
                                   shared.triangles.size());
    for (const auto &x : shared.vertices)
      text += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
    for (const auto &t : shared.triangles)
      text += fmt::format("3 {} {} {} 255 0 0\n", t[0], t[1], t[2]);
    return text;
  }

  /// @p format: "ascii", "binary_little_endian" or "binary_big_endian".
  inline std::string
  ply_bytes(const Triangles &from, const std::string &format)
  {
    const SharedVertices shared(from);
    std::string          text =
      fmt::format("ply\nformat {} 1.0\ncomment made for a test\nelement vertex "
                  "{}\nproperty double x\nproperty double y\nproperty double "
                  "z\nproperty uchar red\nelement face {}\nproperty list uchar "
                  "int vertex_indices\nend_header\n",
                  format,
                  shared.vertices.size(),
                  shared.triangles.size());
    const auto append = [&](const auto &number) {
      std::string bytes(reinterpret_cast<const char *>(&number),
                        sizeof(number));
      if (format == "binary_big_endian")
        std::reverse(bytes.begin(), bytes.end());
      text += bytes;
    };
    for (const auto &x : shared.vertices)
      if (format == "ascii")
        text += fmt::format("{} {} {} 255\n", x[0], x[1], x[2]);
      else
        {
          for (unsigned int d = 0; d < 3; ++d)
            append(x[d]);
          append(std::uint8_t(255));
        }
    for (const auto &t : shared.triangles)
      if (format == "ascii")
        text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
      else
        {
          append(std::uint8_t(3));
          for (const unsigned int v : t)
            append(static_cast<std::int32_t>(v));
        }
    return text;
  }
} // namespace corotet::tests

#endif
