// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Names by place.

#include <corotet/mesh/box_mesh.h>

#include <gtest/gtest.h>

#include <numbers>

#include "surfaces.h"

namespace
{
  using namespace corotet;
  using namespace corotet::tests;
  using dealii::Point;

  struct Selecting : public testing::Test
  {
    TemporaryFolder folder;

    // The box [0, 2] x [0, 1] x [0, 1], or a sphere of radius 1.
    static SerialMesh
    box()
    {
      BoxMesh                  source;
      dealii::ParameterHandler prm;
      source.declare_parameters(prm);
      prm.set("Size", "2, 1, 1");
      prm.set("Cells", "8, 4, 4");
      return source.create("");
    }

    SerialMesh
    sphere() const
    {
      return read_file(
        folder.write("sphere.stl", stl_text(sphere_triangles(4))));
    }

    static SerialMesh
    with(const SerialMesh  &mesh,
         const std::string &boundaries,
         const std::string &regions = "")
    {
      SelectionParameters parameters;
      parameters.boundaries = boundaries;
      parameters.regions    = regions;
      return with_selections(mesh, parameters);
    }

    static double
    selected_area(const std::string &selection)
    {
      return tests::area(with(box(), "chosen: " + selection), "chosen");
    }

    static double
    selected_volume(const std::string &selection)
    {
      return tests::volume(with(box(), "", "chosen: " + selection), "chosen");
    }
  };



  TEST_F(Selecting, Shapes)
  {
    EXPECT_NEAR(selected_area("box 0 0 1 2 1 1"), 2, 1e-14);
    // A shape selects the faces with all corners inside or on its border; the
    // two corners of a box may be given in any order.
    EXPECT_NEAR(selected_area("box 1.1 1 1.5 0.5 0 0.9"), 0.5, 1e-14);
    EXPECT_NEAR(selected_area("plane 7 0 1 0 0 -3"), 2, 1e-14);
    EXPECT_NEAR(selected_area("plane 0 0 0.5 0 0 1 or x-min"), 1, 1e-14);
    EXPECT_NEAR(selected_area("normal 0 0 1"), 2, 1e-14);
    EXPECT_NEAR(selected_area("normal 0 0.08 1"), 2, 1e-14);
    EXPECT_NEAR(selected_area("normal 1 1 0 46"), 3, 1e-14);
    EXPECT_NEAR(selected_area("patch 0.3 0.4 3"), 2, 1e-14);
    EXPECT_NEAR(selected_area("patch -1 0.5 0.5 89"), 1, 1e-14);
    EXPECT_NEAR(selected_area("patch -1 0.5 0.5 91"), 10, 1e-13);
    // Two triangles of each of four squares are around the centre of a side.
    EXPECT_NEAR(selected_area("sphere 0 0.5 0.5 0.36"), 0.25, 1e-14);
    EXPECT_NEAR(selected_area("cylinder 0 0.5 0.5 1 0.5 0.5 0.36"),
                0.25,
                1e-14);
    EXPECT_NEAR(selected_area("cylinder -1 0.5 0.5 3 0.5 0.5 0.36"),
                0.5,
                1e-14);

    EXPECT_NEAR(selected_volume("box 0 0 0 1 1 1"), 1, 1e-14);
    EXPECT_NEAR(selected_volume("not box 0 0 0 0.5 1 1"), 1.5, 1e-14);
    EXPECT_NEAR(selected_volume("cylinder 0 0 0 2 0 0 9"), 2, 1e-13);
    EXPECT_NEAR(selected_volume("sphere 0 0 0 9"), 2, 1e-13);
    EXPECT_NEAR(selected_volume("body"), 2, 1e-13);
  }



  // "not" binds closest, then "and"; parentheses need no blanks.
  TEST_F(Selecting, Combinations)
  {
    EXPECT_NEAR(selected_area("z-max and box 0 0 0 1 1 1"), 1, 1e-14);
    EXPECT_NEAR(selected_area("x-min or z-max and box 0 0 0 1 1 1"), 2, 1e-14);
    EXPECT_NEAR(selected_area("(x-min or z-max) and box 0 0 0 1 1 1"),
                2,
                1e-14);
    EXPECT_NEAR(selected_area("(x-min or z-max)and(x-max or z-max)"), 2, 1e-14);
    EXPECT_NEAR(selected_area("not x-min and not x-max"), 8, 1e-13);
    EXPECT_NEAR(selected_area("not (x-min or x-max)"), 8, 1e-13);
    EXPECT_NEAR(selected_area("not not x-min"), 1, 1e-14);
  }



