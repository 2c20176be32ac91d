// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Functions that formulas have, against their definitions.

#include <corotet/base/expression.h>
#include <corotet/base/formula_functions.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace corotet;

namespace
{
  double
  at(const std::string &formula, const double t)
  {
    return Expression(formula, 1, "").value(dealii::Point<3>(), t);
  }
} // namespace

// Times are between 2 and 6, where s = (t - 2) / 4 is exact, and so are
// polynomials with small whole coefficients.
TEST(FormulaFunctions, FunctionsOfTime)
{
  const std::vector<double> times = {-1, 2, 3, 4, 5, 6, 7};

  const std::map<std::string, std::vector<double>> expected = {
    {"ramp", {0, 0, 0.25, 0.5, 0.75, 1, 1}},
    {"smooth_step", {0, 0, 53. / 512, 0.5, 459. / 512, 1, 1}},
    {"pulse", {0, 1, 1, 1, 1, 0, 0}},
    {"half_sine", {0, 0, std::sqrt(0.5), 1, std::sqrt(0.5), 0, 0}},
    {"triangle", {0, 0, 0.5, 1, 0.5, 0, 0}}};
  ASSERT_EQ(expected.size(), functions_of_time.size());
  for (const std::string &name : functions_of_time)
    for (unsigned int i = 0; i < times.size(); ++i)
      EXPECT_DOUBLE_EQ(at(name + "(t, 2, 6)", times[i]), expected.at(name)[i])
        << name << " at " << times[i];
  // The value must be exactly zero, lest a load that has ended goes on with
  // round-off.
  EXPECT_EQ(at("half_sine(t, 2, 6)", 6), 0);
}

// First and second derivatives, by central differences, are continuous where
// smooth_step begins and ends: with the step e they are zero up to a third
// derivative of 60 times e, and to round-off of 1e-16 / e^2.
TEST(FormulaFunctions, SmoothStepIsTwiceDifferentiable)
{
  const double e = 1e-5;
  for (const double t : {0., 1.})
    {
      const double before = at("smooth_step(t, 0, 1)", t - e);
      const double middle = at("smooth_step(t, 0, 1)", t);
      const double after  = at("smooth_step(t, 0, 1)", t + e);
      EXPECT_NEAR((after - before) / (2 * e), 0, 60 * e * e);
      EXPECT_NEAR((after - 2 * middle + before) / (e * e), 0, 60 * e + 1e-5);
    }
}

// An interval of no length is a step; one that ends before it begins is a
// mistake that must not pass as a number.
TEST(FormulaFunctions, DegenerateIntervals)
{
  for (const std::string name : {"ramp", "smooth_step"})
    {
      EXPECT_EQ(at(name + "(t, 1, 1)", 0.999), 0) << name;
      EXPECT_EQ(at(name + "(t, 1, 1)", 1), 1) << name;
    }
  for (const std::string name : {"pulse", "half_sine", "triangle"})
    for (const double t : {0.999, 1., 1.001})
      EXPECT_EQ(at(name + "(t, 1, 1)", t), 0) << name;
  for (const std::string &name : functions_of_time)
    for (const double t : {0., 1.5, 3.})
      EXPECT_TRUE(std::isnan(at(name + "(t, 2, 1)", t))) << name;
}

// A load must not be zero where its argument is not a number.
TEST(FormulaFunctions, NotANumberStaysNone)
{
  for (const std::string &name : functions_of_time)
    EXPECT_TRUE(std::isnan(at(name + "(sqrt(0 - 1 - t), 0, 1)", 0))) << name;
}

// These functions and operators formulas had already from deal.II's parser.
TEST(FormulaFunctions, GeneralFunctions)
{
  EXPECT_EQ(at("pi", 0), dealii::numbers::PI);
  EXPECT_EQ(at("if(t > 1, 2, 3)", 2), 2);
  EXPECT_EQ(at("if(t > 1, 2, 3)", 1), 3);
  EXPECT_EQ(at("if(t > 1 | t < 0, 2, 3)", -1), 2);
  EXPECT_EQ(at("if(t > 1 & t < 2, 2, 3)", 3), 3);
  EXPECT_EQ(at("int(t)", 2.6), 3);
  EXPECT_EQ(at("ceil(t)", 2.1), 3);
  EXPECT_EQ(at("floor(t)", 2.9), 2);
  EXPECT_EQ(at("pow(t, 3)", 2), 8);
  EXPECT_EQ(at("log(t)", 2), std::log(2.));
  EXPECT_EQ(at("erf(t)", 0.5), std::erf(0.5));
  EXPECT_EQ(at("erfc(t)", 0.5), std::erfc(0.5));
  EXPECT_EQ(at("cot(t)", 0.5), 1 / std::tan(0.5));
  EXPECT_EQ(at("csc(t)", 0.5), 1 / std::sin(0.5));
  EXPECT_EQ(at("sec(t)", 0.5), 1 / std::cos(0.5));
  // Blanks may stand before parentheses.
  EXPECT_EQ(at("max (t, 3) * (2)", 1), 6);
}

TEST(FormulaFunctions, KnowsItsNames)
{
  for (const std::string name :
       {"x", "t", "pi", "_e", "sin", "if", "rand", "ramp", "triangle"})
    EXPECT_TRUE(is_formula_name(name)) << name;
  for (const std::string name : {"", "quake", "X", "ramps"})
    EXPECT_FALSE(is_formula_name(name)) << name;
}
