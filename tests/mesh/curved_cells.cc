// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Curved cells: from gmsh in all formats, refined, checked.

#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/mesh.h>

#include <fmt/format.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;

namespace
{
  const std::string meshes = source_path("meshes");
  const std::string sphere = "sphere_octant.geo";

  std::size_t
  n_curved(const SerialMesh &mesh)
  {
    return std::count_if(mesh.cells.begin(),
                         mesh.cells.end(),
                         [](const SerialMesh::Cell &cell) {
                           return cell.curve != SerialMesh::straight;
                         });
  }

  // Relative error of the volume of the octant of a sphere.
  double
  volume_error(const SerialMesh &mesh)
  {
    return std::abs(mesh_quality(mesh).volume / (7 * std::acos(-1.) / 6) - 1);
  }

  // A tetrahedron with ten nodes, in gmsh's order; the middle of the first edge
  // is at (0.5, y, 0).
  std::string
  tetrahedron_mesh(const std::string &y)
  {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 1 0 "
           "0\n3 0 1 0\n4 0 0 1\n5 .5 " +
           y +
           " 0\n6 .5 .5 0\n7 0 .5 0\n8 0 0 .5\n9 0 .5 .5\n10 .5 0 .5\n"
           "$EndNodes\n$Elements\n1\n1 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n"
           "$EndElements\n";
  }
} // namespace

// Refinement by gmsh puts vertices on the sphere: the error of the volume is of
// order h^2 with facets. Maps of degree q interpolate the sphere: h^4 at least.
TEST(CurvedCells, SphereVolume)
{
  EXPECT_EQ(read_gmsh(sphere, meshes).curved_nodes.size(), 0u);
  for (const std::string degree : {"1", "2", "3"})
    {
      SerialMesh coarse = read_gmsh(sphere, meshes, "0", degree);
      SerialMesh fine   = read_gmsh(sphere, meshes, "0", degree, 1);
      check_mesh(coarse);
      check_mesh(fine);
      EXPECT_EQ(fine.n_refinements, 1u);
      EXPECT_EQ(fine.cells.size(), 8 * coarse.cells.size());
      EXPECT_EQ(fine.geometry_degree, std::stoul(degree));
      EXPECT_LT(n_curved(fine), fine.cells.size());
      const double order = std::log2(volume_error(coarse) / volume_error(fine));
      if (degree == "1")
        {
          EXPECT_NEAR(order, 2, 0.2);
        }
      else
        {
          EXPECT_GT(order, 3.7) << degree;
        }
      EXPECT_LT(volume_error(fine), degree == "1" ? 0.03 : 2e-4) << degree;
    }
}

// Files of every format hold the mesh that was made: the nodes are the same to
// the digits of ASCII.
TEST(CurvedCells, AllFormats)
{
  const TemporaryFolder folder;
  for (const int degree : {2, 3})
    {
      const SerialMesh expected =
        read_gmsh(sphere, meshes, "0", std::to_string(degree));
      for (const double version : {2.2, 4.1})
        for (const int binary : {0, 1})
          {
            const std::string file = folder / "sphere.msh";
            gmsh::initialize(0, nullptr, false, false);
            gmsh::option::setNumber("General.Terminal", 0);
            gmsh::open(meshes + "/" + sphere);
            gmsh::model::mesh::generate(3);
            gmsh::model::mesh::setOrder(degree);
            gmsh::option::setNumber("Mesh.MshFileVersion", version);
            gmsh::option::setNumber("Mesh.Binary", binary);
            gmsh::write(file);
            gmsh::finalize();

            SerialMesh mesh = read_gmsh(file);
            EXPECT_EQ(mesh.geometry_degree, static_cast<unsigned int>(degree));
            EXPECT_EQ(n_curved(mesh), n_curved(expected));
            EXPECT_NEAR(mesh_quality(mesh).volume,
                        mesh_quality(expected).volume,
                        1e-13);
            check_mesh(mesh);
            EXPECT_EQ(mesh.boundaries.names, expected.boundaries.names);
            EXPECT_NEAR(boundary_areas(mesh).at(4),
                        boundary_areas(expected).at(4),
                        1e-13);
          }
    }
}

// The children of a curved cell lie in it, so the volume remains; straight
// cells remain straight.
TEST(CurvedCells, Refinement)
{
  for (const std::string degree : {"2", "3"})
    {
      SerialMesh        mesh   = read_gmsh(sphere, meshes, "0", degree);
      const double      volume = mesh_quality(mesh).volume;
      const std::size_t n      = n_curved(mesh);
      mesh.vertices.shrink_to_fit();
      refine_uniformly(mesh, 2);
      EXPECT_EQ(n_curved(mesh), 64 * n);
      EXPECT_NEAR(mesh_quality(mesh).volume, volume, 1e-12);
      check_mesh(mesh);
      for (const SerialMesh::Cell &cell : mesh.cells)
        for (unsigned int v = 0; v < 4; ++v)
          if (cell.curve != SerialMesh::straight)
            {
              EXPECT_LE(curved_nodes(mesh, cell)[v].distance(
                          mesh.vertices[cell.vertices[v]]),
                        1e-14);
            }
    }
}

