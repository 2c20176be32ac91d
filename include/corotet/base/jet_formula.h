// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_jet_formula_h
#define corotet_base_jet_formula_h

#include <corotet/base/jet.h>
#include <corotet/base/table_functions.h>

#include <array>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * A formula whose derivatives in time are computed with its value. It reads
   * what Expression reads, with the same meaning, from text that Expression has
   * accepted.
   */
  class JetFormula
  {
  public:
    /// If @p text has something without a rule of differentiation, value() is
    /// not a number.
    JetFormula(const std::string &text, const TableFunctions &tables);

    /// The value and derivatives at x, y, z and t, given by @p variables. Must
    /// not be called by several threads at once.
    Jet
    value(const std::array<double, 4> &variables) const;

  private:
    class Compiler;

    /// Takes its arguments from the top of the stack and puts its value there:
    /// the value of the function if there is one, else of the table, else of
    /// variable number @p variable, else @p constant.
    struct Instruction
    {
      JetFunction          function    = nullptr;
      unsigned int         n_arguments = 0;
      const TableFunction *table       = nullptr;
      int                  variable    = -1;
      double               constant    = 0;
    };

    /// The tables that the instructions point to.
    TableFunctions           tables;
    std::vector<Instruction> instructions;
    /// The stack of value(), of the largest size needed.
    mutable std::vector<Jet> stack;
  };
} // namespace corotet

#endif
