// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/differentiation.h>
#include <corotet/base/exceptions.h>
#include <corotet/base/formula_functions.h>
#include <corotet/base/text.h>

#include <fmt/format.h>
#include <ginac/ginac.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>
#include <stdexcept>

namespace corotet
{
  namespace
  {
    // Formulas and their derivatives have so many parts at most: the second
    // derivative may have as many as the square of the first one's number.
    constexpr std::size_t max_parts = 20000;

    // Derivatives nest deeper than formulas, and GiNaC's functions call
    // themselves.
    constexpr unsigned int max_powers = 100;



    GiNaC::symtab
    symbols()
    {
      // Of one name there must be one symbol, in all formulas.
      static const GiNaC::symtab table = [] {
        GiNaC::symtab result;
        for (const std::string &name : formula_variables)
          result[name] = GiNaC::symbol(name);
        result["pi"] = GiNaC::symbol("pi");
        return result;
      }();
      return table;
    }



    // The first function that GiNaC must not see, because it has it under
    // another name or not at all; empty if there is none.
    std::string
    foreign_function(const GiNaC::ex &formula)
    {
      for (auto part = formula.preorder_begin(); part != formula.preorder_end();
           ++part)
        if (GiNaC::is_a<GiNaC::function>(*part))
          {
            const std::string name =
              GiNaC::ex_to<GiNaC::function>(*part).get_name();
            bool known = false;
            for (const std::string &function : differentiable_functions)
              known = known || function == name;
            if (!known)
              return name;
          }
      return "";
    }



    void
    check_length(const GiNaC::ex &formula)
    {
      std::size_t n_parts = 0;
      for (auto part = formula.preorder_begin(); part != formula.preorder_end();
           ++part)
        if (++n_parts > max_parts)
          throw std::runtime_error(
            fmt::format("it or its derivative has more than {} parts",
                        max_parts));
    }



    /**
     * A formula as GiNaC is to read it: numbers are symbols, which are named
     * by their text. GiNaC computes with numbers at once and exactly, so
     * 9^9^9^9 would fill any machine. Only exponents of one or two digits are
     * left numbers, so that the derivative of x^2 is 2*x and not x^2*2/x.
     */
    class SymbolicFormula
    {
    public:
      explicit SymbolicFormula(const std::string &formula)
        : formula(formula)
        , table(symbols())
      {
        for (std::size_t i = 0; i < formula.size();)
          if (is_digit(formula[i]) || formula[i] == '.')
            i = add_number(i);
          else if (is_letter(formula[i]))
            i = add_name(i);
          else
            text += formula[i++];
      }

      GiNaC::ex
      read() const
      {
        GiNaC::parser parser(table, true);
        return parser(text);
      }

    private:
      static bool
      is_digit(const char c)
      {
        return std::isdigit(static_cast<unsigned char>(c)) != 0;
      }

      static bool
      is_letter(const char c)
      {
        return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
      }

      // Each returns where it ends.
      std::size_t
      add_name(const std::size_t begin)
      {
        std::size_t end = begin;
        while (end < formula.size() &&
               (is_letter(formula[end]) || is_digit(formula[end])))
          ++end;
        const std::string name = formula.substr(begin, end - begin);
        if (!table.contains(name) &&
            std::find(differentiable_functions.begin(),
                      differentiable_functions.end(),
                      name) == differentiable_functions.end())
          throw std::runtime_error("it has the " + kind_at(end) + " '" + name +
                                   "'");
        text += name;
        return end;
      }

      std::string
      kind_at(const std::size_t end) const
      {
        const std::size_t next = formula.find_first_not_of(" \t", end);
        return next != std::string::npos && formula[next] == '(' ? "function" :
                                                                   "name";
      }

      std::size_t
      add_number(const std::size_t begin)
      {
        double      value = 0;
        const char *first = formula.data() + begin;
        const auto  result =
          std::from_chars(first, formula.data() + formula.size(), value);
        if (result.ec != std::errc())
          throw std::runtime_error("it has a number that is none, or is too "
                                   "large or too small");
        const std::size_t end    = begin + (result.ptr - first);
        const std::string number = formula.substr(begin, end - begin);
        if (is_small_exponent(begin, end))
          text += number;
        else
          {
            const std::string name     = fmt::format("number_{}", table.size());
            const auto [place, is_new] = numbers.emplace(number, name);
            if (is_new)
              table[name] = GiNaC::symbol(number);
            text += place->second;
          }
        return end;
      }

      // Whether a number stands right behind ^ or ^-, or is the last argument
      // of pow, and nothing makes another number of it.
      bool
      is_small_exponent(const std::size_t begin, const std::size_t end) const
      {
        std::size_t before = text.find_last_not_of(" \t");
        if (before != std::string::npos && before > 0 && text[before] == '-')
          before = text.find_last_not_of(" \t", before - 1);
        if (before == std::string::npos || end - begin > 4 ||
            formula.find_first_of("eE", begin) < end)
          return false;
        const std::size_t next = formula.find_first_not_of(" \t", end);
        const char after = next == std::string::npos ? ' ' : formula[next];
        return (text[before] == '^' && after != '^') ||
               (text[before] == ',' && after == ')');
      }

      const std::string                 &formula;
      GiNaC::symtab                      table;
      std::map<std::string, std::string> numbers;
      std::string                        text;
    };



    // What GiNaC must not be asked to read, as it calls itself for each level.
    void
    check_depth(const std::string &formula)
    {
      if (depth_of_parentheses(formula) > max_parentheses)
        throw std::runtime_error(
          fmt::format("it has parentheses more than {} deep in each other",
                      max_parentheses));
      if (std::count(formula.begin(), formula.end(), '^') > max_powers)
        throw std::runtime_error(
          fmt::format("it has more than {} powers", max_powers));
      if (formula.size() > max_parts)
        throw std::runtime_error(
          fmt::format("it has more than {} characters", max_parts));
    }
  } // namespace



  std::string
  differentiate(const std::string              &formula,
                const std::vector<std::string> &variables,
                const std::string              &entry)
  {
    const auto refuse = [&](const std::string &reason) {
      throw InputError(
        entry,
        fmt::format("the expression \"{}\" cannot be differentiated: {}; "
                    "allowed are +, -, *, /, ^, numbers, x, y, z, t, pi and {}",
                    shortened(formula),
                    shortened(reason, 200),
                    join(differentiable_functions)));
    };
    try
      {
        check_depth(formula);
        GiNaC::ex         result  = SymbolicFormula(formula).read();
        const std::string foreign = foreign_function(result);
        if (!foreign.empty())
          refuse("it has the function '" + foreign + "'");
        check_length(result);
        const GiNaC::symtab table = symbols();
        for (const std::string &variable : variables)
          {
            result = result.diff(
              GiNaC::ex_to<GiNaC::symbol>(table.find(variable)->second));
            check_length(result);
          }
        std::ostringstream text;
        text << GiNaC::csrc_double << result;
        return text.str();
      }
    catch (const Error &)
      {
        throw;
      }
    catch (const std::exception &error)
      {
        refuse(error.what());
      }
    return "";
  }
} // namespace corotet
