// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/formula_functions.h>

#include <deal.II/base/numbers.h>

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace corotet
{
  namespace
  {
    // Whether t has reached t0, up to round-off of both: a step that ends at t0
    // is to see the values after it, as derivatives do (JetFormula).
    bool
    has_come(const double t, const double t0)
    {
      constexpr double round_off = 16 * std::numeric_limits<double>::epsilon();
      return t >= t0 - round_off * std::abs(t0);
    }

    double
    ramp(const double t, const double t0, const double t1)
    {
      if (!(t0 <= t1))
        return std::numeric_limits<double>::quiet_NaN();
      if (has_come(t, t1))
        return 1;
      // If t is not a number, neither is the result.
      return t <= t0 ? 0 : (t - t0) / (t1 - t0);
    }

    double
    smooth_step(const double t, const double t0, const double t1)
    {
      const double s = ramp(t, t0, t1);
      return s * s * s * (10 + s * (6 * s - 15));
    }

    double
    pulse(const double t, const double t0, const double t1)
    {
      const double s = ramp(t, t0, t1);
      if (std::isnan(s))
        return s;
      return has_come(t, t0) && !has_come(t, t1) ? 1 : 0;
    }

    double
    half_sine(const double t, const double t0, const double t1)
    {
      // At s = 1 the sine of the rounded pi would not be exactly zero.
      const double s = ramp(t, t0, t1);
      return s == 1 ? 0 : std::sin(dealii::numbers::PI * s);
    }

    double
    triangle(const double t, const double t0, const double t1)
    {
      return 1 - std::abs(2 * ramp(t, t0, t1) - 1);
    }

    // Conditions are rounded, since muParser's own comparisons give exactly 0
    // or 1.
    bool
    is_true(const double condition)
    {
      return std::abs(condition) >= 0.5;
    }

    using Unary  = double (*)(double);
    using Binary = double (*)(double, double);

    void
    define_general_functions(mu::Parser &parser)
    {
      const std::map<std::string, Unary> unary_functions = {
        {"int", [](const double a) { return std::round(a); }},
        {"ceil", [](const double a) { return std::ceil(a); }},
        {"floor", [](const double a) { return std::floor(a); }},
        {"cot", [](const double a) { return 1 / std::tan(a); }},
        {"csc", [](const double a) { return 1 / std::sin(a); }},
        {"sec", [](const double a) { return 1 / std::cos(a); }},
        {"log", [](const double a) { return std::log(a); }},
        {"erf", [](const double a) { return std::erf(a); }},
        {"erfc", [](const double a) { return std::erfc(a); }}};
      for (const auto &[name, function] : unary_functions)
        parser.DefineFun(name, function);
      parser.DefineFun("pow", static_cast<Binary>(std::pow));
      parser.DefineFun(
        "if",
        +[](const double condition, const double a, const double b) -> double {
          return is_true(condition) ? a : b;
        });
      parser.DefineOprt(
        "|",
        [](const double a, const double b) -> double {
          return is_true(a) || is_true(b);
        },
        mu::prLOR);
      parser.DefineOprt(
        "&",
        [](const double a, const double b) -> double {
          return is_true(a) && is_true(b);
        },
        mu::prLAND);
    }
  } // namespace

  std::string
  with_blanks_as_wanted(const std::string &formula)
  {
    std::string result;
    for (const char c : formula)
      {
        if (c == '(')
          result.erase(result.find_last_not_of(" \t") + 1);
        if (result.ends_with("||") || result.ends_with("&&"))
          result += ' ';
        result += c;
      }
    return result;
  }



  void
  define_functions(mu::Parser &parser)
  {
    parser.DefineConst("pi", dealii::numbers::PI);
    define_general_functions(parser);
    parser.DefineFun("ramp", ramp);
    parser.DefineFun("smooth_step", smooth_step);
    parser.DefineFun("pulse", pulse);
    parser.DefineFun("half_sine", half_sine);
    parser.DefineFun("triangle", triangle);
  }

  const std::map<std::string, double> &
  formula_constants()
  {
    static const std::map<std::string, double> constants = [] {
      mu::Parser parser;
      define_functions(parser);
      return parser.GetConst();
    }();
    return constants;
  }

  bool
  is_formula_name(const std::string &name)
  {
    mu::Parser parser;
    define_functions(parser);
    return parser.GetFunDef().contains(name) ||
           parser.GetConst().contains(name) ||
           std::find(formula_variables.begin(),
                     formula_variables.end(),
                     name) != formula_variables.end() ||
           std::find(random_functions.begin(), random_functions.end(), name) !=
             random_functions.end();
  }

  int
  depth_of_parentheses(const std::string &formula)
  {
    int depth = 0, deepest = 0;
    for (const char c : formula)
      {
        if (c == '(')
          ++depth;
        else if (c == ')')
          --depth;
        deepest = std::max(deepest, depth);
      }
    return deepest;
  }
} // namespace corotet