  // Names in quotes may have the characters that separate parts of lists and
  // selections.
  TEST_F(Selecting, NamesInQuotes)
  {
    SerialMesh body = box();
    for (auto &[id, name] : body.boundaries.names)
      if (name == "x-min")
        name = "(left) and, lower";
    const SerialMesh mesh =
      with(body,
           "\"a, b\": \"(left) and, lower\" or z-max, "
           "c: not \"a, b\" and not \"(left) and, lower\"");
    EXPECT_NEAR(tests::area(mesh, "a, b"), 3, 1e-14);
    EXPECT_NEAR(tests::area(mesh, "c"), 7, 1e-14);
  }



  // Earlier names keep their meaning, and a selection can use those before it.
  TEST_F(Selecting, Overlaps)
  {
    const SerialMesh mesh =
      with(box(),
           "half: box 0 0 0 1 1 1, top of it: half and z-max, rest: not half",
           "left: box 0 0 0 1 1 1, lower left: left and box 0 0 0 2 1 0.5");
    EXPECT_NEAR(tests::area(mesh, "half"), 5, 1e-13);
    EXPECT_NEAR(tests::area(mesh, "top of it"), 1, 1e-14);
    EXPECT_NEAR(tests::area(mesh, "rest"), 5, 1e-13);
    for (const std::string name : {"z-max", "z-min", "y-max", "y-min"})
      EXPECT_NEAR(tests::area(mesh, name), 2, 1e-13);
    for (const std::string name : {"x-max", "x-min"})
      EXPECT_NEAR(tests::area(mesh, name), 1, 1e-13);
    EXPECT_NEAR(tests::volume(mesh, "left"), 1, 1e-14);
    EXPECT_NEAR(tests::volume(mesh, "lower left"), 0.5, 1e-14);
    // Numbers keep their meaning, too.
    for (const std::string number : {"0", "1"})
      EXPECT_NEAR(tests::area(mesh, number), 1, 1e-13);
    for (const std::string number : {"2", "3", "4", "5"})
      EXPECT_NEAR(tests::area(mesh, number), 2, 1e-13);
    EXPECT_NEAR(tests::volume(mesh, "0"), 2, 1e-13);
    EXPECT_NEAR(total(region_volumes(mesh)), 2, 1e-13);
  }



  // Selections work on a surface that has no names.
  TEST_F(Selecting, WithoutNames)
  {
    SerialMesh mesh = box();
    mesh.faces.clear();
    mesh.boundaries       = {};
    const SerialMesh part = with(mesh, "top: normal 0 0 1");
    EXPECT_NEAR(tests::area(part, "top"), 2, 1e-14);
    EXPECT_EQ(part.faces.size(), 64u);
    // The id that the other faces had meanwhile is not left behind.
    EXPECT_EQ(part.boundaries.parts.size(), 0u);
    const SerialMesh all = with(mesh, "all: sphere 0 0 0 9");
    EXPECT_NEAR(tests::area(all, "all"), 10, 1e-13);

    // Faces without a name are still without a name for later selections.
    const SerialMesh later = with(
      part,
      "sides: not top, same: sides, upper: not sides, some: same and normal 1 0 0, most: sides and not some");
    EXPECT_NEAR(tests::area(later, "sides"), 8, 1e-13);
    EXPECT_NEAR(tests::area(later, "same"), 8, 1e-13);
    EXPECT_NEAR(tests::area(later, "upper"), 2, 1e-14);
    EXPECT_NEAR(tests::area(later, "some"), 1, 1e-14);
    EXPECT_NEAR(tests::area(later, "most"), 7, 1e-13);

    // A cap of a sphere, as seen from outside: 2 pi (1 - cos 30 degrees).
    const double cap   = 2 * std::numbers::pi * (1 - std::sqrt(0.75));
    const auto   round = with(sphere(),
                            "cap: normal 1 1 1 30, ball: patch 0 0 5, "
                              "other half: not box 0 -1 -1 1 1 1");
    EXPECT_NEAR(tests::area(round, "cap"), cap, 0.05 * cap);
    EXPECT_NEAR(tests::area(round, "ball"),
                tests::area(round, "surface 1"),
                1e-13);
    EXPECT_NEAR(tests::area(round, "other half"),
                tests::area(round, "ball") / 2,
                1e-12);
  }



