// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Checks of a table whose statistics are known: computed values, passed checks
// and refusals.

#include <corotet/base/exceptions.h>
#include <corotet/studies/check.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "temporary_folder.h"

using namespace corotet;

namespace
{
  const std::vector<std::string> columns = {"step", "tip_x", "broken"};

  const double not_a_number = std::numeric_limits<double>::quiet_NaN();

  const ResultTable table = {columns,
                             {{0, 1, 1}, {1, -3, not_a_number}, {2, 8, 1}}};

  CheckResult
  result(const std::string &text)
  {
    return Check(text, columns).evaluate(table);
  }

  std::string
  check_refusal(const std::string &text)
  {
    try
      {
        Check(text, columns);
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(error.entry, "Verification/Checks");
        return error.what();
      }
    return "accepted";
  }
} // namespace

TEST(Check, Statistics)
{
  EXPECT_EQ(result("a: first tip_x < 0").computed, 1);
  EXPECT_EQ(result("a: last tip_x < 0").computed, 8);
  EXPECT_EQ(result("a: min tip_x < 0").computed, -3);
  EXPECT_EQ(result("a: max tip_x < 0").computed, 8);
  EXPECT_EQ(result("a: mean tip_x < 0").computed, 2);
  EXPECT_EQ(result("a: range tip_x < 0").computed, 11);
  EXPECT_EQ(result("a: max abs(tip_x) + step^2 < 0").computed, 12);
}

TEST(Check, Conditions)
{
  EXPECT_EQ(result("a: max tip_x where step < 2 = 1 +- 1").computed, 1);
  EXPECT_EQ(result("a: last tip_x where step == 1 > 3").computed, -3);
  EXPECT_EQ(result("a: mean tip_x where tip_x > 0 & step >= 0 < 3").computed,
            4.5);
}

// Operators and blanks are allowed as in all formulas.
TEST(Check, OperatorsAndBlanks)
{
  EXPECT_EQ(result("a: mean tip_x where tip_x>0&&step>=0 < 3").computed, 4.5);
  EXPECT_EQ(result("a: max tip_x where step==0||step==1 < 3").computed, 1);
  EXPECT_EQ(result("a: max abs (tip_x) < 9").computed, 8);
}

TEST(Check, Tolerances)
{
  // 0.5 is exact, so a value at the bound passes.
  EXPECT_TRUE(result("a: last tip_x = 7.5 +- 0.5").passed);
  EXPECT_FALSE(result("a: last tip_x = 7.5 +- 0.499").passed);
  EXPECT_TRUE(result("a: min tip_x = -2.5 +- 0.5").passed);
  EXPECT_FALSE(result("a: min tip_x = -2.5 +- 0.499").passed);
  const CheckResult relative = result("a: min tip_x = -2.5 +- 20 %");
  EXPECT_TRUE(relative.passed);
  EXPECT_TRUE(relative.relative);
  EXPECT_DOUBLE_EQ(relative.error, -20);
  EXPECT_EQ(relative.tolerance, "20 %");
  EXPECT_FALSE(result("a: min tip_x = -2.5 +- 19.9 %").passed);
  EXPECT_NEAR(result("a: last tip_x = 2.5 * pi +- 1e-3").reference,
              2.5 * M_PI,
              1e-15);
  EXPECT_TRUE(result("a: last tip_x > 7").passed);
  EXPECT_FALSE(result("a: last tip_x < 7").passed);
  EXPECT_EQ(result("a: last tip_x < 7").tolerance, "below");
}

// A check of a value that is not a number must fail.
TEST(Check, NotANumberFails)
{
  EXPECT_TRUE(result("a: last broken = 1 +- 1").passed);
  for (const std::string statistic : {"min", "max", "mean", "range"})
    for (const std::string expectation : {"= 1 +- 1", "< 9", "> -9"})
      EXPECT_FALSE(result("a: " + statistic + " broken " + expectation).passed)
        << statistic << " " << expectation;
  EXPECT_FALSE(result("a: last tip_x where step > 5 < 9").passed);
}

TEST(Check, Refusals)
{
  EXPECT_EQ(check_refusal("a: last tip_y > 1"),
            "the results have no column \"tip_y\"; did you mean \"tip_x\"?");
  EXPECT_EQ(
    check_refusal("a: last tip_x where lap == 1 > 1"),
    "the results have no column \"lap\"; they have step, tip_x, broken");
  EXPECT_EQ(
    check_refusal("a: least tip_x > 1"),
    "found 'least' as the statistic of check 'a'; allowed: first, last, "
    "min, max, mean, range");
  EXPECT_EQ(check_refusal("a: last tip_x"),
            "found 'a: last tip_x'; allowed: 'NAME: STATISTIC FORMULA where "
            "CONDITION = REFERENCE +- TOLERANCE', or < or > REFERENCE");
  EXPECT_EQ(
    check_refusal("a: last tip_x = 3"),
    "found '= 3' in check 'a'; allowed: '= REFERENCE +- TOLERANCE', or a "
    "bound without tolerance");
  EXPECT_EQ(check_refusal("a: last tip_x = 0 +- 1 %"),
            "found the tolerance '1 %' for 0 in check 'a'; allowed: a positive "
            "one, in % of what is not zero");
  EXPECT_EQ(check_refusal("a: last tip_x = 1 +- 0"),
            "found the tolerance '0' for 1 in check 'a'; allowed: a positive "
            "one, in % of what is not zero");
  EXPECT_EQ(check_refusal("a: last tip_x = t +- 1"),
            "'t' is not constant; allowed: numbers, pi and functions of them");
  EXPECT_EQ(check_refusal("a, b: last tip_x > 1"),
            "'a, b' cannot be a check's name; allowed: text without commas, "
            "quotes and bars");
  EXPECT_NE(check_refusal("a: last sin(tip_x > 1").find("is no formula"),
            std::string::npos);
}

TEST(ReadResultTable, ReadsWhatRunsWrite)
{
  const TemporaryFolder folder;
  const std::string     path =
    folder.write("table.csv", "step,tip_x\n0,1.5e-3\n1,nan\n");
  const ResultTable read = read_result_table(path);
  EXPECT_EQ(read.columns, (std::vector<std::string>{"step", "tip_x"}));
  ASSERT_EQ(read.rows.size(), 2);
  EXPECT_EQ(read.rows[0], (std::vector<double>{0, 1.5e-3}));
  EXPECT_TRUE(std::isnan(read.rows[1][1]));

  for (const std::string wrong : {"step,tip_x\n0\n", "step,tip_x\n0,zero\n"})
    EXPECT_THROW(read_result_table(folder.write("wrong.csv", wrong)),
                 MachineError);
  EXPECT_THROW(read_result_table(folder / "absent.csv"), MachineError);
}
