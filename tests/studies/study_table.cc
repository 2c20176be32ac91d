// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Tables of studies, from made-up results whose errors obey a power law
// exactly, so that orders are known.

#include <corotet/studies/study_table.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace corotet;

namespace
{
  StudyResult
  made_up(const unsigned int          degree,
          const unsigned int          refinements,
          const std::optional<double> time_step = {})
  {
    StudyResult result;
    result.study_case = {degree, refinements, time_step, {}, {}};
    result.cells      = 5 * std::pow(8, refinements);
    result.h          = std::pow(0.5, refinements);
    const double e    = std::pow(result.h, degree);
    if (time_step)
      {
        // A run of 1 s, in equal steps.
        result.steps          = std::ceil(1 / *time_step);
        result.mean_time_step = 1. / result.steps;
      }
    const double t =
      time_step ? result.mean_time_step * result.mean_time_step : 1.;
    result.errors =
      ErrorNorms{{e * result.h * t, e * t, 2 * e * t}, {1., 2., 3.}};
    result.quantities = {7. + e};
    return result;
  }

  // A result without quantities.
  StudyResult
  in_steps(const unsigned int refinements, const double time_step)
  {
    StudyResult result = made_up(2, refinements, time_step);
    result.quantities.clear();
    return result;
  }

  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace

TEST(StudyTable, Orders)
{
  const StudyTable table(
    {made_up(1, 0), made_up(1, 1), made_up(1, 3), made_up(2, 0), made_up(2, 1)},
    {{"tip_z", 7.}});
  const std::string csv = table.csv();
  EXPECT_TRUE(csv.starts_with("degree,refinements,status,cells,nodes,dofs,h,"
                              "L2_reference,H1_reference,energy_reference,"
                              "tip_z,L2_error,L2_order,H1_error,H1_order,"
                              "energy_error,energy_order,tip_z_error,"
                              "tip_z_order,steps,"));
  // The first row of each degree has no order; powers of two are exact.
  EXPECT_TRUE(
    contains(csv, "1,0,\"done\",5,0,0,1,1,2,3,8,1,nan,1,nan,2,nan,1,nan,"));
  EXPECT_TRUE(
    contains(csv, "1,1,\"done\",40,0,0,0.5,1,2,3,7.5,0.25,2,0.5,1,1,1,0.5,1,"));
  EXPECT_TRUE(contains(
    csv,
    "1,3,\"done\",2560,0,0,0.125,1,2,3,7.125,0.015625,2,0.125,1,0.25,1,0.125,1,"));
  EXPECT_TRUE(contains(csv, "2,0,\"done\",5,0,0,1,1,2,3,8,1,nan,"));
  EXPECT_TRUE(contains(csv, ",7.25,0.125,3,0.25,2,0.5,2,0.25,2,"));
}

// The error of a run that is compared with itself is round-off.
TEST(StudyTable, NoOrderOfRoundOff)
{
  StudyResult coarse = made_up(2, 0), fine = made_up(2, 1);
  for (StudyResult *const result : {&coarse, &fine})
    result->quantities.clear();
  fine.errors->error    = {1e-17, 1e-17, 1e-17};
  const std::string csv = StudyTable({coarse, fine}, {}).csv();
  EXPECT_TRUE(contains(csv, ",1e-17,nan,1e-17,nan,1e-17,nan,")) << csv;
}

TEST(StudyTable, OrdersInTime)
{
  const StudyTable table(
    {in_steps(0, 0.5), in_steps(1, 0.5), in_steps(0, 0.25)}, {});
  const std::string csv = table.csv();
  EXPECT_TRUE(contains(csv, "L2_error,L2_order,L2_order_in_time"));
  // An order is known where only the cells, or only the steps, differ: 2 in
  // space for degree 2 (in H1, 3 in L2), and 2 in time.
  EXPECT_TRUE(
    contains(csv, "2,1,0.5,0.5,\"done\",40,0,0,0.5,1,2,3,0.03125,3,nan,"));
  EXPECT_TRUE(
    contains(csv, "2,0,0.25,0.25,\"done\",5,0,0,1,1,2,3,0.0625,nan,2,"));
  EXPECT_FALSE(contains(table.lines()[0], "mean step"));
}

// Orders in time use the actual steps, which are shortened so that they divide
// the time; two runs with equally many steps have no order.
TEST(StudyTable, OrdersInTimeOfStepsThatWereMade)
{
  const StudyTable table({in_steps(0, 0.6), in_steps(0, 0.5), in_steps(0, 0.3)},
                         {});
  const std::string csv = table.csv();
  EXPECT_TRUE(
    contains(csv, "2,0,0.6,0.5,\"done\",5,0,0,1,1,2,3,0.25,nan,nan,"));
  EXPECT_TRUE(
    contains(csv, "2,0,0.5,0.5,\"done\",5,0,0,1,1,2,3,0.25,nan,nan,"));
  EXPECT_TRUE(
    contains(csv, "2,0,0.3,0.25,\"done\",5,0,0,1,1,2,3,0.0625,nan,2,"));
  EXPECT_TRUE(contains(table.lines()[0], "mean step"));
}

// An error that does not decrease, and errors that are too small to tell.
TEST(StudyTable, ErrorsThatDoNotConverge)
{
  const auto rows = [](const double first, const double second) {
    std::vector<StudyResult> results{made_up(2, 0), made_up(2, 1)};
    results[0].errors->error.H1 = first;
    results[1].errors->error.H1 = second;
    return results;
  };
  const StudyTable good({made_up(2, 0), made_up(2, 1)}, {{"tip_z", 7.}});
  EXPECT_TRUE(good.not_converging().empty());
  const std::string expected =
    "the error 'H1' does not become small with finer "
    "cells: its last order is 0.32 with degree 2";
  EXPECT_EQ(StudyTable(rows(0.1, 0.08), {}).not_converging(),
            std::vector<std::string>({expected}));
  EXPECT_TRUE(StudyTable(rows(1e-7, 1e-7), {}).not_converging().empty());
  // Errors before the last two cell sizes do not matter.
  std::vector<StudyResult> three = rows(0.1, 0.1);
  three.push_back(made_up(2, 2));
  EXPECT_TRUE(StudyTable(three, {}).not_converging().empty());
}

TEST(StudyTable, Texts)
{
  StudyResult failed = made_up(1, 1);
  failed.status      = "failed";
  failed.errors      = {};
  failed.quantities  = {std::nan("")};
  const StudyTable table({made_up(1, 0), failed}, {{"tip_z", {}}});
  EXPECT_EQ(table.lines().size(), 3);
  for (const std::string &line : table.lines())
    EXPECT_EQ(line.size(), table.lines()[0].size());
  EXPECT_TRUE(contains(table.lines()[2], "failed"));
  const std::string latex = table.latex();
  EXPECT_TRUE(latex.starts_with("\\begin{tabular}{"));
  EXPECT_TRUE(contains(latex, "tip\\_z"));
  EXPECT_TRUE(contains(latex, "\\bottomrule"));
}

// All kept data of a run are restored, also values that are not numbers.
TEST(StudyTable, KeptResult)
{
  StudyResult result       = made_up(3, 2);
  result.quantities        = {0.1, std::nan("")};
  result.wall_times        = {1, 2, 3, 4};
  result.linear_iterations = 17;
  result.mean_time_step    = 0.25;
  result.worth_a_look      = "2 warnings";
  const StudyResult again  = result_from_json(result.study_case,
                                             nlohmann::ordered_json::parse(
                                               result_to_json(result).dump()));
  EXPECT_EQ(result_to_json(again), result_to_json(result));
  EXPECT_EQ(again.quantities[0], 0.1);
  EXPECT_TRUE(std::isnan(again.quantities[1]));
  EXPECT_EQ(again.errors->error.H1, result.errors->error.H1);
  EXPECT_EQ(again.study_case, result.study_case);
  EXPECT_EQ(again.mean_time_step, 0.25);
  EXPECT_EQ(again.worth_a_look, "2 warnings");
}
