// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Meshes of the inside of closed surfaces of triangles.

#include <gtest/gtest.h>

#include "../../source/mesh/nearest_triangle.h"
#include "surfaces.h"

namespace
{
  using namespace corotet;
  using namespace corotet::tests;
  using dealii::Point;

  struct SurfaceMesh : public testing::Test
  {
    TemporaryFolder folder;

    SerialMesh
    mesh_of(const std::string &bytes,
            const std::string &element_size = "0",
            const std::string &degree       = "1") const
    {
      return read_file(folder.write("surface.any", bytes),
                       element_size,
                       degree);
    }
  };



  TEST_F(SurfaceMesh, KeepsTriangles)
  {
    const Triangles  triangles = sphere_triangles(3);
    const SerialMesh mesh      = mesh_of(stl_text(triangles));
    EXPECT_NEAR(total(region_volumes(mesh)), volume_inside(triangles), 1e-13);
    // The boundary has all triangles of the surface, unchanged.
    EXPECT_EQ(mesh.faces.size(), triangles.size());
    EXPECT_EQ(MeshNames("region", mesh.regions).known(),
              std::vector<std::string>{"solid 1"});
    for (const SerialMesh::Face &face : mesh.faces)
      for (const unsigned int v : face.vertices)
        EXPECT_NEAR(mesh.vertices[v].norm(), 1, 1e-14);
    EXPECT_EQ(boundary_areas(mesh).size(), 1u);
  }



  // The new triangles have their corners on the old ones.
  TEST_F(SurfaceMesh, NewTriangles)
  {
    const Triangles triangles = sphere_triangles(5);
    const double    volume    = volume_inside(triangles);
    double          before    = 1;
    for (const std::string size : {"0.5", "0.25"})
      {
        const SerialMesh mesh  = mesh_of(stl_bytes(triangles), size);
        const double     error = 1 - total(region_volumes(mesh)) / volume;
        EXPECT_GT(error, 0);
        // The error is of the second order in the size.
        EXPECT_LT(error, before / 3);
        before = error;
        for (const SerialMesh::Face &face : mesh.faces)
          for (const unsigned int v : face.vertices)
            EXPECT_NEAR(mesh.vertices[v].norm(), 1, 1e-3);
      }
    EXPECT_LT(before, 0.03);
  }



  TEST_F(SurfaceMesh, EdgesStay)
  {
    for (const std::string size : {"0", "0.3"})
      {
        const SerialMesh mesh =
          mesh_of(obj_text(box_triangles({0, 0, 0}, {1, 2, 3})), size);
        EXPECT_NEAR(total(region_volumes(mesh)), 6, 1e-12);
        // The areas of bottom, top, front, back, left and right.
        const double areas[] = {2, 2, 3, 3, 6, 6};
        for (unsigned int i = 0; i < 6; ++i)
          EXPECT_NEAR(tests::area(mesh, fmt::format("surface {}", i + 1)),
                      areas[i],
                      1e-12);
      }
  }



  // A group with the first triangle only names that triangle, and no body.
  TEST_F(SurfaceMesh, GroupOfOneTriangle)
  {
    std::string text = obj_text(box_triangles({0, 0, 0}, {1, 1, 1}));
    text.insert(text.find("f "), "g first\n");
    text.insert(text.find("f ", text.find("f ") + 1), "g others\n");
    const SerialMesh mesh = mesh_of(text);
    EXPECT_NEAR(tests::area(mesh, "first"), 0.5, 1e-12);
    EXPECT_NEAR(tests::area(mesh, "others"), 5.5, 1e-12);
    EXPECT_EQ(refusal([&] {
                MeshNames("region", mesh.regions).ids("others", "");
              }).find("nothing was refused"),
              std::string::npos);
  }



