// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A mesh that is written for gmsh and read again through gmsh is the same to
// the last digit: cells, curves, regions, boundaries and their names. So is a
// mesh that is written to an HDF5 file.

#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/hdf5_mesh.h>
#include <corotet/mesh/mesh_target.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "../body.h"
#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  using Coordinates = std::vector<double>;
  using NameSet     = std::set<std::string>;

  void
  append(Coordinates &all, const dealii::Point<3> &x)
  {
    all.insert(all.end(), x.begin_raw(), x.end_raw());
  }

  // All names that mean the given id.
  NameSet
  names_of(const std::string &kind,
           const NamedSets   &named,
           const unsigned int id)
  {
    const MeshNames names(kind, named);
    NameSet         result;
    for (const std::string &name : names.known())
      {
        const auto ids = names.ids(name, "");
        if (std::count(ids.begin(), ids.end(), id) > 0)
          result.insert(name);
      }
    return result;
  }

  // Vertices and, if it is curved, nodes of each cell, with the names of its
  // region.
  std::map<Coordinates, NameSet>
  cells_of(const SerialMesh &mesh)
  {
    std::map<Coordinates, NameSet> result;
    const std::size_t              n = map_points(mesh.geometry_degree).size();
    for (const SerialMesh::Cell &cell : mesh.cells)
      {
        Coordinates x;
        for (const unsigned int v : cell.vertices)
          append(x, mesh.vertices[v]);
        if (cell.curve != SerialMesh::straight)
          for (std::size_t i = 0; i < n; ++i)
            append(x, curved_nodes(mesh, cell)[i]);
        result[x] = names_of("region", mesh.regions, cell.region);
      }
    return result;
  }

  std::map<Coordinates, NameSet>
  faces_of(const SerialMesh &mesh)
  {
    std::map<Coordinates, NameSet> result;
    for (const SerialMesh::Face &face : mesh.faces)
      {
        // Vertices of a face may be in any order.
        std::vector<Coordinates> corners(3);
        for (unsigned int k = 0; k < 3; ++k)
          append(corners[k], mesh.vertices[face.vertices[k]]);
        std::sort(corners.begin(), corners.end());
        Coordinates x;
        for (const Coordinates &corner : corners)
          x.insert(x.end(), corner.begin(), corner.end());
        result[x] = names_of("boundary", mesh.boundaries, face.boundary);
      }
    return result;
  }

  // The positions of named edges and corners, each with its names.
  std::set<std::pair<Coordinates, NameSet>>
  edges_and_corners_of(const SerialMesh &mesh)
  {
    std::set<std::pair<Coordinates, NameSet>> result;
    for (const auto &[ends, id] : mesh.edges)
      {
        std::vector<Coordinates> x(2);
        for (unsigned int k = 0; k < 2; ++k)
          append(x[k], mesh.vertices[ends[k]]);
        std::sort(x.begin(), x.end());
        x[0].insert(x[0].end(), x[1].begin(), x[1].end());
        result.emplace(x[0], names_of("edge", mesh.edge_names, id));
      }
    for (const auto &[vertex, id] : mesh.corners)
      {
        Coordinates x;
        append(x, mesh.vertices[vertex]);
        result.emplace(x, names_of("corner", mesh.corner_names, id));
      }
    return result;
  }

  void
  expect_equal(const SerialMesh &again, const SerialMesh &mesh)
  {
    EXPECT_EQ(cells_of(again).size(), mesh.cells.size());
    EXPECT_TRUE(cells_of(again) == cells_of(mesh));
    EXPECT_EQ(faces_of(again).size(), mesh.faces.size());
    EXPECT_TRUE(faces_of(again) == faces_of(mesh));
    EXPECT_EQ(edges_and_corners_of(again), edges_and_corners_of(mesh));
    EXPECT_EQ(again.vertices.size(), mesh.vertices.size());
  }

  void
  expect_the_same_again(const SerialMesh &mesh)
  {
    const TemporaryFolder folder;
    write_mesh(folder / "again.msh", mesh);
    const SerialMesh again = read_gmsh(folder / "again.msh");
    expect_equal(again, mesh);
    // Remarks are made for straight cells along curved surfaces only.
    if (mesh.geometry_degree > 1)
      {
        EXPECT_TRUE(again.remarks.empty());
      }
    write_mesh(folder / "again.h5", mesh);
    // An HDF5 file lists all ids, also those without names.
    const UsedNames names(mesh);
    SerialMesh      listed = mesh;
    listed.regions         = names.regions;
    listed.boundaries      = names.boundaries;
    expect_equal(read_hdf5_mesh(folder / "again.h5"), listed);
  }

  SerialMesh
  from_geometry(const std::string &geometry, const std::string &degree)
  {
    const TemporaryFolder folder;
    const std::string     file = folder / "body.geo";
    std::ofstream(file) << "SetFactory(\"OpenCASCADE\");\n" << geometry;
    SerialMesh mesh = read_gmsh(file, "", "0.6", degree);
    check_mesh(mesh);
    return mesh;
  }
} // namespace

TEST(MshFile, StraightCellsAndNamesThatOverlap)
{
  SerialMesh                  mesh = tests::box("1, 2, 3.1", "2, 3, 2");
  std::vector<unsigned int *> regions, boundaries;
  std::vector<std::size_t>    some, others;
  for (SerialMesh::Cell &cell : mesh.cells)
    regions.push_back(&cell.region);
  for (SerialMesh::Face &face : mesh.faces)
    boundaries.push_back(&face.boundary);
  for (std::size_t i = 0; i < 20; ++i)
    (i % 2 == 0 ? some : others).push_back(i);
  mesh.regions.add("even", some, regions);
  mesh.regions.add("a name, with blanks", others, regions);
  mesh.boundaries.add("patch", some, boundaries);
  expect_the_same_again(mesh);
}

