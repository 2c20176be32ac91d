// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Derivatives of formulas are compared with ones worked out by hand, by their
// values: how their texts are written does not matter.

#include <corotet/base/differentiation.h>
#include <corotet/base/exceptions.h>
#include <corotet/base/expression.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace corotet;

namespace
{
  const dealii::Point<3> p(0.3, 0.7, -0.4);
  const double           t = 1.2;

  double
  value(const std::string &formula)
  {
    return Expression(formula, 1, "Entry").value(p, t);
  }

  double
  derivative(const std::string              &formula,
             const std::vector<std::string> &variables)
  {
    return value(differentiate(formula, variables, "Entry"));
  }

  std::string
  derivative_refusal(const std::string &formula)
  {
    try
      {
        differentiate(formula, {"x"}, "Exact solution/Displacement");
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(error.entry, "Exact solution/Displacement");
        return error.what();
      }
    return "accepted";
  }

  // The round-off of some operations on numbers of size one.
  constexpr double round_off = 1e-14;
} // namespace

TEST(Differentiation, Derivatives)
{
  const double x = p[0], y = p[1], z = p[2];
  EXPECT_NEAR(derivative("x^3*y - 2*t", {"x"}), 3 * x * x * y, round_off);
  EXPECT_NEAR(derivative("x^3*y - 2*t", {"x", "y"}), 3 * x * x, round_off);
  EXPECT_NEAR(derivative("x^3*y - 2*t", {"t"}), -2, round_off);
  EXPECT_NEAR(derivative("5", {"z"}), 0, round_off);
  EXPECT_NEAR(derivative("sin(pi*x)*exp(-t)", {"t", "t"}),
              std::sin(M_PI * x) * std::exp(-t),
              round_off);
  EXPECT_NEAR(derivative("sqrt(x + y)/z", {"z"}),
              -std::sqrt(x + y) / (z * z),
              round_off);
  EXPECT_NEAR(derivative("atan(x/y)", {"x"}), y / (x * x + y * y), round_off);
  EXPECT_NEAR(derivative("(1 + x)^(1/y)", {"x"}),
              std::pow(1 + x, 1 / y - 1) / y,
              round_off);
  EXPECT_NEAR(derivative("pow(x, y)", {"y"}),
              std::pow(x, y) * std::log(x),
              round_off);
  EXPECT_NEAR(derivative("1.5e-1*tanh(x)", {"x"}),
              0.15 / std::pow(std::cosh(x), 2),
              round_off);
}

// Terms and factors of a result have the same order in all processes: GiNaC
// orders them by addresses in memory, and sums in another order differ in the
// last digits.
TEST(Differentiation, OneOrderInAllProcesses)
{
  EXPECT_EQ(differentiate("x^2*t + y*sin(x) - z/(1 + x)", {}, "Entry"),
            "(-1.0)*z/(1+x)+sin(x)*y+t*x*x");
  EXPECT_EQ(differentiate("1/(y + x^-3)^2 + x^0.5", {}, "Entry"),
            "1/pow(1.0/(x*x*x)+y,2.0)+sqrt(x)");
}

// A derivative is also right where a sum goes on with a negative number
// ("+-1.0").
TEST(Differentiation, NegativeNumbersInSums)
{
  const std::string text = differentiate("-x - x*y + cos(x)", {"x"}, "Entry");
  EXPECT_NE(text.find("+-1.0"), std::string::npos) << text;
  EXPECT_NEAR(derivative("-x - x*y + cos(x)", {"x"}),
              -1 - p[1] - std::sin(p[0]),
              round_off);
}

// GiNaC must read a formula as muParser does: with no variable, what comes back
// is the formula.
TEST(Differentiation, SameSyntax)
{
  const char *const functions =
    "log(y) + asin(x) + acos(y) + sinh(z) + cosh(z) + tan(x) + cos(t)";
  for (const std::string formula : {"-x^2",
                                    "2^x^y",
                                    "(1 + x)^(1/y)",
                                    "-2^2*x",
                                    "x - y - z",
                                    "x/y*z",
                                    "x/y/z",
                                    "2*-x",
                                    "1/3 + .5 + 1e2*x + 2.5e-1*y",
                                    "(x + y)^-1",
                                    functions,
                                    "pi*t"})
    EXPECT_NEAR(derivative(formula, {}), value(formula), round_off) << formula;
}

