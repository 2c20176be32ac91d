// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Universal files: groups and numbers of elements, whatever dataset they are
// in, and refusals.

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

  // A universal file of two cubes. @p numbers gives the numbers of property and
  // material for a dimension and a cube.
  std::string
  unv_of_cubes(const std::function<std::string(int, int)> &numbers,
               const std::string                          &groups = "")
  {
    return "    -1\n  2411\n" +
           two_cubes::node_lines([](const int number, const auto &x) {
             return fmt::format("{:10}{:10}{:10}{:10}\n", number, 1, 1, 11) +
                    fmt::format("{:25}{:25}{:25}\n",
                                fmt::format("{}.0D+00", x[0]),
                                fmt::format("{}.0D+00", x[1]),
                                fmt::format("{}.0D+00", x[2]));
           }) +
           "    -1\n    -1\n  2412\n" +
           two_cubes::element_lines(
             [&](const int number, const int cube, const Numbers &nodes) {
               const int dimension = static_cast<int>(nodes.size()) - 1;
               return fmt::format("{:10}{:10} {} {:9}{:10}\n{}\n",
                                  number,
                                  dimension == 2 ? 41 : 111,
                                  numbers(dimension, cube),
                                  7,
                                  nodes.size(),
                                  fmt::join(nodes, " "));
             }) +
           "    -1\n" + groups;
  }

  // A group of elements with the labels from @p first on and so many numbers
  // for each of them; a line has up to eight numbers.
  std::string
  unv_group(const int          number,
            const std::string &name,
            const int          first,
            const int          n,
            const int          n_numbers = 4)
  {
    std::string result =
      fmt::format("{:10} 0 0 0 0 0 0 {:9}\n{}\n", number, n, name);
    const int n_of_line = 8 / n_numbers;
    for (int i = 0; i < n; ++i)
      result +=
        fmt::format("{:10}{:10}{}{}",
                    8,
                    first + i,
                    n_numbers == 4 ? " 0 0" : "",
                    i % n_of_line == n_of_line - 1 || i == n - 1 ? "\n" : "");
    return result;
  }

  std::string
  unv_groups(const std::string &dataset,
             const std::string &left,
             const std::string &a,
             const int          n_numbers = 4)
  {
    return "    -1\n  " + dataset + "\n" + unv_group(1, left, 1, 2, n_numbers) +
           unv_group(2, "right", 3, 2, n_numbers) +
           unv_group(3, a, 5, 6, n_numbers) +
           unv_group(4, "B", 11, 6, n_numbers) + "    -1\n";
  }
} // namespace

// Groups may be in datasets of I-deas or of Salome; names may have blanks, and
// where there are groups the numbers of materials mean nothing.
TEST(UnvFile, Groups)
{
  const TemporaryFolder folder;
  const auto ones = [](const int, const int) { return std::string("1 1"); };
  const std::pair<std::string, int> datasets[]{{"2435", 4},
                                               {"2452", 4},
                                               {"2467", 4},
                                               {"2477", 4},
                                               {"2429", 2},
                                               {"2430", 2},
                                               {"2432", 2}};
  for (const auto &[dataset, n_numbers] : datasets)
    {
      const SerialMesh mesh = read_file(folder.write(
        "cubes.unv",
        unv_of_cubes(ones,
                     unv_groups(dataset, "left face", "part 1", n_numbers))));
      expect_cubes(mesh, "part 1", "B", "left face");
      EXPECT_TRUE(mesh.remarks.empty());
      EXPECT_EQ(MeshNames("region", mesh.regions).known(),
                (Known{"part 1", "B"}));
    }
  // A name may look like the end of a dataset, which is indented.
  EXPECT_NEAR(area(read_file(folder.write(
                     "cubes.unv",
                     unv_of_cubes(ones, unv_groups("2467", "-1", "A")))),
                   "-1"),
              1,
              1e-14);
  // Groups may overlap; a cell that is in none keeps its number.
  const SerialMesh overlap = read_file(
    folder.write("cubes.unv",
                 unv_of_cubes(ones,
                              "    -1\n  2467\n" + unv_group(1, "some", 5, 8) +
                                unv_group(2, "others", 9, 3) + "    -1\n")));
  EXPECT_NEAR(volume(overlap, "some"), 8 / 6., 1e-14);
  EXPECT_NEAR(volume(overlap, "others"), 0.5, 1e-14);
  EXPECT_NEAR(volume(overlap, "1"), 4 / 6., 1e-14);
  EXPECT_EQ(overlap.cells.size(), 12u);
}

