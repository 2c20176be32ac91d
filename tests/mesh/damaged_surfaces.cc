// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Surfaces of triangles in files that are damaged or cut off.

#include <gtest/gtest.h>

#include <limits>

#include "surfaces.h"

namespace
{
  using namespace corotet;
  using namespace corotet::tests;

  const Triangles whole_box = box_triangles({0, 0, 0}, {1, 1, 1});



  // A binary STL file in which a coordinate is not a number.
  std::string
  with_nan()
  {
    std::string bytes = stl_bytes(whole_box);
    // The position of the last coordinate of the second corner of the second
    // triangle: behind a head of 84 bytes, 50 bytes for a triangle, and 12 for
    // each vector.
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(&bytes[84 + 50 + 12 + 12 + 8], &nan, 4);
    return bytes;
  }



  struct Damage
  {
    std::string format, bytes, message;
  };

  const std::vector<Damage> damages{
    {"stl",
     "solid\nfacet\nouter loop\nvertex 0 0 x\n",
     ":4: a number is expected: found 'x'"},
    {"stl",
     "solid\nfacet\nouter loop\nvertex 0 0\n",
     ":4: a number is missing"},
    {"stl",
     "solid\nfacet\nouter loop\nvertex 0 0 1e999\n",
     ":4: a number is expected: found '1e999'"},
    {"stl",
     "solid\nfacet\nouter loop\nvertex 0 0 nan\n",
     ":4: a number is expected: found 'nan'"},
    {"stl",
     "solid\nfacet\nouter\nvertex 0 0 0\nendloop\n",
     ":5: 'vertex' is expected: found 'endloop'"},
    {"stl", "solid x\nfacet\n", "the file ends before 'outer'"},
    {"stl", "solid x\n", "the file ends before 'endsolid'"},
    {"stl", "solid x\nendsolid\n", "the file has no triangle"},
    {"stl", "short", "a binary STL file has at least 84 bytes: found 5"},
    {"stl",
     stl_bytes(whole_box).substr(0, 600),
     "a binary STL file with 12 triangles has 684 bytes: found 600: is the rest missing?"},
    {"stl",
     with_nan(),
     "triangle 2 of 12 has a corner that is no point: found 1, 1, nan"},
    {"off",
     "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
     ":6: no such vertex: found 3; allowed are 0 to 2"},
    {"off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "the file ends before vertex 3 of 3"},
    {"off", "OFF BINARY\n", ":1: binary files are not read"},
    {"off",
     "OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n",
     ":6: a face has 3 to 1000 corners: found 2"},
    {"obj",
     "v 0 0 0\nf 1 2 3\n",
     ":2: no such vertex: found '2'; allowed are 1 to 1"},
    {"obj", "v 0 0 0\nf 1 1 0\n", ":2: no such vertex: found '0'"},
    {"obj", "v 0 0 0\nf 1 1 a\n", ":2: no such vertex: found 'a'"},
    {"obj", "v 0 0 0\ncurv 0 1 1 2\n", ":2: the keyword is unknown"},
    {"ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n",
     ":5: there are no elements 'vertex' with the properties x, y, z"},
    {"ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
     "is this a cloud of points?"},
    {"ply", "ply\nformat text\n", ":2: the format is unknown: found 'text'"},
    {"ply",
     "ply\nformat ascii 1.0\nproperty float x\n",
     ":3: a property comes before the first element"},
    {"ply",
     "ply\nformat ascii 1.0\nelement vertex -1\n",
     ":3: a number of elements is negative: found -1"},
    {"ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty number x\n",
     ":4: the type of a property is unknown: found 'number'"},
    {"ply",
     "ply\nformat ascii 1.0\nelement face 1\nproperty list float int v\n",
     ":4: the length of a list is a whole number"},
    {"ply",
     ply_bytes(whole_box, "binary_little_endian").substr(0, 300),
     "the file ends before the last of its elements"}};



  TEST(DamagedSurfaces, AreNamedWithTheirPlace)
  {
    const TemporaryFolder                   folder;
    const std::map<std::string, MeshFormat> formats{{"stl", MeshFormat::stl},
                                                    {"off", MeshFormat::off},
                                                    {"obj", MeshFormat::obj},
                                                    {"ply", MeshFormat::ply}};
    for (const auto &[format, bytes, message] : damages)
      {
        const std::string path = folder.write("damaged", bytes);
        const std::string said =
          refusal([&] { read_triangle_file(path, formats.at(format)); });
        EXPECT_NE(said.find(message), std::string::npos) << said;
        EXPECT_EQ(said.find(path), 0u) << said;
      }
  }



  // A file that is cut off is refused, however much is missing: only what
  // follows its last triangle may be missing.
  TEST(DamagedSurfaces, CutOffAnywhere)
  {
    const TemporaryFolder                                folder;
    const std::map<MeshFormat, std::vector<std::string>> files{
      {MeshFormat::stl, {stl_text(whole_box), stl_bytes(whole_box)}},
      {MeshFormat::off, {off_text(whole_box)}},
      {MeshFormat::ply,
       {ply_bytes(whole_box, "ascii"),
        ply_bytes(whole_box, "binary_little_endian")}}};
    for (const auto &[format, texts] : files)
      for (const std::string &bytes : texts)
        for (std::size_t n = 1; n + 12 < bytes.size(); n += 7)
          {
            const std::string path = folder.write("cut", bytes.substr(0, n));
            const std::string said = refusal(
              [&, format = format] { read_triangle_file(path, format); });
            EXPECT_NE(said, "nothing was refused") << n;
          }
  }
} // namespace
