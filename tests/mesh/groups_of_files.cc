// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Each element of a gmsh file of version 2 belongs to the groups that its own
// line tells, whatever entity it is of. The volumes and areas of two cubes and
// their sides are known.

#include <gmsh.h>
#include <gtest/gtest.h>

#include "mesh/tools.h"
#include "mesh/two_cubes.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  using two_cubes::expect_cubes;
  using two_cubes::group_of;
  using two_cubes::Numbers;
  using Known = std::vector<std::string>;

  const std::string names_of_cubes =
    "$PhysicalNames\n4\n2 1 \"left\"\n2 2 \"right\"\n3 3 \"A\"\n3 4 \"B\"\n"
    "$EndPhysicalNames\n";

  // The lines of the elements, each with the tags that @p tags gives for its
  // dimension and its cube.
  std::string
  elements_of_cubes(const std::function<std::string(int, int)> &tags)
  {
    return two_cubes::element_lines(
      [&](const int number, const int cube, const Numbers &nodes) {
        const int dimension = static_cast<int>(nodes.size()) - 1;
        return fmt::format("{} {} {} {}\n",
                           number,
                           dimension == 2 ? 2 : 4,
                           tags(dimension, cube),
                           fmt::join(nodes, " "));
      });
  }

  std::string
  msh_of_cubes(const std::string &elements,
               const std::size_t  n_elements = 16,
               const std::string &names      = names_of_cubes)
  {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names + "$Nodes\n12\n" +
           two_cubes::node_lines([](const int number, const auto &x) {
             return fmt::format("{} {}\n", number, fmt::join(x, " "));
           }) +
           "$EndNodes\n$Elements\n" + std::to_string(n_elements) + "\n" +
           elements + "$EndElements\n";
  }
} // namespace

// All elements are of one entity, which thus has several physical groups; the
// number of the entity may be that of a group.
TEST(GroupsOfFiles, ElementsOfOneEntity)
{
  const TemporaryFolder folder;
  for (const int entity : {1, 3, 0})
    expect_cubes(read_file(folder.write(
      "cubes.msh",
      msh_of_cubes(elements_of_cubes([&](const int dimension, const int cube) {
        return fmt::format("2 {} {}", group_of(dimension, cube), entity);
      })))));
}

// gmsh writes overlapping groups so: an element is repeated for each of its
// groups. Negative numbers of groups turn elements over.
TEST(GroupsOfFiles, CopiesOfElements)
{
  const TemporaryFolder folder;
  const auto            of_groups = [](const int all, const int sign) {
    return elements_of_cubes([=](const int dimension, const int cube) {
      return fmt::format("2 {} 1",
                         sign * (all > 0 ? all + dimension :
                                                      group_of(dimension, cube)));
    });
  };
  const SerialMesh mesh = read_file(
    folder.write("cubes.msh",
                 msh_of_cubes(of_groups(0, 1) + of_groups(10, -1), 32)));
  expect_cubes(mesh);
  EXPECT_NEAR(volume(mesh, "13"), 2, 1e-14);
  EXPECT_NEAR(area(mesh, "12"), 2, 1e-14);
  // Repeated elements of the same group are copies, which overlap.
  const std::string twice =
    folder.write("twice.msh",
                 msh_of_cubes(of_groups(0, 1) + of_groups(0, 1), 32));
  EXPECT_NE(refusal([&] { read_file(twice); }).find("overlap"),
            std::string::npos);
}

// gmsh joins the copies of cells that are in several groups, in files of both
// versions.
TEST(GroupsOfFiles, OverlapInAllVersions)
{
  const TemporaryFolder folder;
  for (const double version : {2.2, 4.1})
    for (const int binary : {0, 1})
      {
        const std::string file = folder / "body.msh";
        write_shapes(file, [&] {
          using namespace gmsh::model;
          add_two_boxes();
          addPhysicalGroup(3, {1}, 1, "small");
          addPhysicalGroup(3, {2}, 2, "large");
          addPhysicalGroup(3, {1, 2}, 3, "all");
          gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
          mesh::generate(3);
          gmsh::option::setNumber("Mesh.MshFileVersion", version);
          gmsh::option::setNumber("Mesh.Binary", binary);
        });
        const SerialMesh mesh = read_file(file);
        EXPECT_NEAR(volume(mesh, "small"), 1, 1e-13) << version;
        EXPECT_NEAR(volume(mesh, "large"), 2, 1e-13) << version;
        EXPECT_NEAR(volume(mesh, "all"), 3, 1e-13) << version;
      }
}