// Ten nodes at straight positions make a straight cell. The middle of an edge
// that is moved by y inwards adds y / 3 to the volume of 1/6: an integral of
// the quadratic function of the edge over the two faces there. From y = 1/4 on,
// the map folds at a vertex.
TEST(CurvedCells, OneCell)
{
  const TemporaryFolder folder;
  const std::string     file = folder.write("cell.msh", tetrahedron_mesh("0"));
  SerialMesh            mesh = read_gmsh(file);
  EXPECT_EQ(mesh.geometry_degree, 1u);
  EXPECT_TRUE(mesh.curved_nodes.empty());

  folder.write("cell.msh", tetrahedron_mesh("-0.1"));
  mesh = read_gmsh(file);
  EXPECT_EQ(mesh.geometry_degree, 2u);
  ASSERT_EQ(n_curved(mesh), 1u);
  check_mesh(mesh);

  folder.write("cell.msh", tetrahedron_mesh("0.3"));
  const std::string text = refusal([&] {
    SerialMesh mesh = read_gmsh(file);
    check_mesh(mesh);
  });
  EXPECT_EQ(text.substr(0, text.find("of -")),
            file + ": 1 of 1 curved cells is folded: found a Jacobian "
                   "determinant ");
  EXPECT_NE(text.find("it must be positive everywhere, so make the mesh finer"),
            std::string::npos);
}

// Elements of degree 1 use only the vertices of cells, so they accept a folded
// cell, unless refinement puts vertices where the fold is. With the middle of
// the edge from (0, 0, 0) to (1, 0, 0) at y = 0.6, the child at (1, 0, 0) is
// inverted.
TEST(CurvedCells, FoldsAreNoMatterToDegreeOne)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("cell.msh", tetrahedron_mesh("0.6"));
  Log               log(MPI_COMM_WORLD, true);
  const auto        make = [&](const unsigned int refinements,
                        const unsigned int degree) {
    Mesh(read_gmsh(file), refinements, 1., MPI_COMM_SELF, log, degree);
  };
  make(0, 1);
  for (const unsigned int degree : {2, 3})
    EXPECT_NE(refusal([&] { make(0, degree); }).find("curved cells is folded"),
              std::string::npos);
  EXPECT_NE(refusal([&] { make(1, 1); }).find("no positive volume"),
            std::string::npos);
}

namespace
{
  // The reference cell with the nodes of a map of degree 3, still straight.
  SerialMesh
  cubic_cell()
  {
    SerialMesh mesh;
    mesh.vertices        = {Point<3>(0, 0, 0),
                            Point<3>(1, 0, 0),
                            Point<3>(0, 1, 0),
                            Point<3>(0, 0, 1)};
    mesh.cells           = {{{{0, 1, 2, 3}}, 0, 0}};
    mesh.geometry_degree = 3;
    mesh.curved_nodes    = map_points(3);
    return mesh;
  }
} // namespace

// The nodes at the thirds of an edge are moved by s and -s along y, so that its
// middle stays. With barycentric coordinates l, the determinant on the edge is
// 1 - 13.5 s l1 (2 l0 - l1), negative at l1 = 1/3 for s = 0.3. The quadratic
// interpolant is straight.
TEST(CurvedCells, FoldsOfHigherDegreeAreNoMatter)
{
  SerialMesh mesh = cubic_cell();
  for (Point<3> &x : mesh.curved_nodes)
    if (x[1] == 0 && x[2] == 0 && x[0] > 0 && x[0] < 1)
      x[1] += x[0] < 0.5 ? 0.3 : -0.3;
  EXPECT_NE(refusal([&] { check_mesh(mesh, 3); }).find("folded"),
            std::string::npos);
  EXPECT_EQ(refusal([&] { check_mesh(mesh, 2); }), "nothing was refused");
  EXPECT_NEAR(check_curved_cells(mesh, "", 2, MPI_COMM_SELF), 1, 1e-14);
}

// Where elements have a lower degree than the maps of the cells, their volume
// differs from that of the geometry, which another line of the log tells: so
// the log also tells the volume of the elements.
TEST(CurvedCells, LogSaysWhatElementsTake)
{
  const TemporaryFolder folder;
  SerialMesh            mesh = cubic_cell();
  for (Point<3> &x : mesh.curved_nodes)
    x[1] -= 0.1 * x[0] * (1 - x[0]);
  for (const auto &[degree, said] : std::map<unsigned int, std::string>{
         {1, "taken as straight ones by elements of degree 1"},
         {2, "taken as ones of degree 2 by elements of degree 2, smallest "},
         {3, "smallest Jacobian determinant "}})
    {
      const std::string file = folder / fmt::format("{}.txt", degree);
      {
        Log log(MPI_COMM_SELF, true);
        log.open(file);
        Mesh(mesh, 0, 1., MPI_COMM_SELF, log, degree);
      }
      std::stringstream text;
      text << std::ifstream(file).rdbuf();
      EXPECT_NE(text.str().find("  1 curved cells of degree 3, " + said),
                std::string::npos)
        << text.str();
    }
}

TEST(CurvedCells, Refusals)
{
  const TemporaryFolder folder;
  std::string           text = tetrahedron_mesh("0");
  const std::string     elements("1\n1 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n");
  text.replace(text.find(elements),
               elements.size(),
               "2\n1 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n2 4 2 1 2 1 2 3 4\n");
  const std::string file = folder.write("mixed.msh", text);
  EXPECT_EQ(refusal([&] { read_gmsh(file); }),
            file + ": tetrahedra of several degrees: found 'Tetrahedron 4', "
                   "'Tetrahedron 10'; one of these is allowed");
  EXPECT_EQ(refusal([&] { read_gmsh(file, "", "0", "2"); }),
            "Mesh/gmsh/Geometry degree: a mesh has the degree of its cells: "
            "found 2 for '" +
              file + "'; 1 is allowed");
}
