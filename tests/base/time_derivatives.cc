// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Time derivatives of expressions: compared with ones worked out by hand, with
// differences for each function, and at kinks with the derivatives on the
// right.

#include <corotet/base/expression.h>
#include <corotet/base/formula_functions.h>
#include <corotet/base/jet_formula.h>

#include <gtest/gtest.h>
#include <muParser.h>

#include <cmath>
#include <functional>

using namespace corotet;

namespace
{
  const dealii::Point<3> p(0.3, 0.7, -0.4);

  // A width of differences that must not be used, as derivatives exist.
  constexpr double no_width = std::numeric_limits<double>::quiet_NaN();

  std::array<double, 2>
  derivatives(const std::string    &formula,
              const double          t,
              const double          width  = no_width,
              const TableFunctions &tables = {})
  {
    return Expression(formula, 1, "", tables).time_derivatives(p, t, width);
  }

  void
  expect(const std::string &formula,
         const double       t,
         const double       first,
         const double       second)
  {
    const auto found = derivatives(formula, t);
    // The round-off of some tens of operations.
    EXPECT_NEAR(found[0], first, 1e-14 * (1 + std::abs(first)))
      << formula << " at " << t;
    EXPECT_NEAR(found[1], second, 1e-14 * (1 + std::abs(second)))
      << formula << " at " << t;
  }

  TableFunctions
  tables()
  {
    using Interpolation = TableFunction::Interpolation;
    const std::vector<double> arguments{0, 1, 3}, values{1, 2, 8};
    return {{"line",
             std::make_shared<const TableFunction>(arguments,
                                                   values,
                                                   Interpolation::linear)},
            {"curve",
             std::make_shared<const TableFunction>(arguments,
                                                   values,
                                                   Interpolation::cubic)}};
  }
} // namespace

TEST(TimeDerivatives, ComposedFormulas)
{
  using std::cos, std::exp, std::log, std::sin, std::sqrt;
  const double x = p[0], y = p[1];
  for (const double t : {0.1, 0.7, 1.3})
    {
      const double w = 2 * M_PI * 3;
      expect("1e-1*sin(2*pi*3*t)",
             t,
             0.1 * w * cos(w * t),
             -0.1 * w * w * sin(w * t));
      expect("x*t^2 - y*t + z", t, 2 * x * t - y, 2 * x);
      expect("exp(-t)*cos(4*t)",
             t,
             -exp(-t) * (cos(4 * t) + 4 * sin(4 * t)),
             exp(-t) * (8 * sin(4 * t) - 15 * cos(4 * t)));
      expect("sqrt(1 + t^2)",
             t,
             t / sqrt(1 + t * t),
             std::pow(1 + t * t, -1.5));
      expect("t^t",
             t,
             std::pow(t, t) * (log(t) + 1),
             std::pow(t, t) * (std::pow(log(t) + 1, 2) + 1 / t));
      expect("x*(cos(t) - 1) - y*sin(t)",
             t,
             -x * sin(t) - y * cos(t),
             -x * cos(t) + y * sin(t));
      expect("atan2(sin(t), cos(t))", t, 1, 0);
      expect("1/(1 + t)", t, -1 / ((1 + t) * (1 + t)), 2 / std::pow(1 + t, 3));
      expect("if(t < 0.5, t^2, 3*t)", t, t < 0.5 ? 2 * t : 3, t < 0.5 ? 2 : 0);
      const std::string pieces = "t < 0.5 ? t^2 : t > 1 ? 2*t : t^3";
      if (t < 0.5)
        expect(pieces, t, 2 * t, 2);
      else if (t > 1)
        expect(pieces, t, 2, 0);
      else
        expect(pieces, t, 3 * t * t, 6 * t);
      expect("sqrt(y - 0.7)*t + 0*x", t, 0, 0);
      expect("5 + x", t, 0, 0);
      const double s = t / 2;
      expect("smooth_step(t, 0, 2)",
             t,
             30 * s * s * (1 - s) * (1 - s) / 2,
             60 * s * (1 - s) * (1 - 2 * s) / 4);
    }
}