// Groups with the same name are one group, in each dimension.
TEST(GroupsOfFiles, TheSameName)
{
  const TemporaryFolder folder;
  const std::string     names =
    "$PhysicalNames\n4\n2 1 \"side\"\n2 2 \"side\"\n3 3 \"body\"\n"
    "3 4 \"body\"\n$EndPhysicalNames\n";
  const auto elements =
    elements_of_cubes([](const int dimension, const int cube) {
      return fmt::format("2 {0} {0}", group_of(dimension, cube));
    });
  const SerialMesh mesh =
    read_file(folder.write("cubes.msh", msh_of_cubes(elements, 16, names)));
  EXPECT_NEAR(volume(mesh, "body"), 2, 1e-14);
  EXPECT_NEAR(area(mesh, "side"), 2, 1e-14);
  EXPECT_EQ(MeshNames("region", mesh.regions).known(), Known{"body"});

  const SerialMesh lines =
    read_file(folder.write("lines.msh",
                           msh_of_cubes(elements + "17 1 2 5 1 1 2\n"
                                                   "18 1 2 6 1 2 3\n",
                                        18,
                                        "$PhysicalNames\n2\n1 5 \"rim\"\n"
                                        "1 6 \"rim\"\n$EndPhysicalNames\n")));
  EXPECT_EQ(MeshNames("edge", lines.edge_names).known(), Known{"rim"});
  EXPECT_EQ(lines.edges.size(), 2u);
}

// gmsh also allows comments before all sections, and nodes with parameters of
// their positions on the geometry.
TEST(GroupsOfFiles, CommentsAndParameters)
{
  const TemporaryFolder folder;
  const std::string     plain =
    msh_of_cubes(elements_of_cubes([](const int dimension, const int cube) {
      return fmt::format("2 {} 1", group_of(dimension, cube));
    }));
  for (const std::string name : {"cubes.msh", "a part"})
    expect_cubes(read_file(
      folder.write(name, "$Comments\n$Nodes\n$EndComments\n" + plain)));
  std::string text = plain;
  const auto  put  = [&](const std::string &old, const std::string &own) {
    text.replace(text.find(old), old.size(), own);
  };
  put("$Nodes", "$ParametricNodes");
  put("$EndNodes", "$EndParametricNodes");
  const std::string on[]{" 0 1", " 1 1 0.5", " 2 1 0.5 0.25", " 3 1"};
  for (int i = 0; i < 12; ++i)
    {
      const auto &x    = two_cubes::nodes[i];
      const auto  line = fmt::format("\n{} {} {} {}", i + 1, x[0], x[1], x[2]);
      put(line + "\n", line + on[i % 4] + "\n");
    }
  expect_cubes(read_file(folder.write("cubes.msh", text)));

  const std::string later = folder / "box.msh";
  write_shapes(later, [&] {
    gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3);
    gmsh::model::occ::synchronize();
    gmsh::model::mesh::generate(3);
  });
  const std::string file =
    folder.write("box.msh",
                 "$Comments\n$EndComments\n" + folder.read("box.msh"));
  EXPECT_NEAR(total(region_volumes(read_file(file))), 6, 1e-13);
}

// Parts of a partitioned mesh may also list cells of their neighbours; these
// cells are not counted again.
TEST(GroupsOfFiles, Partitions)
{
  const TemporaryFolder folder;
  const std::string     file = folder / "parts.msh";
  write_shapes(file, [&] {
    gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3);
    gmsh::model::occ::synchronize();
    gmsh::model::addPhysicalGroup(3, {1}, 1, "body");
    gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
    gmsh::model::mesh::generate(3);
    gmsh::option::setNumber("Mesh.PartitionCreateGhostCells", 1);
    gmsh::model::mesh::partition(3);
  });
  const SerialMesh mesh = read_file(file);
  EXPECT_NEAR(volume(mesh, "body"), 6, 1e-13);
  EXPECT_TRUE(mesh.remarks.empty());
}

