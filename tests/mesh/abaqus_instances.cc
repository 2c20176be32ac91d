// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Parts and their instances in input files of Abaqus.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "abaqus.h"

using namespace corotet;
using namespace corotet::tests;

// Instances are moved and rotated copies of parts; sets of the assembly may
// refer to their members.
TEST_F(AbaqusFile, PartsAndInstances)
{
  const SerialMesh mesh =
    read("*PART, NAME=block\n" + nodes + cells +
         "*NSET, NSET=foot\n10, 20, 30\n*END\t PART\n"
         "*ASSEMBLY, NAME=a\n*INSTANCE, NAME=one, PART=BLOCK\n*END INSTANCE\n"
         "*INSTANCE, NAME=two, PART=block\n10., 0, 0\n10, 0, 0, 10, 0, 1, 90\n"
         "*END INSTANCE\n"
         "*NSET, NSET=held, INSTANCE=two\nfoot\n"
         "*NSET, NSET=numbers, INSTANCE=two\n10, 20, 30\n"
         "*ELSET, ELSET=first, INSTANCE=one\n7\n"
         "*SURFACE, NAME=face\ntwo.body, S2\n"
         "*ELSET, ELSET=_f, INTERNAL, INSTANCE=one\n9\n"
         "*SURFACE, NAME=other\n_f, S2\n"
         "*END ASSEMBLY\n");
  ASSERT_EQ(mesh.cells.size(), 4u);
  EXPECT_EQ(known_regions(mesh), (Known{"first", "one.Body", "two.Body"}));
  EXPECT_NEAR(volume(mesh, "first"), 1 / 6., 1e-15);
  EXPECT_NEAR(volume(mesh, "two.Body"), 0.5, 1e-14);
  EXPECT_NEAR(area(mesh, "held"), 0.5, 1e-14);
  EXPECT_NEAR(area(mesh, "numbers"), 0.5, 1e-14);
  EXPECT_NEAR(area(mesh, "one.foot"), 0.5, 1e-15);
  EXPECT_NEAR(area(mesh, "face"), std::sqrt(0.75) + 0.5, 1e-14);
  EXPECT_NEAR(area(mesh, "other"), std::sqrt(0.75), 1e-14);
  EXPECT_NEAR(area(mesh, "two.foot"), 0.5, 1e-14);
  // The instance moves (1, 0, 0) to (10, 1, 0).
  EXPECT_LT(mesh.vertices[6].distance(dealii::Point<3>(10, 1, 0)), 1e-14);
}