  // Names in the file may look like the names that unnamed surfaces get.
  TEST_F(SurfaceMesh, NamesLikeNumbers)
  {
    std::string text = obj_text(box_triangles({0, 0, 0}, {1, 1, 1}));
    text.insert(text.find("f "), "g surface 4\n");
    text.insert(text.find("f ", text.find("f ") + 1), "g others\n");
    const SerialMesh mesh = mesh_of(text);
    EXPECT_NEAR(tests::area(mesh, "surface 4"), 0.5, 1e-12);
    EXPECT_NEAR(tests::area(mesh, "others"), 5.5, 1e-12);
    EXPECT_NEAR(tests::area(mesh, "surface 4 (2)"), 1, 1e-12);
  }



  // A body has only the names that all of its surface has: here it is an object
  // of two materials.
  TEST_F(SurfaceMesh, ObjectOfSeveralMaterials)
  {
    std::string text =
      "o Cube\nusemtl m0\n" + obj_text(box_triangles({0, 0, 0}, {1, 1, 1}));
    text.insert(text.find("f ", text.find("f ") + 1),
                "g part all\nusemtl m1\n");
    const SerialMesh mesh = mesh_of(text);
    EXPECT_NEAR(tests::volume(mesh, "Cube"), 1, 1e-12);
    EXPECT_EQ(MeshNames("region", mesh.regions).known(),
              (std::vector<std::string>{"Cube", "solid 1"}));
    EXPECT_NEAR(tests::area(mesh, "m0"), 0.5, 1e-12);
    EXPECT_NEAR(tests::area(mesh, "m1"), 5.5, 1e-12);
  }



  TEST_F(SurfaceMesh, BodiesAndHollows)
  {
    const Triangles outer  = box_triangles({0, 0, 0}, {1, 1, 1}),
                    hollow = box_triangles({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}),
                    inner  = sphere_triangles(2, 0.2),
                    beside = box_triangles({2, 0, 0}, {3, 1, 1});
    Triangles moved        = inner;
    for (Corners &t : moved)
      for (Point<3> &x : t)
        x += dealii::Tensor<1, 3>({0.5, 0.5, 0.5});
    const std::string text = stl_text(outer + hollow, "shell") +
                             stl_text(moved, "core") + stl_text(beside);
    for (const std::string size : {"0", "0.1"})
      {
        SCOPED_TRACE(size);
        const SerialMesh mesh  = mesh_of(text, size);
        const double     exact = volume_inside(inner);
        EXPECT_NEAR(tests::volume(mesh, "shell"), 1 - 0.6 * 0.6 * 0.6, 1e-12);
        EXPECT_NEAR(tests::volume(mesh, "solid 1"), 1 - 0.6 * 0.6 * 0.6, 1e-12);
        EXPECT_NEAR(tests::volume(mesh, "core"),
                    exact,
                    size == "0" ? 1e-12 : 0.1 * exact);
        EXPECT_NEAR(tests::volume(mesh, "solid 3"), 1, 1e-12);
        // As boundaries, names mean all faces of their surface.
        EXPECT_NEAR(tests::area(mesh, "shell"), 6 + 6 * 0.6 * 0.6, 1e-12);
      }
  }