TEST(Differentiation, Refusals)
{
  EXPECT_NE(
    derivative_refusal("ramp(t, 0, 1)*x").find("cannot be differentiated"),
    std::string::npos);
  EXPECT_NE(derivative_refusal("abs(x)").find("it has the function 'abs'"),
            std::string::npos);
  EXPECT_NE(derivative_refusal("x*w").find(
              "allowed are +, -, *, /, ^, numbers"),
            std::string::npos);
  EXPECT_NE(
    derivative_refusal("x < 1 ? 0 : 1").find("cannot be differentiated"),
    std::string::npos);
  EXPECT_NE(derivative_refusal("").find("cannot be differentiated"),
            std::string::npos);
  EXPECT_NE(derivative_refusal("1/(x").find("cannot be differentiated"),
            std::string::npos);
}

// Numbers in powers are not multiplied out, however large they would become.
TEST(Differentiation, NumbersStayAsTheyAre)
{
  const double x = p[0];
  EXPECT_NEAR(derivative("x^2*1^9^9^9^9", {"x"}), 2 * x, round_off);
  EXPECT_NEAR(derivative("sin(9^9)*0*x + x^3", {"x"}), 3 * x * x, round_off);
  EXPECT_NEAR(derivative("pow(x, 1.5) + x^-2", {"x"}),
              1.5 * std::sqrt(x) - 2 / (x * x * x),
              100 * round_off);
  // The derivative is zero, and not "not a number", where the base is zero.
  EXPECT_EQ(Expression(differentiate("(x - x)^2 + pow(x - x, 2)", {"x"}, ""),
                       1,
                       "Entry")
              .value(p, t),
            0.);
}

// Powers with large exponents are not written as products of that many factors.
TEST(Differentiation, LargeExponents)
{
  const std::string derivative_text =
    differentiate("x^977777 + (x - x)^977777", {"x"}, "Entry");
  EXPECT_LT(derivative_text.size(), 200u) << derivative_text;
  // log1p(h) gives the logarithm of the base without the round-off of 1 + h.
  const double h        = 0x1p-20;
  const double expected = 977777 * std::exp(977776 * std::log1p(h));
  EXPECT_NEAR(Expression(derivative_text, 1, "Entry").value({1 + h, 0, 0}, 0.),
              expected,
              round_off * expected);
}

// Exponents that are constants are numbers, however they are written:
// derivatives of powers above one are zero where the base is.
TEST(Differentiation, PowersOfZero)
{
  for (const auto &[formula, exponent] :
       {std::pair("x^2", 2.),
        std::pair("x^(2)", 2.),
        std::pair("x^( 1 + 1 )", 2.),
        std::pair("x^(-1+3)", 2.),
        std::pair("x^(3/2)", 1.5),
        std::pair("x^1.50", 1.5),
        std::pair("pow(x, 3/2)", 1.5),
        std::pair("pow(x, (5 - 2)/(4*0.5))", 1.5)})
    {
      EXPECT_NEAR(derivative(formula, {"x"}),
                  exponent * std::pow(p[0], exponent - 1),
                  round_off)
        << formula;
      EXPECT_EQ(Expression(differentiate(formula, {"x"}, ""), 1, "Entry")
                  .value({0, 1, 1}, t, 0),
                0.)
        << formula;
    }
}

TEST(Differentiation, RefusesTooMuch)
{
  const auto nested = [](const std::string &start, const unsigned int n) {
    std::string result = "x";
    for (unsigned int i = 0; i < n; ++i)
      result = start + result + ")";
    return result;
  };
  EXPECT_NE(derivative_refusal(nested("(", 101)).find("parentheses more than "),
            std::string::npos);
  std::string powers = "x", product = "x";
  for (unsigned int i = 0; i < 101; ++i)
    powers += "^x";
  for (unsigned int i = 0; i < 500; ++i)
    product += "*sin(x + " + std::to_string(i) + ")";
  EXPECT_NE(derivative_refusal(powers).find("it has more than 100 powers"),
            std::string::npos);
  EXPECT_NE(derivative_refusal(product).find(
              "it or its derivative has more than 20000 parts"),
            std::string::npos);
  EXPECT_NE(derivative_refusal("x + 1e400").find("or is too large"),
            std::string::npos);
  EXPECT_NE(
    derivative_refusal("factorial(x)").find("it has the function 'factorial'"),
    std::string::npos);
}
