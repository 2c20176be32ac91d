// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Each component of each boundary has one condition; supports move as their
// expressions say.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../body.h"
#include "../refusal.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  const PlaceNames names({{{0, "left"}, {1, "right"}, {2, "top"}}, {}},
                         {{{0, "line"}, {1, "right"}, {7, ""}}, {}},
                         {{{0, "point"}}, {}});

  std::string
  condition_refusal(
    const std::vector<std::pair<std::string, std::string>> &entries)
  {
    BoundaryConditionParameters parameters;
    dealii::ParameterHandler    prm;
    parameters.declare_parameters(prm);
    for (const auto &[entry, value] : entries)
      prm.set(entry, value);
    return refusal([&] { BoundaryConditions conditions(parameters, names); });
  }
} // namespace

TEST(BoundaryConditions, Refusals)
{
  EXPECT_EQ(condition_refusal({{"Fixed", "left, right, left"}}),
            "Boundary conditions/Fixed: component x of boundary 'left' has two "
            "conditions: found 'Fixed' and 'Fixed', allowed is one");
  EXPECT_EQ(condition_refusal(
              {{"Fixed", "left"}, {"Displacement", "left: 0; 0; 0"}}),
            "Boundary conditions/Displacement: component x of boundary 'left' "
            "has two conditions: found 'Fixed' and 'Displacement', allowed is "
            "one");
  EXPECT_EQ(condition_refusal({{"Displacement", "left: free; free; t"},
                               {"Traction", "left: 1; 0; 2"}}),
            "Boundary conditions/Traction: component z of boundary 'left' has "
            "two conditions: found 'Displacement' and 'Traction', allowed is "
            "one");
  EXPECT_EQ(condition_refusal(
              {{"Traction", "top: 1; 0; 0"}, {"Pressure", "top: 5"}}),
            "Boundary conditions/Pressure: component x of boundary 'top' has "
            "two conditions: found 'Traction' and 'Pressure', allowed is one");
  EXPECT_EQ(condition_refusal({{"Displacement", "left: 0; 0"}}),
            "Boundary conditions/Displacement: found 2 components for boundary "
            "'left'; allowed: 'x; y; z', three expressions or 'free'");
  EXPECT_EQ(condition_refusal({{"Displacement", "left: free, 0, 0"}}),
            "Boundary conditions/Displacement: found '0'; allowed: 'boundary: "
            "value, boundary: value'; components of a value are separated by "
            "';'");
  EXPECT_EQ(condition_refusal({{"Pressure", "1e5"}}),
            "Boundary conditions/Pressure: found '1e5'; allowed: 'boundary: "
            "value, boundary: value'");
  EXPECT_EQ(condition_refusal({{"Fixed", "left & top, top & left"}}),
            "Boundary conditions/Fixed: component x of boundary 'left & top' "
            "has two conditions: found 'Fixed' and 'Fixed', allowed is one");
  EXPECT_NE(condition_refusal({{"Fixed", "left & topp"}}).find("'topp'"),
            std::string::npos);
  EXPECT_NE(condition_refusal({{"Fixed", "lefft"}}).find("'left'"),
            std::string::npos);
}

// Names in quotes may have the characters that separate parts of lists.
TEST(BoundaryConditions, NamesInQuotes)
{
  const PlaceNames own({{{0, "face, x"}, {1, "a: b & c"}, {2, "top"}}, {}},
                       {{}, {}},
                       {{}, {}});
  const auto message = [&](const std::string &entry, const std::string &value) {
    BoundaryConditionParameters parameters;
    dealii::ParameterHandler    prm;
    parameters.declare_parameters(prm);
    prm.set(entry, value);
    return refusal([&] { BoundaryConditions conditions(parameters, own); });
  };
  for (const auto &[entry, value] :
       std::vector<std::pair<std::string, std::string>>{
         {"Fixed", "\"face, x\", top"},
         {"Fixed", "\"face, x\" & \"a: b & c\", \"top\""},
         {"Displacement", "\"a: b & c\" & \"face, x\": 0; 0; t"},
         {"Traction", "\"a: b & c\": 0; 0; 1, \"face, x\" : 1; 0; 0"},
         {"Pressure", "top: 1, \"face, x\": 2"}})
    EXPECT_EQ(message(entry, value), "nothing was refused") << value;
  EXPECT_EQ(message("Fixed", "face, x"),
            "Boundary conditions/Fixed: no such boundary: found 'face'; the "
            "mesh has the boundaries: \"face, x\", \"a: b & c\", top");
}

