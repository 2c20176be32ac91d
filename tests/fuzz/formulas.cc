// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Formulas, tables and lists in entries of parameter files.

#include <corotet/base/differentiation.h>
#include <corotet/base/expression.h>
#include <corotet/base/named_values.h>
#include <corotet/base/table_file.h>
#include <corotet/base/text.h>
#include <corotet/output/output_parameters.h>
#include <corotet/studies/check.h>
#include <corotet/studies/study_parameters.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "targets.h"

namespace fuzz
{
  namespace
  {
    using corotet::Expression;

    // Whether both numbers are equal or neither is a number.
    bool
    are_equal(const double a, const double b)
    {
      return a == b || (std::isnan(a) && std::isnan(b));
    }

    // Checks that an expression depends on what it says, and on nothing else.
    void
    check_values(const Expression &expression, const unsigned int component)
    {
      const dealii::Point<3> p(0.3, -0.7, 1.1), q(-2.9, 0.1, 5.3);
      const double           here = expression.value(p, 0.6, component);
      require(are_equal(here, expression.value(p, 0.6, component)),
              "a formula has one value at one place");
      if (!expression.depends_on_space())
        require(are_equal(here, expression.value(q, 0.6, component)),
                "a formula without coordinates is the same everywhere");
      if (!expression.depends_on_time())
        require(are_equal(here, expression.value(p, 7.1, component)),
                "a formula without t is the same always");
      if (expression.is_zero())
        require(here == 0, "a formula that is zero has the value 0");
      for (const double t : {-1., 0., 0.6, 1e300})
        expression.time_derivatives(p, t, 1e-3, component);
    }

    // Checks that a table's values between two rows lie between those of the
    // rows.
    void
    check_between(const corotet::TableFunction &function,
                  const corotet::TableRows     &rows,
                  const std::size_t             i)
    {
      const double a = rows.arguments[i], b = rows.arguments[i + 1];
      const double f = rows.values[i], g = rows.values[i + 1];
      for (const double s : {0.25, 0.5, 0.875})
        {
          const double value = function.value(a + s * (b - a));
          require(value >= std::min(f, g) && value <= std::max(f, g),
                  "a table's values are between those of its rows");
        }
      require(function.value(a) == f, "a table has the values of its rows");
    }
  } // namespace

  void
  read_expression(const std::string &input)
  {
    static const corotet::TableFunctions tables{
      {"table",
       std::make_shared<const corotet::TableFunction>(
         std::vector<double>{0, 1, 2},
         std::vector<double>{0, 1, 0},
         corotet::TableFunction::Interpolation::cubic)}};
    const std::vector<std::string> components =
      corotet::split_outside_brackets(input, ';');
    if (components.size() > 6)
      return;
    if (!is_accepted([&] {
          const Expression expression(input,
                                      components.size(),
                                      "Entry",
                                      tables);
          for (unsigned int c = 0; c < expression.n_components(); ++c)
            check_values(expression, c);
        }))
      return;
    for (const std::string &component : components)
      for (const std::vector<std::string> &variables :
           {std::vector<std::string>{"x"}, std::vector<std::string>{"t", "t"}})
        is_accepted([&] {
          const Expression derivative(
            corotet::differentiate(component, variables, "Entry"), 1, "Entry");
          check_values(derivative, 0);
        });
  }

  void
  read_table(const std::string &input)
  {
    using Interpolation     = corotet::TableFunction::Interpolation;
    const std::string  path = write("table.csv", input);
    corotet::TableRows rows;
    if (!is_accepted([&] { rows = corotet::read_table_file(path); }))
      return;
    require(rows.arguments.size() == rows.values.size() &&
              rows.arguments.size() >= 2 &&
              std::adjacent_find(rows.arguments.begin(),
                                 rows.arguments.end(),
                                 std::greater_equal<>()) ==
                rows.arguments.end(),
            "a table has two rows or more, whose arguments increase");
    for (const auto interpolation :
         {Interpolation::linear, Interpolation::cubic})
      {
        const corotet::TableFunction function(rows.arguments,
                                              rows.values,
                                              interpolation);
        for (std::size_t i = 0; i + 1 < rows.arguments.size(); ++i)
          check_between(function, rows, i);
      }
  }

  void
  read_list(const std::string &input)
  {
    corotet::point_of(input);
    corotet::names_and_values(input);
    is_accepted([&] { corotet::named_values(input, "Entry"); });

    corotet::OutputParameters output;
    output.probes = output.stress_probes = input;
    is_accepted([&] { output.probe_points(); });
    is_accepted([&] { output.stress_probe_points(); });
    corotet::StudyParameters study;
    study.quantities = input;
    is_accepted([&] { study.quantity_list(); });

    const corotet::ResultTable table{{"time", "tip_x", "tip_y"},
                                     {{0, 1, 2}, {0.5, -1, 1e300}}};
    for (const std::string &text : corotet::split_outside_brackets(input, ';'))
      is_accepted([&] { corotet::Check(text, table.columns).evaluate(table); });
  }
} // namespace fuzz
