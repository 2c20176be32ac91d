// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Closed surfaces of triangles: file formats, repairs and refusals.

#include <gtest/gtest.h>

#include <numbers>
#include <regex>

#include "surfaces.h"

namespace
{
  using namespace corotet;
  using namespace corotet::tests;
  using dealii::Point;

  const Triangles unit_box = box_triangles({0, 0, 0}, {1, 1, 1});



  struct SurfaceFiles : public testing::Test
  {
    TemporaryFolder folder;

    // The repaired surface of an STL file with these triangles.
    TriangleSurface
    mended(const Triangles &triangles) const
    {
      const std::string path = folder.write("mended.stl", stl_text(triangles));
      TriangleSurface   surface = read_triangle_file(path, MeshFormat::stl);
      mend_surface(surface);
      check_intersections(surface);
      return surface;
    }

    std::string
    refusal_of(const Triangles &triangles) const
    {
      return refusal([&] { mended(triangles); });
    }

    static double
    volume_inside(const TriangleSurface &surface)
    {
      Triangles triangles;
      for (const auto &t : surface.triangles)
        triangles.push_back({surface.vertices[t[0]],
                             surface.vertices[t[1]],
                             surface.vertices[t[2]]});
      return tests::volume_inside(triangles);
    }
  };



  // Files of all formats give the same surface, whatever their names are.
  TEST_F(SurfaceFiles, Formats)
  {
    const Triangles box = box_triangles({-0.1, 0.25, 1. / 3}, {0.7, 1.5, 2});
    // The byte order mark of UTF-8.
    const std::string                        mark = "\xEF\xBB\xBF";
    const std::map<std::string, std::string> files{
      {"stl", stl_text(box, "a box")},
      {"stl binary", stl_bytes(box)},
      {"ply", ply_bytes(box, "ascii")},
      {"ply of Windows",
       std::regex_replace(ply_bytes(box, "ascii"), std::regex("\n"), "\r\n")},
      {"ply little", ply_bytes(box, "binary_little_endian")},
      {"ply big", ply_bytes(box, "binary_big_endian")},
      {"obj", obj_text(box)},
      {"off", off_text(box)},
      {"stl with a mark", mark + stl_text(box, "a box")},
      {"ply with a mark", mark + ply_bytes(box, "ascii")},
      {"obj with a mark", mark + obj_text(box)},
      {"off with a mark", mark + off_text(box)}};
    for (const auto &[name, bytes] : files)
      {
        SCOPED_TRACE(name);
        const std::string           path   = folder.write("surface", bytes);
        const MeshFormatDescription format = mesh_format(path, "");
        EXPECT_EQ(format.name, name.substr(0, 3));
        EXPECT_TRUE(format.is_surface && format.is_geometry);
        TriangleSurface surface = read_triangle_file(path, format.format);
        EXPECT_EQ(surface.triangles.size(), 12u);
        mend_surface(surface);
        EXPECT_EQ(surface.vertices.size(), 8u);
        EXPECT_TRUE(surface.remarks.empty());
        // Numbers of binary STL files have seven digits.
        EXPECT_NEAR(volume_inside(surface),
                    0.8 * 1.25 * (2 - 1. / 3),
                    name == "stl binary" ? 1e-7 : 1e-15);
      }
  }



  // Extruded shapes, an L and a comb, whose ends are polygons that are not
  // convex; the polygons begin at each of their corners.
  TEST_F(SurfaceFiles, ConcavePolygons)
  {
    const std::vector<std::pair<std::vector<std::array<int, 2>>, double>> ends{
      {{{{0, 0}}, {{2, 0}}, {{2, 1}}, {{1, 1}}, {{1, 2}}, {{0, 2}}}, 3},
      {{{{0, 0}},
        {{5, 0}},
        {{5, 2}},
        {{4, 2}},
        {{4, 1}},
        {{3, 1}},
        {{3, 2}},
        {{2, 2}},
        {{2, 1}},
        {{1, 1}},
        {{1, 2}},
        {{0, 2}}},
       8}};
    for (const auto &[corners, area] : ends)
      for (std::size_t first = 0; first < corners.size(); ++first)
        {
          const std::size_t n = corners.size();
          std::string       text, bottom, top, sides;
          for (const int z : {0, 1})
            for (const auto &[x, y] : corners)
              text += fmt::format("v {} {} {}\n", y, z, x);
          for (std::size_t i = 0; i < n; ++i)
            {
              const std::size_t own = (first + i) % n, next = (own + 1) % n;
              bottom = fmt::format(" {}", own + 1) + bottom;
              top += fmt::format(" {}", own + 1 + n);
              sides += fmt::format("f {} {} {} {}\n",
                                   own + 1,
                                   next + 1,
                                   next + 1 + n,
                                   own + 1 + n);
            }
          TriangleSurface surface =
            read_triangle_file(folder.write("prism.obj",
                                            text + "f" + bottom + "\nf" + top +
                                              "\n" + sides),
                               MeshFormat::obj);
          EXPECT_EQ(surface.triangles.size(), 4 * n - 4);
          mend_surface(surface);
          EXPECT_NO_THROW(check_intersections(surface));
          EXPECT_TRUE(surface.remarks.empty());
          EXPECT_NEAR(volume_inside(surface), area, 1e-14);
        }
  }