TEST(BoundaryConditions, DifferentComponentsMayDiffer)
{
  EXPECT_EQ(condition_refusal({{"Displacement", "left: free; free; max(t, 1)"},
                               {"Traction", "left: 1; 2*x; 0, right: 0; 0; 1"},
                               {"Pressure", "2: 1e5"}}),
            "nothing was refused");
  // A condition on the edge of two sides is no condition on these sides.
  EXPECT_EQ(condition_refusal({{"Displacement", "left & top: 0; 0; t"},
                               {"Traction", "left: 1; 2; 3"},
                               {"Pressure", "top: 1e5"}}),
            "nothing was refused");
}

// Edges and corners have conditions of their own, as boundaries have; but
// tractions and pressures need an area. A name that several things have means
// all of them; a number means a boundary rather than an edge.
TEST(BoundaryConditions, EdgesAndCorners)
{
  EXPECT_EQ(condition_refusal(
              {{"Fixed", "line, point, 7"}, {"Displacement", "left: 0; 0; 0"}}),
            "nothing was refused");
  EXPECT_EQ(condition_refusal(
              {{"Fixed", "line"}, {"Displacement", "line: free; 0; 0"}}),
            "Boundary conditions/Displacement: component y of edge 'line' has "
            "two conditions: found 'Fixed' and 'Displacement', allowed is one");
  EXPECT_EQ(condition_refusal({{"Fixed", "7, 7"}}),
            "Boundary conditions/Fixed: component x of edge '7' has two "
            "conditions: found 'Fixed' and 'Fixed', allowed is one");
  EXPECT_EQ(condition_refusal({{"Fixed", "line & left"},
                               {"Displacement", "left & line: 0; 0; 0"}}),
            "Boundary conditions/Displacement: component x of place 'line & "
            "left' has two conditions: found 'Fixed' and 'Displacement', "
            "allowed is one");
  EXPECT_EQ(condition_refusal({{"Displacement", "point: 0; 0"}}),
            "Boundary conditions/Displacement: found 2 components for corner "
            "'point'; allowed: 'x; y; z', three expressions or 'free'");
  EXPECT_EQ(
    condition_refusal({{"Traction", "line: 1; 0; 0"}}),
    "Boundary conditions/Traction: a traction acts on an area: found "
    "'line', which is an edge; allowed are boundaries, and the mesh has "
    "the boundaries: left, right, top");
  EXPECT_EQ(condition_refusal({{"Pressure", "point: 1"}}),
            "Boundary conditions/Pressure: a pressure acts on an area: found "
            "'point', which is a corner; allowed are boundaries, and the mesh "
            "has the boundaries: left, right, top");
  // The boundary with this name has an area; the edge with it has none.
  EXPECT_EQ(condition_refusal({{"Pressure", "right: 1"}}),
            "nothing was refused");
  EXPECT_EQ(condition_refusal({{"Fixed", "pont"}}),
            "Boundary conditions/Fixed: no such boundary, edge or corner: "
            "found 'pont'; the mesh has the boundaries: left, right, top; the "
            "edges: line, right, 7; the corners: point; did you mean 'point'?");
  using Ids = std::vector<unsigned int>;
  EXPECT_EQ(names.find("right", ""), (Place{Ids{1}, Ids{1}, {}}));
  EXPECT_EQ(names.find("1", ""), (Place{Ids{1}, {}, {}}));
  EXPECT_EQ(names.find("7", ""), (Place{{}, Ids{7}, {}}));
  EXPECT_EQ(names.name(names.find("right", "")), "right");
}