// Nodes in the middle of straight edges, rounded to six digits: moved and
// rotated copies are straight, too. If a node deviates by more, all cells are
// curved.
TEST_F(AbaqusFile, InstancesOfRoundedParts)
{
  const std::vector<dealii::Point<3>> vertices{{0.123457, 0.345679, 0.567891},
                                               {1.23456, 0.222223, 0.333333},
                                               {0.777778, 1.55556, 0.444445},
                                               {0.666667, 0.888889, 1.98765}};
  const auto                          part = [&](const double off) {
    constexpr unsigned int ends[6][2] = {
      {0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    std::string text = "*PART, NAME=p\n*NODE\n";
    auto        add = [&, n = 0](const dealii::Point<3> &x) mutable {
      text +=
        fmt::format("{}, {:.6g}, {:.6g}, {:.6g}\n", ++n, x[0], x[1], x[2]);
    };
    for (const dealii::Point<3> &x : vertices)
      add(x);
    for (const auto &[a, b] : ends)
      add(vertices[a] + 0.5 * (vertices[b] - vertices[a]) +
          dealii::Tensor<1, 3>({a == 2 && b == 3 ? off : 0., 0., 0.}));
    return text + "*ELEMENT, TYPE=C3D10\n1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10\n"
                                           "*END PART\n";
  };
  const std::string assembly =
    "*ASSEMBLY, NAME=a\n*INSTANCE, NAME=one, PART=p\n*END INSTANCE\n"
    "*INSTANCE, NAME=two, PART=p\n0.1, 0.2, 10.3\n0, 0, 0, 1, 1, 1, 33\n"
    "*END INSTANCE\n*END ASSEMBLY\n";
  const SerialMesh mesh = read(part(0) + assembly);
  EXPECT_EQ(mesh.geometry_degree, 1u);
  EXPECT_TRUE(mesh.curved_nodes.empty());
  std::string said;
  for (const std::string &remark : mesh.remarks)
    said += remark + '\n';
  EXPECT_NE(said.find(
              "instance 'two': 1 cells are straight but for the 6 digits"),
            std::string::npos)
    << said;
  EXPECT_EQ(read(part(3e-5) + assembly).curved_nodes.size(), 20u);
}

// As Abaqus/CAE writes it, a set of nodes and a set of elements have the same
// name. With two instances, names begin with that of the instance.
TEST_F(AbaqusFile, NamesOfInstances)
{
  const std::string part = "*PART, NAME=block\n" + nodes + cells +
                           "*NSET, NSET=Set-1\n10, 20, 30\n"
                           "*ELSET, ELSET=Set-1\n7\n*END PART\n"
                           "*ASSEMBLY, NAME=a\n*INSTANCE, NAME=one, "
                           "PART=block\n*END INSTANCE\n";
  const SerialMesh mesh = read(part + "*END ASSEMBLY\n");
  EXPECT_EQ(known_regions(mesh), (Known{"Body", "Set-1"}));
  EXPECT_NEAR(volume(mesh, "Set-1"), 1 / 6., 1e-15);
  EXPECT_NEAR(area(mesh, "Set-1"), 0.5, 1e-15);
  EXPECT_EQ(known_regions(read(part + "*INSTANCE, NAME=two, PART=block\n"
                                      "9, 0, 0\n*END INSTANCE\n")),
            (Known{"one.Body", "one.Set-1", "two.Body", "two.Set-1"}));
}

// A surface of one instance and a set of nodes of another one have the same
// name; both are boundaries.
TEST_F(AbaqusFile, OneNameInTwoInstances)
{
  const std::string part = nodes + cells;
  const SerialMesh  mesh = read(
    "*PART, NAME=p\n" + part + "*SURFACE, NAME=tip\n7, S1\n*END PART\n" +
    "*PART, NAME=q\n" + part +
    "*NSET, NSET=tip\n10, 20, 40\n*END PART\n"
     "*ASSEMBLY, NAME=a\n*INSTANCE, NAME=one, PART=p\n*END INSTANCE\n"
     "*INSTANCE, NAME=two, PART=q\n9, 0, 0\n*END INSTANCE\n*END ASSEMBLY\n");
  EXPECT_NEAR(area(mesh, "one.tip"), 0.5, 1e-15);
  EXPECT_NEAR(area(mesh, "two.tip"), 0.5, 1e-15);
}

// "instance.member" is a member of an instance, also where the assembly has a
// set with that name.
TEST_F(AbaqusFile, MembersOfInstances)
{
  const std::string start =
    "*PART, NAME=block\n" + nodes + cells +
    "*NSET, NSET=foot-1\n10, 20, 30\n*END PART\n"
    "*ASSEMBLY, NAME=a\n*INSTANCE, NAME=one, PART=block\n*END INSTANCE\n"
    "*INSTANCE, NAME=two, PART=block\n10., 0, 0\n*END INSTANCE\n";
  const SerialMesh mesh =
    read(start + "*NSET, NSET=held\none.foot-1, Two.20, TWO.30, two.10\n"
                 "*NSET, NSET=one.foot-1\ntwo.foot-1, two.50\n"
                 "*NSET, NSET=again\none.foot-1\n"
                 "*ELSET, ELSET=both\none.7, two.Body\n");
  EXPECT_NEAR(area(mesh, "held"), 1, 1e-14);
  EXPECT_NEAR(area(mesh, "again"), 0.5 + std::sqrt(0.75), 1e-14);
  EXPECT_NEAR(volume(mesh, "both"), 1 / 6. + 0.5, 1e-14);
  EXPECT_EQ(message(start + "*NSET, NSET=a\ntwo.12\n"),
            "part.inp:22: there is no node two.12 before this line");
  EXPECT_EQ(message(start + "*NSET, NSET=a\ntwo.hand\n"),
            "part.inp:22: there is no node and no set of nodes 'two.hand' "
            "before this line");
}