// Without groups, cells are numbered by materials, or by properties if there is
// only one material. In the dataset 780, property and material have two numbers
// each: a bin, and their own number.
TEST(UnvFile, Numbers)
{
  const TemporaryFolder folder;
  for (const bool has_materials : {false, true})
    for (const bool has_bins : {false, true})
      {
        std::string text =
          unv_of_cubes([&](const int dimension, const int cube) {
            const int         number = group_of(dimension, cube);
            const std::string bin    = has_bins ? "1 " : "";
            return has_materials ? fmt::format("{0}1 {0}{1}", bin, number) :
                                   fmt::format("{0}{1} {0}1", bin, number);
          });
        if (has_bins)
          text.replace(text.find("  2412"), 6, "   780");
        expect_cubes(
          read_file(folder.write("cubes.unv", text)), "3", "4", "1", "2");
      }
}

TEST(UnvFile, Refusals)
{
  const TemporaryFolder folder;
  const std::string     file = folder / "cubes.unv";
  const auto message = [&](const std::string &old, const std::string &own) {
    std::string text =
      unv_of_cubes([](const int, const int) { return std::string("1 1"); });
    text.replace(text.find(old), old.size(), own);
    folder.write("cubes.unv", text);
    return refusal([&] { read_file(file); });
  };
  // The beginning of the line of the first tetrahedron.
  const std::string first = "         5       111";
  EXPECT_EQ(message(first, "         5       114"),
            file + ":38: cells other than tetrahedra with 4 or 10 nodes: found "
                   "the type 114 with 4 nodes; allowed are 111 and 118");
  EXPECT_EQ(message(first, "         5      tet4"),
            file + ":38: a whole number is expected as word 2 of the line: "
                   "found 'tet4'");
  EXPECT_EQ(message("1 2 5 11\n", "1 2 5 -11\n"),
            file + ":39: found -11; allowed is a positive whole number");
  EXPECT_EQ(message("1 2 5 11\n", "1 2 5 111\n"),
            file + ": an element has the node 111, which the file does not "
                   "contain");
  // Elements such as springs are no cells.
  EXPECT_EQ(message("    -1\n    -1\n", "    -1\n    -1\n"),
            "nothing was refused");
  folder.write("cubes.unv",
               folder.read("cubes.unv") +
                 "    -1\n  2412\n 99 136 1 1 7 2\n 1 2\n    -1\n");
  EXPECT_EQ(read_file(file).remarks,
            Known{"1 elements of the type 136 are left out"});
}