// Every function that formulas have, of muParser or not, has its rule: compared
// with differences of fourth order, whose error is h^4 = 1e-12 times a
// derivative and round-off of 1e-15 / h^2 = 1e-9.
TEST(TimeDerivatives, EveryFunction)
{
  mu::Parser parser;
  define_functions(parser);
  unsigned int n = 0;
  for (const auto &[name, callback] : parser.GetFunDef())
    {
      const std::string shift = name == "acosh" ? "1.5" : "0.2";
      const std::string a     = shift + " + 0.4*t^2";
      std::string       text  = name + "(" + a;
      if (name == "if")
        text += ", t, t^3";
      else if (std::find(functions_of_time.begin(),
                         functions_of_time.end(),
                         name) != functions_of_time.end())
        text += ", 0.1, 1 + 0.1*t";
      else if (callback.GetArgc() == 2 || callback.GetArgc() < 0)
        text += ", 0.3 + 0.2*t";
      text += ")";
      const Expression e(text, 1, "");
      const double     t = 0.6, h = 1e-3;
      const auto       u = [&](const int i) { return e.value(p, t + i * h); };
      const auto       found = e.time_derivatives(p, t, no_width);
      EXPECT_NEAR(found[0],
                  (u(-2) - u(2) + 8 * (u(1) - u(-1))) / (12 * h),
                  1e-9)
        << text;
      EXPECT_NEAR(found[1],
                  (16 * (u(1) + u(-1)) - u(2) - u(-2) - 30 * u(0)) /
                    (12 * h * h),
                  1e-8)
        << text;
      ++n;
    }
  EXPECT_GE(n, 35u);
}

// A formula means the same with derivatives and without: precedence of
// operators and numbers are those of muParser.
TEST(TimeDerivatives, SameSyntax)
{
  for (const std::string formula : {"-x^2",
                                    "2^x^y",
                                    "-2^2*x",
                                    "2^-x*3",
                                    "2^-x^2",
                                    "-x*y - -y",
                                    "x - y - z",
                                    "x/y*z",
                                    "x/y/z",
                                    "2*-x",
                                    "1/3 + .5 + 5. + 1e2*x + 2.5E-1*y + 1e+1",
                                    "(x + y)^-1",
                                    "x < y",
                                    "x + 1 > y + 2 || y >= 0.7",
                                    "x < y && y < z || x == 0.3",
                                    "x != 0.3 | y <= 0.7 & z < 0",
                                    "1 < 2 < 0",
                                    "x > 0 ? y > 1 ? 1 : 2 : 3",
                                    "x < 0 ? 1 : y < 0 ? 2 : 3",
                                    "max (x, y , z) * ( 2 )",
                                    "min(x, y, z) + avg(x, y) + sum(x, y, z)",
                                    "_pi + _e + pi",
                                    "rint(2.4) + int(-2.6) + sign(z) + ceil(y)",
                                    "log10(x)+log2(x)+ln(y)+atan2(y, z)"})
    EXPECT_NEAR(JetFormula(formula, {}).value({{p[0], p[1], p[2], 0.9}}).value,
                Expression(formula, 1, "").value(p, 0.9),
                1e-14)
      << formula;
}

// At a kink or jump the derivatives are exactly those on its right: nothing of
// the left side, and nothing infinite. This holds also where the time is that
// of the kink up to round-off, as times of steps are.
TEST(TimeDerivatives, WhatFollowsAtKinks)
{
  expect("ramp(t, 0, 2)", 0, 0.5, 0);
  expect("ramp(t, 0, 2)", 2, 0, 0);
  expect("ramp(-t, -2, 0)", 2, 0, 0);
  expect("triangle(t, 0, 1)", 0, 2, 0);
  expect("triangle(t, 0, 1)", 0.5, -2, 0);
  expect("triangle(t, 0, 1)", 1, 0, 0);
  expect("half_sine(t, 0, 1)", 1, 0, 0);
  expect("pulse(t, 0, 1)*t", 0, 1, 0);
  expect("pulse(t, 0, 1)*t", 1, 0, 0);
  // A constant argument where the pulse begins is inside of the pulse for ever,
  // one where it ends is outside.
  expect("pulse(1, 1, 2)*t", 0.5, 1, 0);
  expect("pulse(2, 1, 2)*t", 0.5, 0, 0);
  expect("abs(t)", 0, 1, 0);
  expect("abs(-t)", 0, 1, 0);
  expect("min(t, 2 - t)", 1, -1, 0);
  expect("max(t^2, t)", 0, 1, 0);
  expect("t - floor(t)", 1, 1, 0);
  expect("(floor(1 - t) + 2)*t", 0, 2, 0);
  expect("if(t <= 1, t, 5 - 4*t)", 1, -4, 0);
  expect("if(t == 1, 0, t)", 1, 1, 0);
  expect("t > 1 ? t^2 : t", 1, 2, 2);
  for (const double third : {1. / 3, std::nextafter(1. / 3, 0.), 1 - 2. / 3})
    {
      expect("triangle(3*t, 0, 2)", third, -3, 0);
      expect("abs(3*t - 1)", third, 3, 0);
      expect("ramp(t, 1/3, 4/3)", third, 1, 0);
      expect("floor(3*t)*t", third, 1, 0);
    }
}