  // The sides of a slightly rotated box: in single precision they are no longer
  // plane, by the last digits of small numbers, but neighbouring triangles
  // still do not count as crossing. A second box that reaches into the first
  // one by as little does cross it.
  TEST_F(SurfaceMesh, SidesThatAreHardlyPlane)
  {
    for (const double degrees : {1e-5, 1e-3, 30.})
      for (const unsigned int n : {1u, 2u, 3u})
        {
          const double angle  = degrees * dealii::numbers::PI / 180;
          const auto   turned = [&](const Triangles &triangles) {
            Triangles result = triangles;
            for (Corners &t : result)
              for (auto &x : t)
                x = Point<3>(std::cos(angle) * x[0] - std::sin(angle) * x[1],
                             std::sin(angle) * x[0] + std::cos(angle) * x[1],
                             x[2]);
            return result;
          };
          Triangles box = box_triangles({0, 0, 0}, {0.1, 0.02, 0.01});
          for (unsigned int k = 0; k < n; ++k)
            {
              Triangles finer;
              for (const Corners &t : box)
                {
                  Corners m;
                  for (unsigned int i = 0; i < 3; ++i)
                    m.push_back(t[i] + (t[(i + 1) % 3] - t[i]) / 2);
                  finer.push_back({t[0], m[0], m[2]});
                  finer.push_back({m[0], t[1], m[1]});
                  finer.push_back({m[2], m[1], t[2]});
                  finer.push_back({m[0], m[1], m[2]});
                }
              box = finer;
            }
          // stl_bytes() writes coordinates in single precision.
          EXPECT_NEAR(mesh_quality(mesh_of(stl_bytes(turned(box)))).volume,
                      2e-5,
                      1e-11)
            << degrees << ' ' << n;
          const Triangles other =
            box_triangles({0.1 - 1e-7, 0.005, 0.002}, {0.2, 0.015, 0.008});
          EXPECT_NE(refusal([&] {
                      mesh_of(stl_bytes(turned(box + other)));
                    }).find("the surface crosses or touches itself"),
                    std::string::npos)
            << degrees << ' ' << n;
        }
  }



  TEST_F(SurfaceMesh, Refusals)
  {
    const std::string text = stl_text(sphere_triangles(1));
    EXPECT_EQ(refusal([&] { mesh_of(text, "0", "2"); })
                .find("Mesh/file/Geometry degree: cells inside of a surface of "
                      "triangles are straight: found 2 for "),
              0u);
    const std::string path = folder.write("none.stl", "nothing of that kind");
    EXPECT_EQ(refusal([&] { read_file(path); }),
              path + ": a binary STL file has at least 84 bytes: found 20");
  }



  TEST(NearestTriangle, Distances)
  {
    const std::array<Point<3>, 3> corners{
      {Point<3>(0, 0, 0), Point<3>(2, 0, 0), Point<3>(0, 2, 0)}};
    const auto distance = [&](const double x, const double y, const double z) {
      return distance_from_triangle(Point<3>(x, y, z), corners);
    };
    EXPECT_NEAR(distance(0.5, 0.5, 3), 3, 1e-15);
    EXPECT_NEAR(distance(0.5, 0.5, -3), 3, 1e-15);
    EXPECT_NEAR(distance(-3, 0, 4), 5, 1e-15);
    EXPECT_NEAR(distance(1, -3, 4), 5, 1e-15);
    EXPECT_NEAR(distance(2, 2, 0), std::sqrt(2), 1e-15);
    EXPECT_NEAR(distance(5, 0, -4), 5, 1e-15);

    // The nearest triangle is compared with the distances from all triangles.
    TriangleSurface surface;
    for (const Corners &t : sphere_triangles(3))
      {
        const unsigned int n = surface.vertices.size();
        surface.triangles.push_back({{n, n + 1, n + 2}});
        surface.vertices.insert(surface.vertices.end(), t.begin(), t.end());
      }
    const NearestTriangle nearest(surface);
    const auto            of = [&](const unsigned int t, const Point<3> &x) {
      const auto &v = surface.triangles[t];
      return distance_from_triangle(x,
                                               {{surface.vertices[v[0]],
                                      surface.vertices[v[1]],
                                      surface.vertices[v[2]]}});
    };
    for (unsigned int i = 0; i < 50; ++i)
      {
        const Point<3> x(std::sin(3. * i),
                         1.5 * std::sin(5. * i),
                         std::cos(7. * i));
        double         least = 1e9;
        for (unsigned int t = 0; t < surface.triangles.size(); ++t)
          least = std::min(least, of(t, x));
        EXPECT_NEAR(of(nearest(x), x), least, 1e-15);
      }
  }
} // namespace
