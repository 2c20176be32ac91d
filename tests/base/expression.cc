// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Expressions of x, y, z, t. Values are compared with the same formula in C++;
// refusals with the message a user gets.

#include <corotet/base/exceptions.h>
#include <corotet/base/expression.h>
#include <corotet/base/not_finite.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace corotet;

namespace
{
  std::string
  expression_refusal(const std::string &text, const unsigned int n_components)
  {
    testing::internal::CaptureStderr();
    std::string message = "accepted";
    try
      {
        const Expression expression(text, n_components, "Loads/Gravity");
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(error.entry, "Loads/Gravity");
        message = error.what();
      }
    // muParser must not write to the terminal.
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message;
  }
} // namespace

// muParser alone reads "||y" as "|" followed by something else.
TEST(Expression, AndOrBesideNames)
{
  const dealii::Point<3> p(1, 2, 3);
  for (const std::string text : {"x>5||y>1",
                                 "x > 5 || y > 1",
                                 "x>0&&y>1",
                                 "(x>5)||y>1",
                                 "pulse(t,0,1)||pulse(t,2,3)",
                                 "x>0&&t<1||z>5",
                                 "x>5|y>1",
                                 "x>0&y>1"})
    EXPECT_EQ(Expression(text, 1, "").value(p, 0.5), 1) << text;
  EXPECT_EQ(Expression("x>5||y>2", 1, "").value(p, 0.5), 0);
  EXPECT_EQ(Expression("x>0&&y>2", 1, "").value(p, 0.5), 0);
}

TEST(Expression, EvaluatesAllComponents)
{
  const Expression       e("x * sin(y); if(t > 1, z^2, -z); 2e1 + pi", 3, "");
  const dealii::Point<3> p(0.5, 1.5, -2);
  // The test does the same operations in the same order, so values are equal to
  // the round-off of one or two operations.
  EXPECT_DOUBLE_EQ(e.value(p, 2, 0), 0.5 * std::sin(1.5));
  EXPECT_DOUBLE_EQ(e.value(p, 2, 1), 4);
  EXPECT_DOUBLE_EQ(e.value(p, 0.5, 1), 2);
  const dealii::Tensor<1, 3> v = e.vector_value(p, 2);
  EXPECT_DOUBLE_EQ(v[0], 0.5 * std::sin(1.5));
  EXPECT_DOUBLE_EQ(v[1], 4);
  EXPECT_DOUBLE_EQ(v[2], 20 + dealii::numbers::PI);
  EXPECT_EQ(e.n_components(), 3);
}

TEST(Expression, KnowsWhatItDependsOn)
{
  const auto check = [](const std::string &text,
                        const bool         space,
                        const bool         time,
                        const bool         zero) {
    const Expression e(text, 1, "");
    EXPECT_EQ(e.depends_on_space(), space) << text;
    EXPECT_EQ(e.depends_on_time(), time) << text;
    EXPECT_EQ(e.is_zero(), zero) << text;
  };
  check("0", false, false, true);
  check("-0.0", false, false, true);
  check("1 - 1", false, false, true);
  check("1e5", false, false, false);
  check("3 * y", true, false, false);
  // tan and exp depend on nothing: their letters t and x are no variables.
  check("tan(1) + exp(1)", false, false, false);
  check("sin(2*pi*t)", false, true, false);
  // The product is zero at the origin, but not everywhere.
  check("x * t", true, true, false);
}

TEST(Expression, IsZeroOnlyIfAllComponentsAre)
{
  EXPECT_TRUE(Expression("0; 0; 0", 3, "").is_zero());
  EXPECT_FALSE(Expression("0; 0; 1", 3, "").is_zero());
}

TEST(Expression, CopiesStayValid)
{
  std::vector<Expression> list;
  {
    const Expression e("x + t", 1, "");
    list.push_back(e);
  }
  EXPECT_EQ(list.front().value(dealii::Point<3>(1, 0, 0), 2), 3);
}

TEST(Expression, NonFiniteValuesAreTheCallersMatter)
{
  const Expression e("1/x", 1, "");
  EXPECT_EQ(e.value(dealii::Point<3>(), 0),
            std::numeric_limits<double>::infinity());
}

TEST(Expression, RefusesWrongNumberOfComponents)
{
  EXPECT_EQ(expression_refusal("0; 1", 3),
            "the expression \"0; 1\" has 2 components; 3 are needed, separated "
            "by semicolons");
  EXPECT_EQ(expression_refusal("0", 3),
            "the expression \"0\" has 1 component; 3 are needed, separated by "
            "semicolons");
  EXPECT_EQ(expression_refusal("0;1", 1),
            "the expression \"0;1\" has 2 components; 1 is needed, separated "
            "by semicolons");
}

TEST(Expression, RefusesWhatIsNoFormula)
{
  EXPECT_EQ(expression_refusal("0; ; 1", 3),
            "the expression \"\" is no formula: it is empty; a formula is "
            "needed, for example 0");
  // The reason is muParser's, whose words differ between versions.
  for (const std::string text : {"(1 + x", "1 +", "sin()", "x y", "\"x\""})
    {
      const std::string message = expression_refusal(text, 1);
      const std::string start =
        "the expression \"" + text + "\" is no formula: ";
      EXPECT_EQ(message.rfind(start, 0), 0) << message;
      EXPECT_GT(message.size(), start.size() + 10) << message;
    }
}