// A name of several boundaries is a condition on each of them.
TEST(BoundaryConditions, NamesOfSeveralBoundaries)
{
  const PlaceNames several(
    {{{0, "left"}, {1, "right"}, {2, "top"}}, {{"sides", {0, 1}}}});
  BoundaryConditionParameters parameters;
  parameters.fixed    = "sides & top";
  parameters.pressure = "sides: 3";
  const BoundaryConditions conditions(parameters, several);
  ASSERT_EQ(conditions.pressures.size(), 2u);
  EXPECT_EQ(conditions.pressures[0].boundary, 0u);
  EXPECT_EQ(conditions.pressures[1].boundary, 1u);
  ASSERT_EQ(conditions.displacements.size(), 1u);
  EXPECT_EQ(conditions.name(conditions.displacements[0].places), "sides & top");
  const auto message = [&](const std::string &fixed,
                           const std::string &pressure) {
    parameters.fixed    = fixed;
    parameters.pressure = pressure;
    return refusal([&] { BoundaryConditions failing(parameters, several); });
  };
  EXPECT_EQ(message("sides, left", ""),
            "Boundary conditions/Fixed: component x of boundary 'left' has two "
            "conditions: found 'Fixed' and 'Fixed', allowed is one");
  EXPECT_EQ(message("right", "sides: 1"),
            "Boundary conditions/Pressure: component x of boundary 'right' has "
            "two conditions: found 'Fixed' and 'Pressure', allowed is one");
  EXPECT_EQ(message("", "sides: 1, right: 2"),
            "Boundary conditions/Pressure: found boundary 'right' twice; "
            "allowed: each boundary once");
}

// Edges and corners are the nodes on all boundaries that are named, whatever
// rank has the faces: an edge of 2 x 2 x 2 cuboids of degree p has 2 p + 1
// nodes.
TEST(PrescribedMotion, EdgesAndCorners)
{
  for (const unsigned int degree : {1u, 2u, 3u})
    {
      MovingBody body(box("1, 1, 1", "2, 2, 2"),
                      element_text(degree) + fixed("x-max & y-max & z-max") +
                        displacements("x-min & z-min: free; free; 0.1"));
      body.system.prescribe(body.state, 0., 1.);
      std::vector<unsigned int> n_found(4);
      for (const unsigned int i : body.motion.unknowns())
        {
          const auto x = body.discretization.node_position(i / 3);
          if (i % 3 == 2 && x[0] < 1e-10 && x[2] < 1e-10)
            {
              ++n_found[3];
              EXPECT_EQ(body.state.u.local_element(i), 0.1);
            }
          else
            {
              ++n_found[i % 3];
              EXPECT_LT(x.distance(dealii::Point<3>(1, 1, 1)), 1e-10);
            }
        }
      dealii::Utilities::MPI::sum(n_found, MPI_COMM_WORLD, n_found);
      EXPECT_EQ(n_found, (std::vector<unsigned int>{1, 1, 1, 2 * degree + 1}));

      // Other ranks have the same prescribed unknowns in their copies of nodes.
      Vector marks;
      body.discretization.initialize_vector(marks);
      for (const unsigned int i : body.motion.unknowns())
        marks.local_element(i) = 1;
      marks.update_ghost_values();
      for (unsigned int i = 0; i < 3 * body.discretization.n_local_nodes(); ++i)
        EXPECT_EQ(body.motion.is_prescribed()[i], marks.local_element(i));
    }
}