  // Polygons, indices that count from the end, and names of several kinds.
  TEST_F(SurfaceFiles, NamesOfObj)
  {
    const std::string path = folder.write(
      "names.obj",
      "o box\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n"
      "v 1 1 1\nv 0 1 1\nusemtl steel\ng bottom\nf 4 3 2 1\ng top\n"
      "f -4 -3 -2 -1\ng default\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
      "f 4 1 5 8\n");
    const TriangleSurface surface = read_triangle_file(path, MeshFormat::obj);
    EXPECT_EQ(surface.triangles.size(), 12u);
    const std::vector<std::vector<std::string>> names{
      {"box", "bottom", "steel"}, {"box", "top", "steel"}, {"box", "steel"}};
    EXPECT_EQ(surface.names, names);
    EXPECT_EQ(std::count(surface.groups.begin(), surface.groups.end(), 2u), 8);
    EXPECT_NEAR(volume_inside(surface), 1, 1e-15);
  }



  // The inner side is also determined correctly far from the origin.
  TEST_F(SurfaceFiles, FacesOutwards)
  {
    for (const double far : {-1000., 1000.})
      for (const bool inwards : {false, true})
        EXPECT_NEAR(volume_inside(
                      mended(box_triangles({far, 2 * far, 3 * far},
                                           {far + 1, 2 * far + 2, 3 * far + 3},
                                           inwards))),
                    6,
                    1e-6);
  }



  // A triangle has three corners on a line, and its neighbour at the long edge
  // cannot take over the corner: both triangles would have the same edges.
  TEST_F(SurfaceFiles, TriangleWithoutArea)
  {
    const Point<3>    a(0, 0, 0), b(2, 0, 0), c(1, 0, 0), d(1, 1, 0);
    const std::string said =
      refusal_of({{a, c, b}, {b, d, a}, {a, d, c}, {b, c, d}});
    EXPECT_NE(said.find("found 1 triangle without area, the first at (0, 0, "
                        "0)"),
              std::string::npos)
      << said;
  }



  TEST_F(SurfaceFiles, Mending)
  {
    // Vertices that differ in the eighth digit, a triangle that is there twice,
    // one that is turned over, and one that is only an edge.
    Triangles damaged = unit_box;
    damaged[0][1][0] += 3e-8;
    damaged[3][0][2] -= 3e-8;
    damaged.push_back(unit_box[4]);
    damaged.push_back({unit_box[5][1], unit_box[5][2], unit_box[5][0]});
    std::swap(damaged[7][0], damaged[7][1]);
    damaged.push_back({unit_box[0][0], unit_box[0][1], unit_box[0][1]});
    const TriangleSurface surface = mended(damaged);
    EXPECT_EQ(surface.vertices.size(), 8u);
    EXPECT_EQ(surface.triangles.size(), 12u);
    EXPECT_NEAR(volume_inside(surface), 1, 1e-7);
    const std::vector<std::string> remarks{
      "2 vertices of the surface that lie beside another were merged with it",
      "1 triangles of the surface that are no more than an edge were left out",
      "2 further copies of triangles of the surface were left out",
      "1 triangles of the surface were turned over: they faced the other way "
      "than their neighbours"};
    EXPECT_EQ(surface.remarks, remarks);

    // All triangles face inwards, as those of a hollow do: they are turned
    // without a remark.
    const TriangleSurface turned =
      mended(box_triangles({0, 0, 0}, {1, 1, 1}, true));
    EXPECT_TRUE(turned.remarks.empty());
    EXPECT_NEAR(volume_inside(turned), 1, 1e-15);
  }



  // A triangle whose corners lie on a line closes the gap between the edge of a
  // triangle and two neighbours that have a vertex on that edge.
  TEST_F(SurfaceFiles, FlatTriangles)
  {
    for (const double place : {0.5, 0.25, 1e-3})
      {
        // One neighbour of the edge from (0, 0, 0) to (1, 0, 0) gets a vertex
        // on it.
        const Point<3> middle(place, 0, 0);
        Triangles      box = unit_box;
        const auto     at =
          std::find_if(box.begin(), box.end(), [](const Corners &t) {
            const auto is = [&](const unsigned int i, const Point<3> &x) {
              return t[i].distance(x) == 0;
            };
            return is(0, Point<3>()) && is(1, Point<3>(1, 0, 0));
          });
        ASSERT_NE(at, box.end());
        // A reference would not do, as the original changes in the next line.
        // NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
        const Corners t = *at;
        *at             = {t[0], middle, t[2]};
        box.push_back({middle, t[1], t[2]});
        box.push_back({t[0], t[1], middle});
        const TriangleSurface surface = mended(box);
        EXPECT_EQ(surface.triangles.size(), 14u);
        EXPECT_NEAR(volume_inside(surface), 1, 1e-15);
        EXPECT_EQ(surface.remarks,
                  std::vector<std::string>{
                    "1 triangles of the surface without area were given to "
                    "their neighbours"});
      }
  }