// muParser would evaluate these to something: the value of the last of a list,
// or of an assignment.
TEST(Expression, RefusesWhatMuParserWouldMisunderstand)
{
  EXPECT_EQ(expression_refusal("1, 2", 1),
            "the expression \"1, 2\" is no formula: it has a comma outside of "
            "parentheses; components are separated by semicolons");
  EXPECT_EQ(expression_refusal("x = 3", 1),
            "the expression \"x = 3\" is no formula: it assigns by =; "
            "comparisons are ==, !=, <, <=, > and >=");
  EXPECT_EQ(expression_refusal("if(x <= 3 && x == 1 || x != 2, 1, 0)", 1),
            "accepted");
}

// Random numbers would differ with the number of ranks, and from one evaluation
// to the next.
TEST(Expression, RefusesRandomNumbers)
{
  for (const std::string name : {"rand", "rand_seed"})
    {
      const std::string formula =
        "1 + " + name + (name == "rand" ? "()" : "(3)");
      EXPECT_EQ(expression_refusal(formula, 1),
                "the expression \"" + formula +
                  "\" is no formula: it has the function \"" + name +
                  "\", whose values would depend on how often and on which "
                  "rank they are asked for; allowed is what depends on x, y, z "
                  "and t alone, such as a table of random numbers, or "
                  "acos(cos(1e4*sin(13*x + 78*y + 38*z)))/pi");
    }
}

TEST(Expression, RefusesUnknownNames)
{
  EXPECT_EQ(expression_refusal("2 * u", 1),
            "the expression \"2 * u\" is no formula: it has the unknown name "
            "\"u\"; known are x, y, z, t, pi, ramp, smooth_step, pulse, "
            "half_sine, triangle and muParser's functions");
  EXPECT_EQ(expression_refusal("sine(x)", 1),
            "the expression \"sine(x)\" is no formula: it has the unknown name "
            "\"sine\" (did you mean \"sin\"?); known are x, y, z, t, pi, ramp, "
            "smooth_step, pulse, half_sine, triangle and muParser's "
            "functions");
}

// The first value that is not finite is reported, and only once. Derivatives
// report none, as their differences may leave the domain of the formula.
TEST(Expression, NotesValuesThatAreNotFinite)
{
  take_not_finite(MPI_COMM_WORLD);
  const Expression formula("1/x; log(y)", 2, "Section/Entry");
  EXPECT_EQ(formula.value({0.5, 1., 0.}, 0, 0), 2);
  EXPECT_FALSE(take_not_finite(MPI_COMM_WORLD));
  formula.value({0., 1., 2.}, 3, 0);
  formula.value({0., -1., 2.}, 4, 1);
  const auto found = take_not_finite(MPI_COMM_WORLD);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->entry, "Section/Entry");
  EXPECT_EQ(found->message,
            "the expression \"1/x\" is not finite: found infinity at (0, 1, 2) "
            "at t = 3; allowed are finite values");
  EXPECT_FALSE(take_not_finite(MPI_COMM_WORLD));
  const Expression root("sqrt(t)", 1, "Section/Entry");
  root.time_derivatives({}, 0, 0.1);
  EXPECT_FALSE(take_not_finite(MPI_COMM_WORLD));
}

// A zero formula is recognised however it is written; what is no formula, or
// may have any value, is not zero.
TEST(Expression, ZeroTexts)
{
  take_not_finite(MPI_COMM_WORLD);
  for (const std::string text : {"0; 0; 0", " 0;0.0 ;-0", "1-1; 0; 0*pi"})
    EXPECT_TRUE(is_zero_expression(text, 3)) << text;
  for (const std::string text :
       {"0; 0; 1", "0; 0; t", "0; 0", "", "0; 0; f(t)", "0; 0; 1/0"})
    EXPECT_FALSE(is_zero_expression(text, 3)) << text;
  // is_zero_expression() computes no values of these, so none is noted.
  EXPECT_FALSE(take_not_finite(MPI_COMM_WORLD));
}

// The parser of formulas calls itself for each level of parentheses.
TEST(Expression, RefusesDeepParentheses)
{
  const auto nested = [](const unsigned int n) {
    return std::string(n, '(') + "x" + std::string(n, ')');
  };
  EXPECT_EQ(expression_refusal(nested(100), 1), "accepted");
  EXPECT_EQ(
    expression_refusal(nested(101), 1),
    "the expression \"" + nested(101).substr(0, 80) +
      "... (203 characters)\" is no formula: found parentheses 101 deep "
      "in each other; allowed are 100");
  // Powers nest deeply without parentheses: their derivatives are differences.
  std::string powers = "t*1";
  for (unsigned int i = 0; i < 2000; ++i)
    powers += "^1";
  const Expression expression(powers, 1, "Entry");
  EXPECT_NEAR(expression.time_derivatives({}, 0.5, 1e-3)[0], 1, 1e-11);
}