// A file of a mesh that gmsh has split is not taken for the whole, except that
// the first one of version 2 has no sign of the others: a warning asks.
TEST(GroupsOfFiles, SplitMesh)
{
  const TemporaryFolder folder;
  for (const double version : {2.2, 4., 4.1})
    for (const int binary : {0, 1})
      {
        if (version == 4. && binary == 1)
          continue; // gmsh does not write that
        SCOPED_TRACE(fmt::format("{} {}", version, binary));
        write_shapes(folder / "parts.msh", [&] {
          gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3);
          gmsh::model::occ::synchronize();
          gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
          gmsh::model::mesh::generate(3);
          gmsh::model::mesh::partition(3);
          gmsh::option::setNumber("Mesh.PartitionSplitMeshFiles", 1);
          gmsh::option::setNumber("Mesh.MshFileVersion", version);
          gmsh::option::setNumber("Mesh.Binary", binary);
        });
        for (const int part : {1, 2, 3})
          {
            const std::string file = folder / fmt::format("parts_{}.msh", part);
            if (version < 4 && part == 1)
              {
                EXPECT_EQ(read_file(file).remarks.front(),
                          "warning: all cells are of partition 1: is this the "
                          "whole mesh, or one of several files?");
                continue;
              }
            EXPECT_EQ(refusal([&] { read_file(file); }),
                      fmt::format("{}: found the cells of partition {} only; "
                                  "allowed is a file with those of all "
                                  "partitions, as gmsh writes without the "
                                  "option -part_split",
                                  file,
                                  part));
          }
      }
}

TEST(GroupsOfFiles, RefusalsOfVersion2)
{
  const TemporaryFolder folder;
  const std::string     file = folder / "cubes.msh";
  const auto plain = [](const int, const int) { return std::string("2 1 1"); };
  const auto message = [&](const std::string &old, const std::string &own) {
    std::string text = msh_of_cubes(elements_of_cubes(plain));
    text.replace(text.find(old), old.size(), own);
    folder.write("cubes.msh", text);
    return refusal([&] { read_file(file); });
  };
  EXPECT_EQ(message("\n2 1 0 0", "\n2 1 x 0"),
            file + ":14: a number is expected: found 'x'");
  EXPECT_EQ(message("\n2 1 0 0", "\n2 1 nan 0"),
            file + ":14: found the node 2 at (1, nan, 0); numbers of nodes are "
                   "positive, and coordinates finite");
  EXPECT_EQ(message("$Nodes\n12", "$Nodes\n13"),
            file + ":25: a number is expected: found '$EndNodes'");
  EXPECT_EQ(message("5 4 2 1", "5 77 2 1"),
            file + ":32: found an element of gmsh's type 77; allowed are 4, 11 "
                   "and 29, tetrahedra, with 2, 9, 21, 1, 8, 26 and 15 for "
                   "names");
  EXPECT_EQ(message("2 1 \"left\"", "2 1 left"),
            file + ":6: found '2 1 left'; allowed is the dimension, the number "
                   "and the name of a physical group: '3 1 \"body\"'");
  EXPECT_EQ(message("2.2 0 8", "2.2 1 4"),
            file + ":3: found the kind 1 with numbers of 4 bytes; allowed are "
                   "0 for text and 1 for binary with 8");
}

// A node at two positions, and sections that have more entries than they say:
// the last cell would be lost.
TEST(GroupsOfFiles, LeftoversAndDuplicatesOfVersion2)
{
  const TemporaryFolder folder;
  const std::string     file  = folder / "cubes.msh";
  const std::string     cells = elements_of_cubes(
    [](const int, const int) { return std::string("2 1 1"); });
  const auto message = [&](const std::string &old, const std::string &own) {
    std::string text = msh_of_cubes(cells);
    text.replace(text.find(old), old.size(), own);
    folder.write("cubes.msh", text);
    return refusal([&] { read_file(file); });
  };
  EXPECT_EQ(message("$Nodes\n12\n", "$Nodes\n13\n2 1 0 1\n"),
            file + ":15: node 2 is there already, at another place");
  EXPECT_EQ(message("$Nodes\n12\n", "$Nodes\n13\n2 1 0 0\n"),
            "nothing was refused");
  const std::string more = "'; does the section have more than its first line "
                           "says?";
  EXPECT_EQ(message("$Elements\n16", "$Elements\n15"),
            file +
              ":43: $EndElements is expected: found '16 4 2 1 1 2 8 12 11" +
              more);
  EXPECT_EQ(message("$Nodes\n12", "$Nodes\n11"),
            file + ":24: $EndNodes is expected: found '12 2 1 1" + more);
  EXPECT_EQ(message("$PhysicalNames\n4", "$PhysicalNames\n3"),
            file + ":9: $EndPhysicalNames is expected: found '3 4 \"B\"" +
              more);
}
