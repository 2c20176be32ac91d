// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/formula_functions.h>
#include <corotet/base/jet_formula.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

namespace corotet
{
  namespace
  {
    // Thrown if a formula has something without a rule of differentiation.
    struct NoRule
    {};

    Jet
    table_value(const TableFunction &table, const Jet &a, const double soon)
    {
      const std::vector<double> &rows = table.rows();
      const auto                 next =
        std::upper_bound(rows.begin(),
                         rows.end(),
                         a,
                         [&](const Jet &argument, const double row) {
                           return sign_soon(argument - Jet{row}, soon) < 0;
                         });
      if (next == rows.begin() || next == rows.end())
        return {table.value(a.value)};
      const auto [value, first, second] =
        table.derivatives(next - rows.begin() - 1, a.value);
      return chain({value, first, second}, a);
    }
  } // namespace

  // Recursive descent; instructions come out in the order of evaluation.
  class JetFormula::Compiler
  {
  public:
    Compiler(const std::string &text, const TableFunctions &tables)
      : text(text)
      , tables(tables)
    {
      conditional();
      skip_blanks();
      if (position != text.size())
        throw NoRule();
    }

    std::vector<Instruction> instructions;

  private:
    void
    skip_blanks()
    {
      while (position < text.size() &&
             std::isspace(static_cast<unsigned char>(text[position])) != 0)
        ++position;
    }

    bool
    take(const std::string &symbol)
    {
      skip_blanks();
      if (text.compare(position, symbol.size(), symbol) != 0)
        return false;
      position += symbol.size();
      return true;
    }

    void
    require(const std::string &symbol)
    {
      if (!take(symbol))
        throw NoRule();
    }

    void
    call(const std::string &function, const unsigned int n_arguments)
    {
      const auto found = jet_functions().find(function);
      if (found == jet_functions().end())
        throw NoRule();
      Instruction instruction;
      instruction.function    = found->second;
      instruction.n_arguments = n_arguments;
      instructions.push_back(instruction);
    }

    void
    push(const double constant)
    {
      Instruction instruction;
      instruction.constant = constant;
      instructions.push_back(instruction);
    }

    // Counts, while it lives, how deep rules of the grammar are nested.
    // Formulas that nest too deeply are differentiated by differences instead.
    class Nesting
    {
    public:
      explicit Nesting(unsigned int &depth)
        : depth(depth)
      {
        if (++depth > 1000)
          throw NoRule();
      }

      Nesting(const Nesting &) = delete;
      Nesting &
      operator=(const Nesting &) = delete;

      ~Nesting()
      {
        --depth;
      }

    private:
      unsigned int &depth;
    };

    void
    conditional()
    {
      const Nesting nesting(depth);
      binary(0);
      if (!take("?"))
        return;
      conditional();
      require(":");
      conditional();
      call("?:", 3);
    }

    // Parses operators of precedence @p level or higher; they associate to the
    // left.
    void
    binary(const unsigned int level)
    {
      // Of two operators that begin alike, the longer one comes first.
      static const std::vector<std::vector<std::string>> levels = {
        {"||", "|"},
        {"&&", "&"},
        {"<=", ">=", "==", "!=", "<", ">"},
        {"+", "-"},
        {"*", "/"}};
      if (level == levels.size())
        {
          signed_power();
          return;
        }
      binary(level + 1);
      for (;;)
        {
          const auto found =
            std::find_if(levels[level].begin(),
                         levels[level].end(),
                         [&](const std::string &name) { return take(name); });
          if (found == levels[level].end())
            return;
          binary(level + 1);
          call(*found, 2);
        }
    }

    // Parses signs and powers: -x^2 is -(x^2), 2^-x is 2^(-x), x^y^z is
    // x^(y^z).
    void
    signed_power()
    {
      const Nesting nesting(depth);
      if (take("-"))
        {
          signed_power();
          call("negate", 1);
          return;
        }
      if (take("+"))
        {
          signed_power();
          return;
        }
      operand();
      if (!take("^"))
        return;
      signed_power();
      call("^", 2);
    }

    void
    operand()
    {
      if (take("("))
        {
          conditional();
          require(")");
          return;
        }
      const char *begin  = text.data() + position;
      double      number = 0;
      const auto [end, error] =
        std::from_chars(begin, text.data() + text.size(), number);
      // Words like nan and inf are names, although from_chars() reads them.
      const bool is_word =
        position < text.size() &&
        std::isalpha(static_cast<unsigned char>(*begin)) != 0;
      if (error == std::errc() && !is_word)
        {
          position += end - begin;
          push(number);
          return;
        }
      named_operand();
    }

    void
    named_operand()
    {
      const std::size_t begin = position;
      while (position < text.size() &&
             (std::isalnum(static_cast<unsigned char>(text[position])) != 0 ||
              text[position] == '_'))
        ++position;
      const std::string name = text.substr(begin, position - begin);
      if (take("("))
        {
          unsigned int n = 0;
          do
            {
              conditional();
              ++n;
            }
          while (take(","));
          require(")");
          const auto table = tables.find(name);
          if (table == tables.end())
            {
              call(name, n);
              return;
            }
          Instruction instruction;
          instruction.table       = table->second.get();
          instruction.n_arguments = n;
          instructions.push_back(instruction);
          return;
        }
      const auto constant = formula_constants().find(name);
      if (constant != formula_constants().end())
        {
          push(constant->second);
          return;
        }
      const auto variable =
        std::find(formula_variables.begin(), formula_variables.end(), name);
      if (variable == formula_variables.end())
        throw NoRule();
      Instruction instruction;
      instruction.variable = variable - formula_variables.begin();
      instructions.push_back(instruction);
    }

    const std::string    &text;
    const TableFunctions &tables;
    std::size_t           position = 0;
    unsigned int          depth    = 0;
  };

  JetFormula::JetFormula(const std::string &text, const TableFunctions &tables)
    : tables(tables)
  {
    try
      {
        instructions = Compiler(text, this->tables).instructions;
      }
    catch (const NoRule &)
      {
        instructions.assign(1, Instruction());
        instructions[0].constant = std::numeric_limits<double>::quiet_NaN();
      }
    std::size_t size = 0, largest = 0;
    for (const Instruction &instruction : instructions)
      {
        size += 1;
        size -= instruction.n_arguments;
        largest = std::max(largest, size);
      }
    stack.resize(largest);
  }

  Jet
  JetFormula::value(const std::array<double, 4> &variables) const
  {
    // The tolerance for times: far more than the round-off of the times of
    // steps, far less than a step.
    const double soon =
      16 * std::numeric_limits<double>::epsilon() * std::abs(variables[3]);
    Jet *top = stack.data();
    for (const Instruction &instruction : instructions)
      {
        top -= instruction.n_arguments;
        if (instruction.function != nullptr)
          *top = instruction.function(top, instruction.n_arguments, soon);
        else if (instruction.table != nullptr)
          *top = table_value(*instruction.table, *top, soon);
        else if (instruction.variable >= 0)
          *top = {variables[instruction.variable],
                  instruction.variable == 3 ? 1. : 0.};
        else
          *top = {instruction.constant};
        ++top;
      }
    return stack.front();
  }
} // namespace corotet