// Nodes of curved cells have another order in gmsh's elements. Some cells of
// this half ball are straight.
TEST(MshFile, CurvedCells)
{
  for (const std::string degree : {"2", "3"})
    {
      const SerialMesh mesh =
        from_geometry("Sphere(1) = {0, 0, 0, 1, 0, Pi/2, 2*Pi};\n"
                      "Physical Volume(\"ball\") = {1};\n"
                      "Physical Surface(\"all\") = Surface{:};\n",
                      degree);
      EXPECT_GT(mesh.curved_nodes.size(), 0u);
      EXPECT_TRUE(std::any_of(mesh.cells.begin(),
                              mesh.cells.end(),
                              [](const SerialMesh::Cell &cell) {
                                return cell.curve == SerialMesh::straight;
                              }));
      expect_the_same_again(mesh);
    }
}

// Regions and boundaries without names keep their numbers.
TEST(MshFile, NumbersWithoutNames)
{
  const SerialMesh mesh = from_geometry("Box(1) = {0, 0, 0, 1, 1, 1};\n"
                                        "Box(2) = {1, 0, 0, 1, 1, 1};\n"
                                        "Coherence;\n"
                                        "Physical Volume(7) = {1};\n"
                                        "Physical Volume(4) = {2};\n"
                                        "Physical Surface(12) = {1};\n",
                                        "1");
  EXPECT_EQ(region_volumes(mesh).count(7), 1u);
  expect_the_same_again(mesh);
}

// Region and boundary 0, for which gmsh has no group, and the largest numbers
// of groups that gmsh has.
TEST(MshFile, SmallestAndLargestNumbers)
{
  for (const unsigned int number : {0u, 1u, 2147483646u, 2147483647u})
    {
      SerialMesh mesh   = tests::box("1, 2, 3", "2, 2, 2");
      mesh.regions      = {};
      mesh.boundaries   = {};
      const auto halves = mesh.cells.size() / 2;
      for (std::size_t i = 0; i < mesh.cells.size(); ++i)
        mesh.cells[i].region = i < halves ? number : 5;
      for (std::size_t i = 0; i < mesh.faces.size(); ++i)
        mesh.faces[i].boundary = i % 2 == 0 ? number : 5;
      for (NamedSets *named : {&mesh.regions, &mesh.boundaries})
        named->names = {{number, ""}, {5, ""}};
      std::vector<unsigned int *> regions;
      for (SerialMesh::Cell &cell : mesh.cells)
        regions.push_back(&cell.region);
      SCOPED_TRACE(number);
      expect_the_same_again(mesh);
      mesh.regions.add("all", {0, 1, halves}, regions);
      expect_the_same_again(mesh);
    }
}

// Overlapping names of edges and corners, and ones without a name, with cells
// of all degrees.
TEST(MshFile, EdgesAndCorners)
{
  for (const std::string degree : {"1", "2", "3"})
    {
      const SerialMesh mesh =
        from_geometry("Cylinder(1) = {0, 0, 0, 0, 0, 1, 1};\n"
                      "Physical Volume(\"body\") = {1};\n"
                      "Physical Curve(\"a line, with blanks\") = {1, 2};\n"
                      "Physical Curve(\"other\") = {2, 3};\n"
                      "Physical Curve(12) = {3};\n"
                      "Physical Point(\"both\") = {1, 2};\n"
                      "Physical Point(3) = {2};\n",
                      degree);
      EXPECT_EQ(mesh.edge_names.names.size(), 3u);
      EXPECT_EQ(mesh.corners.size(), 3u);
      expect_the_same_again(mesh);
    }
}

// A body whose only region has no name.
TEST(MshFile, NoNames)
{
  const SerialMesh mesh = from_geometry("Box(1) = {0, 0, 0, 1, 1, 1};\n", "1");
  expect_the_same_again(mesh);
}

// A mesh file may be replaced by a new mesh; other files may not.
TEST(MshFile, WhatIsReplaced)
{
  const TemporaryFolder folder;
  const auto            refused = [&](const std::string &name,
                           const std::string &origin = "") {
    SerialMesh mesh = tests::box("1, 1, 1", "1, 1, 1");
    mesh.origin     = origin;
    return refusal([&] { write_mesh(folder / name, mesh); });
  };
  for (const auto &[extension, owner] :
       {std::pair(".msh", "gmsh"), std::pair(".h5", "corotet")})
    {
      const std::string file = std::string("a") + extension;
      std::ofstream(folder / file) << "A letter.\n";
      EXPECT_EQ(refused(file),
                "'" + (folder / file) + "' is there, and is no mesh of " +
                  owner + ", which would be replaced");
      const std::string other = std::string("b") + extension;
      EXPECT_EQ(refused(other), "nothing was refused");
      EXPECT_EQ(refused(other), "nothing was refused");
      EXPECT_EQ(refused(other, folder / other),
                "'" + (folder / other) +
                  "' is the file that is read; give another name");
      EXPECT_EQ(refused("none/" + other),
                "'" + (folder / ("none/" + other)) +
                  "' cannot be written: there is no folder '" +
                  (folder / "none") +
                  "'; allowed is a name in a folder that is there");
    }
  EXPECT_EQ(refused("b.vtk"),
            "a mesh is written to a .msh or an .h5 file: found '" +
              (folder / "b.vtk") + "'");
}