  // Parts without a name are known by their numbers, which no selection may
  // take as its name.
  TEST_F(Selecting, NumbersAreNames)
  {
    SerialMesh body = box();
    for (auto &[id, name] : body.boundaries.names)
      name.clear();
    body.regions = {};
    EXPECT_NEAR(tests::area(with(body, "top: 5"), "top"), 2, 1e-14);
    for (const std::string number : {"0", "5"})
      EXPECT_EQ(refusal([&] { with(body, number + ": normal 0 0 1"); }),
                "Selections/Boundaries: the mesh has this name, or another "
                "selection: found '" +
                  number + "'; give another one");
    EXPECT_NEAR(tests::area(with(body, "6: normal 0 0 1"), "6"), 2, 1e-14);
    EXPECT_EQ(refusal([&] { with(body, "", "0: box 0 0 0 1 1 1"); }),
              "Selections/Regions: the mesh has this name, or another "
              "selection: found '0'; give another one");
  }



  TEST_F(Selecting, Refusals)
  {
    const auto says = [](const std::string &selection,
                         const std::string &message) {
      const std::string said =
        refusal([&] { with(box(), "chosen: " + selection); });
      EXPECT_EQ(said.find("Selections/Boundaries: "), 0u) << said;
      EXPECT_NE(said.find(message), std::string::npos) << said;
    };
    says("sphere 0 0 4 1",
         "selection 'chosen' has no face; the nearest to 'sphere 0 0 4 1' is ");
    says("plane 0 0 1.25 0 0 1",
         "the nearest to 'plane 0 0 1.25 0 0 1' is 0.25 m away");
    says("normal 1 1 1 10", "is 44.74 degrees away");
    says("x-min and x-max", "selection 'chosen' has no face");
    says("x-min and plane 2 0 0 1 0 0",
         "the nearest to 'plane 2 0 0 1 0 0' is inside");
    says("box 0 0 0 1 1",
         "a shape has another number of numbers: found 'box 0 0 0 1 1'; "
         "allowed is 'box x y z x y z'");
    says("box 0 0 0 1 1 one", "a shape has a word that is no number");
    says("box 0 0 0 1 1 inf", "a shape has a word that is no number");
    says("sphere 0 0 0 0", "a radius is not positive");
    says("plane 0 0 0 0 0 0", "a direction is zero");
    says("normal 0 0 0", "a direction is zero");
    says("cylinder 1 2 3 1 2 3 1", "an axis has no length");
    says("z-mx", "no such boundary: found 'z-mx'");
    says("z-mx", "did you mean 'z-max'?");
    says("x-min x-max and", "no such boundary: found 'x-min x-max'");
    says("x-min and",
         "a shape or a name is expected in 'x-min and': found the end");
    says("(x-min", "')' is expected in '(x-min': found the end");
    says("x-min)", "'and' or 'or' is expected in 'x-min)': found ')'");
    says("", "a shape or a name is expected in '': found the end");
    says(std::string(500, '(') + "x-min", "more than 100 parentheses");
    EXPECT_EQ(refusal([] { with(box(), "x-max: x-min"); }),
              "Selections/Boundaries: the mesh has this name, or another "
              "selection: found 'x-max'; give another one");
    EXPECT_EQ(refusal([] { with(box(), ": x-min"); }),
              "Selections/Boundaries: a selection has no name: found 'x-min'; "
              "allowed: 'name: selection'");
    EXPECT_EQ(refusal([] { with(box(), "x-min"); }),
              "Selections/Boundaries: found 'x-min'; allowed: "
              "'name: selection, name: selection'");
    for (const std::string shape : {"normal 0 0 1", "patch 0 0 1"})
      EXPECT_EQ(refusal([&] { with(box(), "", "part: " + shape); }),
                "Selections/Regions: a cell has no normal and is on no patch: "
                "found '" +
                  shape +
                  "'; allowed are 'box x y z x y z', 'cylinder x y z x y z "
                  "radius', 'plane x y z nx ny nz', 'sphere x y z radius'");
  }
} // namespace