  TEST_F(SurfaceFiles, Refusals)
  {
    const auto says = [&](const Triangles   &triangles,
                          const std::string &message) {
      const std::string said = refusal_of(triangles);
      EXPECT_NE(said.find(message), std::string::npos) << said;
    };
    Triangles open = unit_box;
    open.pop_back();
    says(open,
         "the surface is not closed: found 3 edges of one triangle, the first "
         "at (");

    // Two boxes share an edge.
    says(unit_box + box_triangles({1, 1, 0}, {2, 2, 1}),
         "the surface branches: found 1 edge of more than two triangles, the "
         "first at (1, 1, 0.5)");
    // Boxes cross each other, or touch with a corner in a face, with a part of
    // a face, or with an edge in a face.
    const std::string crosses = "the surface crosses or touches itself: found ";
    says(unit_box + box_triangles({0.5, 0.3, 0.2}, {1.5, 1.2, 1.1}), crosses);
    says(unit_box + box_triangles({1, 0.2, 0.3}, {2, 0.7, 0.6}), crosses);
    says(unit_box + box_triangles({0.2, 0.3, 0.4}, {2, 0.7, 0.6}), crosses);
    Triangles corner = box_triangles({0, 0, 0}, {1, 1, 1});
    for (Corners &t : corner)
      for (Point<3> &x : t)
        // A box rotated so that its diagonal is along x, with a corner at (1,
        // 0.3, 0.4).
        x = Point<3>(1 + x[0] + x[1] + x[2],
                     0.3 + x[0] - x[1],
                     0.4 + x[0] + x[1] - 2 * x[2]);
    says(unit_box + corner, crosses);
    for (Corners &t : corner)
      for (Point<3> &x : t)
        x[0] += 1e-9;
    EXPECT_NO_THROW(mended(unit_box + corner));

    // A Moebius strip, which has one side only.
    Triangles          strip;
    const unsigned int n     = 20;
    const auto         point = [&](const unsigned int i, const double side) {
      const double angle = 2 * std::numbers::pi * i / n;
      const double r     = 2 + side * std::cos(angle / 2);
      return Point<3>(r * std::cos(angle),
                      r * std::sin(angle),
                      side * std::sin(angle / 2));
    };
    for (unsigned int i = 0; i < n; ++i)
      {
        const bool     last = i + 1 == n;
        const Point<3> a = point(i, -1), b = point(i, 1),
                       c = last ? point(0, 1) : point(i + 1, -1),
                       d = last ? point(0, -1) : point(i + 1, 1);
        strip.push_back({a, c, b});
        strip.push_back({b, c, d});
      }
    says(strip, "the surface is not closed: found 40 edges");

    // The only triangle has two equal corners.
    says({{Point<3>(), Point<3>(), Point<3>(1, 0, 0)}},
         "all triangles are without area");
  }



  TEST_F(SurfaceFiles, ShellsAndPatches)
  {
    const Triangles three = box_triangles({0.3, 0.3, 0.3}, {0.6, 0.6, 0.6}) +
                            box_triangles({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}) +
                            unit_box + box_triangles({2, 0, 0}, {3, 1, 1});
    const TriangleSurface surface = mended(three);
    const auto            edges   = surface_edges(surface);
    EXPECT_EQ(edges.size(), 4 * 18u);
    const SurfaceShells shells = surface_shells(surface, edges);
    ASSERT_EQ(shells.bodies.size(), 3u);
    // The innermost shell is a body in the hollow of the third.
    EXPECT_EQ(shells.bodies[0].shells, std::vector<unsigned int>{0});
    EXPECT_EQ(shells.bodies[1].shells, (std::vector<unsigned int>{2, 1}));
    EXPECT_EQ(shells.bodies[2].shells, std::vector<unsigned int>{3});
    const auto n_patches = [&](const double angle) {
      const auto patches = surface_patches(surface, edges, angle);
      return 1 + *std::max_element(patches.begin(), patches.end());
    };
    EXPECT_EQ(n_patches(40), 24u);
    EXPECT_EQ(n_patches(89.9), 24u);
    EXPECT_EQ(n_patches(90.1), 4u);
  }
} // namespace
