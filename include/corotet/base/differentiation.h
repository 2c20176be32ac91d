// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_differentiation_h
#define corotet_base_differentiation_h

#include <string>
#include <vector>

namespace corotet
{
  /// The functions that differentiate() knows.
  inline const std::vector<std::string> differentiable_functions = {"sin",
                                                                    "cos",
                                                                    "tan",
                                                                    "asin",
                                                                    "acos",
                                                                    "atan",
                                                                    "sinh",
                                                                    "cosh",
                                                                    "tanh",
                                                                    "exp",
                                                                    "log",
                                                                    "sqrt",
                                                                    "pow"};

  /**
   * The derivative of a formula in x, y, z, t and pi by each of @p variables,
   * one after another, as a formula that Expression reads: exact, by GiNaC
   * (https://www.ginac.de). Without variables the formula itself.
   *
   * Throws an InputError that blames @p entry if the formula has anything but
   * +, -, *, /, ^, parentheses, numbers and differentiable_functions.
   */
  std::string
  differentiate(const std::string              &formula,
                const std::vector<std::string> &variables,
                const std::string              &entry);
} // namespace corotet

#endif
