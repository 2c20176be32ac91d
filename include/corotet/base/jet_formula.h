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
    /// Of formulas with what has no rule of differentiation, values are not
    /// numbers.
    JetFormula(const std::string &text, const TableFunctions &tables);

    /// At x, y, z and t, which @p variables gives. Not by several threads at
    /// once.
    Jet
    value(const std::array<double, 4> &variables) const;

  private:
    class Compiler;

    /// Takes arguments from the top of the stack and puts its value there: a
    /// function, else a table, else variable number @p variable, else @p
    /// constant.
    struct Instruction
    {
      JetFunction          function    = nullptr;
      unsigned int         n_arguments = 0;
      const TableFunction *table       = nullptr;
      int                  variable    = -1;
      double               constant    = 0;
    };

    /// What the instructions point to.
    TableFunctions           tables;
    std::vector<Instruction> instructions;
    /// As large as it gets.
    mutable std::vector<Jet> stack;
  };
} // namespace corotet

#endif