// Derivatives of a table are those of its polynomials: here 1 + t and 3 t - 1;
// for cubic interpolation, with slopes s at the rows, the Hermite polynomials.
TEST(TimeDerivatives, Tables)
{
  const auto at = [](const std::string &formula, const double t) {
    return derivatives(formula, t, no_width, tables());
  };
  const auto expect_line =
    [&](const std::string &formula, const double t, const double first) {
      EXPECT_EQ(at(formula, t)[0], first) << formula << " at " << t;
      EXPECT_EQ(at(formula, t)[1], 0) << formula << " at " << t;
    };
  expect_line("line(t)", -1, 0);
  expect_line("line(t)", 0, 1);
  expect_line("line(t)", 0.5, 1);
  expect_line("line(t)", 1, 3);
  expect_line("line(t)", std::nextafter(1., 0.), 3);
  expect_line("line(t)", 3, 0);
  expect_line("line(2 - t)", 1, -1);

  // The slopes are those of the parabola through three rows: 1/3, 5/3 and at
  // the end 13/3. In the first interval s = t.
  const double s = 0.25, a = 1. / 3, b = 5. / 3;
  const double c2 = 3 - 2 * a - b, c3 = a + b - 2;
  const auto   found = at("curve(t)", s);
  EXPECT_NEAR(found[0], a + 2 * c2 * s + 3 * c3 * s * s, 1e-15);
  EXPECT_NEAR(found[1], 2 * c2 + 6 * c3 * s, 2e-15);
  // Slopes are continuous, so the chain rule holds at rows, too.
  EXPECT_NEAR(at("curve(sin(t))", 0)[0], a, 1e-15);
  EXPECT_NEAR(at("curve(t)", 1)[0], b, 1e-15);
  EXPECT_NEAR(at("curve(t)", std::nextafter(1., 0.))[0], b, 1e-14);
  EXPECT_EQ(at("curve(t)", 3)[0], 0);
}

// Where there is no finite derivative, differences of the given width replace
// it: exact for polynomials of degree three (first derivative) and two
// (second).
TEST(TimeDerivatives, DifferencesWhereThereIsNone)
{
  const double h = 1e-3;
  // A triangle wave whose derivative is zero over zero at its peaks.
  for (const double t : {0.25, 1.25})
    {
      const auto found = derivatives("asin(sin(2*pi*t))", t, h);
      EXPECT_NEAR(found[0], -2 * M_PI, 1e-8);
      EXPECT_NEAR(found[1], 0, 1e-4);
    }
  const auto root = derivatives("sqrt(t^2)", 0, h);
  EXPECT_NEAR(root[0], 1, 1e-14);
  EXPECT_NEAR(root[1], 0, 1e-11);
  // Differences are backward where the domain of the formula ends.
  EXPECT_TRUE(std::isfinite(derivatives("sqrt(1 - t)^3", 1, h)[0]));
  EXPECT_TRUE(std::isfinite(derivatives("sqrt(1 - t)", 1, h)[1]));
  // This function is smooth, but the rules give no finite derivative.
  const auto flat = derivatives("if(t > 0, exp(-1/t), 0)", 0, h);
  EXPECT_LT(std::abs(flat[0]), 1e-100);
  EXPECT_LT(std::abs(flat[1]), 1e-100);
  EXPECT_FALSE(std::isfinite(derivatives("0/t*t", 0, h)[0]));
}
