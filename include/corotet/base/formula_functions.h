// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_formula_functions_h
#define corotet_base_formula_functions_h

#include <map>
#include <string>
#include <vector>

namespace mu
{
  class Parser;
}

namespace corotet
{
  /// The variables of formulas: coordinates at rest [m] and time [s].
  inline const std::vector<std::string> formula_variables = {"x",
                                                             "y",
                                                             "z",
                                                             "t"};

  /// The functions of time that formulas have besides those of muParser.
  inline const std::vector<std::string> functions_of_time = {"ramp",
                                                             "smooth_step",
                                                             "pulse",
                                                             "half_sine",
                                                             "triangle"};

  /// Functions that other programs have and formulas must not have: their
  /// values depend on the order of evaluation, so on the number of ranks.
  inline const std::vector<std::string> random_functions = {"rand",
                                                            "rand_seed"};

  /**
   * Adds the constant pi and the functions that formulas have to those of
   * muParser.
   *
   * Functions of time. They need t0 <= t1; otherwise their value is not a
   * number:
   * - ramp(t, t0, t1): 0 until t0, linear, 1 from t1 on.
   * - smooth_step(t, t0, t1): the same by s^3 (10 - 15 s + 6 s^2), twice
   *   continuously differentiable.
   * - pulse(t, t0, t1): 1 in [t0, t1), 0 elsewhere.
   * - half_sine(t, t0, t1): sin(pi s) in between, 0 elsewhere.
   * - triangle(t, t0, t1): from 0 to 1 in the middle to 0, 0 elsewhere.
   *
   * Here s = (t - t0) / (t1 - t0). For t0 = t1 the first two are a step at t0,
   * and the others zero.
   *
   * Further if(condition, a, b), pow, erf, erfc, int (nearest whole number),
   * ceil, floor, cot, csc, sec, log (natural), the operators | and &.
   */
  void
  define_functions(mu::Parser &parser);

  /// A formula as muParser wants it: the parenthesis right after the name of a
  /// function, and a blank behind "||" and "&&", which it takes for the
  /// operators "|" and "&" before a letter.
  std::string
  with_blanks_as_wanted(const std::string &formula);

  /// The constants that formulas have, muParser's among them.
  const std::map<std::string, double> &
  formula_constants();

  /// Whether formulas have, or refuse, a variable, constant or function of this
  /// name.
  bool
  is_formula_name(const std::string &name);

  /// The largest depth of parentheses in a formula: recursive readers must not
  /// run out of stack.
  constexpr int max_parentheses = 100;

  /// The depth of parentheses in a formula.
  int
  depth_of_parentheses(const std::string &formula);
} // namespace corotet

#endif
