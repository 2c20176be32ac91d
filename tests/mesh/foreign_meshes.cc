// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Meshes that gmsh writes in the formats of other programs: Nastran, UNV,
// Medit, CGNS and VTK. The bodies are known; files that are cut off are
// refused. For more files of VTK see tests/program/vtk_files.py.

#include <corotet/mesh/mesh_format.h>

#include <gtest/gtest.h>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  using Known = std::vector<std::string>;

  // Writes a mesh of two boxes, with names.
  void
  write_boxes(const std::string &file, const int degree)
  {
    write_shapes(file, [&] {
      using namespace gmsh::model;
      add_two_boxes();
      addPhysicalGroup(3, {1}, 11, "small");
      addPhysicalGroup(3, {2}, 12, "large");
      gmsh::vectorpair ends;
      getEntitiesInBoundingBox(-.1, -.1, -.1, .1, 1.1, 1.1, ends, 2);
      addPhysicalGroup(2, {ends.at(0).second}, 21, "end");
      gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
      gmsh::option::setNumber("Mesh.ElementOrder", degree);
      mesh::generate(3);
    });
  }

  struct Format
  {
    std::string extension;
    // The error of volumes that the digits of coordinates in the file allow.
    double tolerance;
    bool   has_names;
  };

  // Nastran's small fields have seven digits of a number.
  const Format formats[]{{".bdf", 1e-6, false},
                         {".unv", 1e-14, true},
                         {".vtk", 1e-14, false},
                         {".mesh", 1e-14, false},
                         {".cgns", 1e-14, true}};

  // The values in ascending order.
  std::vector<double>
  values(const std::map<unsigned int, double> &of_ids)
  {
    std::vector<double> result;
    for (const auto &[id, value] : of_ids)
      result.push_back(value);
    std::sort(result.begin(), result.end());
    return result;
  }
} // namespace

// The volumes of the regions. The surface between them is not a boundary of the
// body: check_mesh() drops it.
TEST(ForeignMeshes, Boxes)
{
  const TemporaryFolder folder;
  for (const int degree : {1, 2})
    for (const Format &format : formats)
      {
        const std::string file = folder / ("boxes" + format.extension);
        write_boxes(file, degree);
        const SerialMesh          mesh = read_file(file);
        const std::vector<double> expected{1, 2};
        const auto                found = values(region_volumes(mesh));
        ASSERT_EQ(found.size(), expected.size()) << file << " " << degree;
        for (std::size_t i = 0; i < found.size(); ++i)
          EXPECT_NEAR(found[i], expected[i], 10 * format.tolerance) << file;
        if (!format.has_names)
          continue;
        EXPECT_NEAR(volume(mesh, "small"), 1, 10 * format.tolerance) << file;
        EXPECT_NEAR(volume(mesh, "large"), 2, 10 * format.tolerance) << file;
        EXPECT_NEAR(area(mesh, "end"), 1, 10 * format.tolerance) << file;
      }
}

// A file may have any name if its content tells the format.
TEST(ForeignMeshes, AnyName)
{
  const TemporaryFolder folder;
  for (const std::string extension : {".bdf", ".unv", ".vtk", ".mesh"})
    {
      const std::string file  = folder / ("a part" + extension),
                        other = folder / ("a part" + extension + " of 2025");
      write_boxes(file, 1);
      std::filesystem::rename(file, other);
      EXPECT_NEAR(total(region_volumes(read_file(other))), 3, 1e-5) << other;
    }
}

// Properties and references are numbers of regions and boundaries; fields are
// free or have eight columns, with comments between.
TEST(ForeignMeshes, Numbers)
{
  const TemporaryFolder folder;
  const SerialMesh      bulk =
    read_file(folder.write("two.nas",
                           "$ two tetrahedra\nSOL 101\nCEND\nBEGIN BULK\n"
                           "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\n"
                           "GRID,3,,0.,1.,0.\n$ another\n"
                           "GRID    4               0.0     0.0     1.0\n"
                           "GRID,5,,0.,0.,-2.\n"
                           "CTETRA,1,7,1,2,3,4\n"
                           "CTETRA  2       9       1       3       2       5\n"
                           "CTRIA3,3,4,1,3,4\nENDDATA\n"));
  EXPECT_NEAR(volume(bulk, "7"), 1 / 6., 1e-15);
  EXPECT_NEAR(volume(bulk, "9"), 1 / 3., 1e-15);
  EXPECT_NEAR(area(bulk, "4"), 0.5, 1e-15);

  const SerialMesh medit =
    read_file(folder.write("two.mesh",
                           "MeshVersionFormatted 2\n# a comment\nDimension 3\n"
                           "Vertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
                           "0 0 -2 0\nTetrahedra\n2\n1 2 3 4 7\n1 3 2 5 9\n"
                           "Triangles\n1\n1 3 4 4\nEnd\n"));
  EXPECT_NEAR(volume(medit, "7"), 1 / 6., 1e-15);
  EXPECT_NEAR(volume(medit, "9"), 1 / 3., 1e-15);
  EXPECT_NEAR(area(medit, "4"), 0.5, 1e-15);
}

// A file that is cut off anywhere is refused, not read as a smaller mesh.
TEST(ForeignMeshes, CutOff)
{
  const TemporaryFolder folder;
  for (const Format &format : formats)
    {
      const std::string file = folder / ("whole" + format.extension);
      write_boxes(file, 1);
      const std::string text = folder.read("whole" + format.extension);
      for (const double part : {0.1, 0.5, 0.7, 0.97})
        {
          const std::string cut =
            folder.write("cut" + format.extension,
                         text.substr(0, std::size_t(part * text.size())));
          const std::string message = refusal([&] { read_file(cut); });
          EXPECT_EQ(message.compare(0, cut.size() + 1, cut + ":"), 0)
            << cut << " " << part << ": " << message;
          EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
}

TEST(ForeignMeshes, Includes)
{
  const TemporaryFolder folder;
  const std::string     file =
    folder.write("all.bdf",
                 "BEGIN BULK\nINCLUDE 'nodes.bdf'\nCTETRA,1,7,1,2,3,4\n"
                 "ENDDATA\n");
  EXPECT_EQ(refusal([&] { read_file(file); }),
            file + ":2: other files are not read: found INCLUDE; allowed is "
                   "one file with the whole mesh");
}
