// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Files of Medit: words in lines of any kind, and refusals. Nothing that a file
// says about the mesh is left out silently.

#include <gtest/gtest.h>

#include "mesh/tools.h"
#include "mesh/two_cubes.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  class MeditFile : public testing::Test
  {
  protected:
    SerialMesh
    read(const std::string &text) const
    {
      return read_file(folder.write("body.mesh", text));
    }

    // The message of the refusal, without the folder.
    std::string
    message(const std::string &text) const
    {
      const std::string found = refusal([&] { read(text); });
      const std::size_t file  = found.find("body.mesh");
      return file == std::string::npos ? found : found.substr(file);
    }

    static std::string
    with(std::string text, const std::string &old, const std::string &own)
    {
      for (std::size_t i = text.find(old); i != std::string::npos;
           i             = text.find(old, i + own.size()))
        text.replace(i, old.size(), own);
      return text;
    }

    TemporaryFolder folder;
    // Six vertices, which are in lines 4 to 9 of the file.
    const std::string start =
      "MeshVersionFormatted 2\nDimension 3\nVertices 6\n0 0 0 0\n1 0 0 0\n"
      "1 1 0 0\n0 1 0 0\n0 0 1 0\n2 0 0 0\n";
    const std::string cell = "Tetrahedra\n1\n2 6 3 5 0\n";
    const std::string end  = "End\n";
  };

  // Two cubes; triangles have the references 1 and 2, tetrahedra 3 and 4.
  std::string
  medit_of_cubes()
  {
    std::string text =
      "MeshVersionFormatted 2\n\nDimension\n3\n\nVertices\n12\n" +
      two_cubes::node_lines([](const int, const auto &x) {
        return fmt::format("{} 0\n", fmt::join(x, " "));
      });
    for (const std::size_t n_nodes : {3, 4})
      text += (n_nodes == 3 ? "\nTriangles\n4\n" : "\nTetrahedra\n12\n") +
              two_cubes::element_lines(
                [&](const int, const int cube, const auto &of_element) {
                  return of_element.size() != n_nodes ?
                           "" :
                           fmt::format("{} {}\n",
                                       fmt::join(of_element, " "),
                                       two_cubes::group_of(
                                         static_cast<int>(n_nodes) - 1, cube));
                });
    return text + "\nEnd\n";
  }
} // namespace

// Line breaks mean nothing: words may stand in any line.
TEST_F(MeditFile, Lines)
{
  const std::string plain = medit_of_cubes();
  std::string       one   = with(plain, "\n", " ");
  for (const std::string &text :
       {plain,
        with(plain, "\n", "\r\n"),
        with(plain, "\n", "\n\n"),
        with(plain, "\n", " # a comment, 3 1 4\n"),
        with(with(plain, "Triangles\n", "Triangles "),
             "Tetrahedra\n",
             "Tetrahedra "),
        with(plain, " ", "\n"),
        with(plain, "1 4 10 1\n", "1 4 10 1 "),
        with(plain, "1 2 5 11 3\n", "1 2 5 11 3 "),
        with(with(plain, "Tetrahedra", "tetrahedra"),
             "1 0 0 0",
             "1.D0 0 0e0 0"),
        // The format of the file is recognised by its first lines only.
        with(one, "MeshVersionFormatted", "\nMeshVersionFormatted") +
          "\nEnd\n"})
    {
      SCOPED_TRACE(text.substr(0, 200));
      const SerialMesh mesh = read(text);
      two_cubes::expect_cubes(mesh, "3", "4", "1", "2");
      EXPECT_TRUE(mesh.remarks.empty());
    }
}

// Nodes on edges follow the vertices, in the order 1-2, 2-3, 3-1, 1-4, 2-4,
// 3-4.
TEST_F(MeditFile, TenNodes)
{
  const SerialMesh mesh = read(
    "MeshVersionFormatted 2\nDimension 3\nVertices\n10\n0 0 0 0\n1 0 0 0\n"
    "0 1 0 0\n0 0 1 0\n.5 -.1 0 0\n.5 .5 0 0\n0 .5 0 0\n0 0 .5 0\n.5 0 .5 0\n"
    "0 .5 .5 0\nTetrahedraP2\n1\n1 2 3 4 5 6 7 8 9 10 7\nTrianglesP2\n1\n"
    "1 2 3 5 6 7 4\nEnd\n# written by hand\n");
  ASSERT_EQ(mesh.cells.size(), 1u);
  ASSERT_EQ(mesh.geometry_degree, 2u);
  EXPECT_EQ(mesh.curved_nodes[4], dealii::Point<3>(.5, -.1, 0));
  EXPECT_EQ(mesh.curved_nodes[8], dealii::Point<3>(.5, 0, .5));
  EXPECT_EQ(mesh.curved_nodes[9], dealii::Point<3>(0, .5, .5));
  EXPECT_NEAR(area(mesh, "4"), 0.5, 1e-15);
}