// Duplicates and leftovers are refused, as groups would lose members, and nodes
// and elements their names.
TEST(UnvFile, LeftoversAndDuplicates)
{
  const TemporaryFolder folder;
  const auto ones = [](const int, const int) { return std::string("1 1"); };
  const std::string file    = folder / "cubes.unv";
  const auto        message = [&](const std::string &more) {
    folder.write("cubes.unv", unv_of_cubes(ones, more));
    return refusal([&] { read_file(file); });
  };
  // The file of the two cubes has 62 lines.
  const std::string start = "    -1\n  2467\n", end = "    -1\n";
  const auto        with_count = [&](const int n, const int n_others = 6) {
    std::string group = unv_group(1, "A", 5, 6);
    group.replace(group.find("        6\n"), 10, fmt::format("{:9}\n", n));
    return start + group + unv_group(2, "B", 11, n_others) + end;
  };
  EXPECT_EQ(message(with_count(6)), "nothing was refused");
  EXPECT_EQ(message(with_count(5)),
            file + ":69: the group 'A' has 5 members by its first line: found "
                   "more");
  const std::string name    = ": the name of a group is expected: found '",
                    members = "'; is the number of members of the group before "
                              "too small?";
  EXPECT_EQ(message(with_count(2)),
            file + ":69" + name + "8         9 0 0         8        10 0 0" +
              members);
  EXPECT_EQ(message(with_count(4)),
            file + ":70" + name + "2 0 0 0 0 0 0         6" + members);
  EXPECT_EQ(message(start + unv_group(1, "A", 5, 0) +
                    "         8         5 0 0         8         6 0 0\n" + end),
            file + ":68" + name + "-1" + members);
  EXPECT_EQ(message(with_count(8)),
            file + ":71: the first line of a group has 8 numbers, the number "
                   "of members last: found 'B'");
  EXPECT_EQ(message(with_count(10)),
            file + ":71: 2 more members of the group 'A' are expected: found "
                   "'B'");
  EXPECT_EQ(message(start + "1 0 0 0 0 0 2\nA\n 8 5 0 0 8 6 0 0\n" + end),
            file + ":65: the first line of a group has 8 numbers, the number "
                   "of members last: found '1 0 0 0 0 0 2'");
  EXPECT_EQ(message("    -1\n  2411\n 3 1 1 11\n 2 0 1\n" + end),
            file + ":66: node 3 is there already, at another place");
  EXPECT_EQ(message("    -1\n  2411\n 3 1 1 11\n 2 0 0\n" + end),
            "nothing was refused");
  EXPECT_EQ(message("    -1\n  2412\n 16 111 1 1 7 4\n 1 2 5 11\n" + end),
            file + ":65: element 16 is there already");
  EXPECT_EQ(message("    -1\n  2412\n 17 111 1 1 7 4\n 1 2 5 11 8\n" + end),
            file + ":66: an element of 4 nodes: found 5 of them");
  EXPECT_EQ(message("    -1\n  2412\n 17 111 1 1 4\n 1 2 5 11\n" + end),
            file + ":65: the first line of an element has 6 numbers, or 8 in "
                   "the dataset 780: found ' 17 111 1 1 4'");
}

// A node may refer to a coordinate system of its own, except in the dataset
// 2411, where that number is the system of the export.
TEST(UnvFile, Systems)
{
  const TemporaryFolder folder;
  const std::string     file = folder / "cubes.unv";
  const auto            read = [&](const std::string &systems,
                        const std::string &dataset,
                        const int          system) {
    const std::string head = "         1         1";
    std::string       text = systems + unv_of_cubes([](const int, const int) {
                         return std::string("1 1");
                       });
    text.replace(text.find("  2411"), 6, dataset);
    const std::size_t line = text.find("\n         3         1") + 1;
    text.replace(line, head.size(), fmt::format("         3{:10}", system));
    if (dataset == "    15")
      {
        // In that dataset a node has one line.
        const std::size_t begin = text.find(dataset),
                          end   = text.find("-1", begin);
        std::string nodes       = text.substr(begin, end - begin);
        for (std::size_t i = nodes.find("11\n"); i != std::string::npos;
             i = nodes.find("11\n", i))
          nodes.replace(i, 3, "11 ");
        text.replace(begin, end - begin, nodes);
      }
    return read_file(folder.write("cubes.unv", text));
  };
  const std::string systems =
    "    -1\n  2420\n 1\nsystems\n 2 1 8\nmine\n 1 0 0\n 0 1 0\n 0 0 1\n"
    " 1 0 0\n    -1\n";
  for (const std::string dataset : {"   781", "    15"})
    {
      SCOPED_TRACE(dataset);
      EXPECT_EQ(refusal([&] { read(systems, dataset, 2); }),
                file + (dataset == "    15" ? ":16" : ":18") +
                  ": coordinates in a system of their own are not read: found "
                  "the definition system 2 of a node; allowed are 0 and 1, the "
                  "global one");
      EXPECT_EQ(read(systems, dataset, 0).cells.size(), 12u);
      EXPECT_EQ(read("", dataset, 2).remarks,
                Known{"coordinates of 1 nodes are taken for global: the file "
                      "does not define their system, 2"});
    }
  EXPECT_TRUE(read(systems, "  2411", 2).remarks.empty());
}