TEST(PrescribedMotion, BoundariesThatDoNotMeetAreRefused)
{
  EXPECT_EQ(refusal([] {
              MovingBody body(box("1, 1, 1", "1, 1, 1"),
                              fixed("x-min & x-max"));
            }),
            "Boundary conditions/Fixed: boundaries have no node in common: "
            "found 'x-min & x-max'; allowed are those that meet in an edge or "
            "a corner");
}

// Prescribed nodes move by the expression; velocity and acceleration are its
// derivatives, to the round-off of numbers of size one.
TEST(PrescribedMotion, DerivativesInTime)
{
  MovingBody   body(box("1, 1, 1", "2, 2, 2"),
                  displacements("x-min: 0.1*sin(3*t); free; y*t^2, "
                                  "x-max: 0; 0; 0") +
                    section("Time integration", {{"Time step", 0.01}}));
  const double t = 0.7;
  body.system.prescribe(body.state, t, 1.);
  unsigned int n_found = 0;
  for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
    {
      const auto x = body.discretization.node_position(n);
      if (x[0] > 1e-10)
        continue;
      ++n_found;
      EXPECT_EQ(body.state.u.local_element(3 * n), 0.1 * std::sin(3 * t));
      EXPECT_NEAR(body.state.v.local_element(3 * n),
                  0.3 * std::cos(3 * t),
                  1e-15);
      EXPECT_NEAR(body.state.a.local_element(3 * n),
                  -0.9 * std::sin(3 * t),
                  1e-15);
      EXPECT_EQ(body.state.u.local_element(3 * n + 1), 0.);
      EXPECT_NEAR(body.state.v.local_element(3 * n + 2), 2 * x[1] * t, 1e-15);
      EXPECT_NEAR(body.state.a.local_element(3 * n + 2), 2 * x[1], 1e-15);
    }
  EXPECT_EQ(dealii::Utilities::MPI::sum(n_found, MPI_COMM_WORLD), 25u);
}

// Two supports that share an edge, x = 0 and z = 3, must agree there: they do
// at t = 0, and no longer at t = 1. With one condition per rank's faces, both
// ranks throw.
TEST(PrescribedMotion, DisagreementIsRefused)
{
  MovingBody body(box("1, 1, 3", "2, 2, 2"),
                  fixed("x-min") + displacements("z-max: 0.1*t; free; 0"));
  EXPECT_EQ(refusal([&] { body.system.prescribe(body.state, 0., 1.); }),
            "nothing was refused");
  const std::string text =
    refusal([&] { body.system.prescribe(body.state, 1., 1.); });
  EXPECT_EQ(text.find(
              "Boundary conditions/Displacement: boundaries 'x-min' and "
              "'z-max' prescribe different displacements in x at their "
              "common point (0, "),
            0u)
    << text;
  EXPECT_NE(text.find(", 3) at t = 1: found 0 and 0.1, allowed are equal ones"),
            std::string::npos)
    << text;
}

TEST(PrescribedMotion, NotFiniteIsRefused)
{
  MovingBody body(box("1, 1, 1", "1, 1, 1"), displacements("x-min: 1/t; 0; 0"));
  EXPECT_EQ(
    refusal([&] { body.system.prescribe(body.state, 0., 1.); }),
    "Boundary conditions/Displacement: the displacement at t = 0 is not "
    "finite: found inf");
}

// This displacement is finite at t = 0 only, so it has no derivatives.
TEST(PrescribedMotion, NoVelocityIsRefused)
{
  MovingBody        body(box("1, 1, 1", "1, 1, 1"),
                  displacements("x-min: sqrt(-t^2); 0; 0"));
  const std::string text =
    refusal([&] { body.system.prescribe(body.state, 0., 1.); });
  EXPECT_EQ(text.find("Boundary conditions/Displacement: the displacement has "
                      "no velocity or acceleration at t = 0: found "),
            0u)
    << text;
  EXPECT_NE(text.find("allowed are finite ones"), std::string::npos) << text;
}