// Files that gmsh writes for curved cells: some of them have ten nodes where
// four are expected.
TEST_F(MeditFile, FilesOfGmsh)
{
  const std::string file = folder / "ball.mesh", other = folder / "ball.msh";
  const auto        write = [&](const std::string &name) {
    write_shapes(name, [&] {
      gmsh::model::occ::addSphere(0, 0, 0, 1);
      gmsh::model::occ::synchronize();
      gmsh::option::setNumber("Mesh.MeshSizeMax", 0.7);
      gmsh::option::setNumber("Mesh.ElementOrder", 2);
      gmsh::model::mesh::generate(3);
    });
  };
  write(file);
  write(other);
  const SerialMesh mesh = read_file(file), expected = read_file(other);
  EXPECT_EQ(mesh.geometry_degree, 2u);
  EXPECT_EQ(mesh.cells.size(), expected.cells.size());
  EXPECT_NEAR(mesh_quality(mesh).volume, mesh_quality(expected).volume, 1e-12);
  EXPECT_NE(message(
              with(with(folder.read("ball.mesh"), "TetrahedraP2", "Tetrahedra"),
                   "TrianglesP2",
                   "Edges"))
              .find(": a line of Tetrahedra has 5 numbers for each of them"),
            std::string::npos);
}

TEST_F(MeditFile, OtherSections)
{
  const SerialMesh mesh =
    read(start + "Corners\n2\n1\n2\nEdges 1\n1 2 5\nIdentifier \"a part\"\n" +
         cell + "Ridges 0\nNormals\n1\n0 0 1\n" + end + "what follows\n" + end);
  EXPECT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.remarks,
            (std::vector<std::string>{
              "left out, as vertices, triangles and tetrahedra are read only: "
              "Corners, Edges, Identifier, Normals"}));
}

TEST_F(MeditFile, Refusals)
{
  EXPECT_EQ(message(start + cell + "Prisms 0\nTriangles\n1\n2 6 3 0\n" + end),
            "nothing was refused");
  const std::pair<std::string, std::string> cases[]{
    {"Prisms\n1\n1 2 3 4 5 6 1\n" + cell,
     ":11: cells other than tetrahedra: found 1 Prisms; allowed are Tetrahedra"},
    {"Pyramids\n# one\n1\n1 2 3 4 5 1\n" + cell,
     ":12: cells other than tetrahedra: found 1 Pyramids; allowed are "
     "Tetrahedra"},
    {cell + "Hexahedra 1\n1 2 3 4 5 6 1 2 1\n",
     ":13: cells other than tetrahedra: found 1 Hexahedra; allowed are "
     "Tetrahedra"},
    {"Tetrahedra\n1\n2 6 3 5 -1\n",
     ":12: a reference in Tetrahedra: found -1; allowed are 0 and more"},
    {cell + "Triangles\n1\n2 6 3 -7\n",
     ":15: a reference in Triangles: found -7; allowed are 0 and more"},
    {"Tetrahedra\n1\n2 6 0 5 1\n",
     ":12: a vertex in Tetrahedra: found 0; allowed are 1 and more"},
    {"Tetrahedra\n2\n2 6 3 5 1\n",
     ":13: 1 more Tetrahedra are expected, as there are 2: found 'End'"},
    {"Tetrahedra\n1\n2 6 3 5 1\n1 2 3 5 1\n",
     ":13: the name of a section is expected behind all of Tetrahedra, of which "
     "there are 1: found '1'"},
    {"Tetrahedra\n1.0\n2 6 3 5 1\n",
     ":11: a whole number is expected in Tetrahedra: found '1.0'"},
    {"Tetrahedra\n3\n1 2 3 4 5 6 1 2 3 4 1\n1 2 3 4 5 6 1 2 3 4 1\n",
     ":12: a line of Tetrahedra has 5 numbers for each of them: found a line "
     "that ends within one; are these of another degree?"},
    {"Tetrahedra\n-1\n",
     ":11: the number of Tetrahedra: found -1; allowed are 0 and more"},
    {"Tetrahedra\n1\n2 6 3 7 0\n",
     ": an element has the node 7, which the file does not contain"}};
  for (const auto &[text, expected] : cases)
    EXPECT_EQ(message(start + text + end), "body.mesh" + expected);
  EXPECT_EQ(message(with(start, "1 1 0 0", "1 x 0 0") + cell + end),
            "body.mesh:6: found 'x'; allowed is a finite number");
  EXPECT_EQ(message(with(start, "1 1 0 0", "1 1 0") + cell + end),
            "body.mesh:7: a line of Vertices has 4 numbers for each of them: "
            "found a line that ends within one");
  EXPECT_EQ(message(with(start, "Dimension 3", "Dimension 2") + cell + end),
            "body.mesh:2: the dimension: found 2; allowed is 3");
  EXPECT_EQ(message(start + end), "body.mesh: the mesh has no tetrahedra");
}
