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
#include <optional>
#include <stdexcept>

#include "canonical_text.h"

namespace corotet
{
  namespace
  {
    // The largest number of parts of a formula or a derivative: the second
    // derivative may have as many as the square of the number of the first one.
    constexpr std::size_t max_parts = 20000;

    // The largest number of powers in a formula: derivatives nest deeper than
    // formulas, and GiNaC's functions are recursive.
    constexpr unsigned int max_powers = 100;



    GiNaC::symtab
    symbols()
    {
      // Each name must have one and the same symbol in all formulas.
      static const GiNaC::symtab table = [] {
        GiNaC::symtab result;
        for (const std::string &name : formula_variables)
          result[name] = GiNaC::symbol(name);
        result["pi"] = GiNaC::symbol("pi");
        return result;
      }();
      return table;
    }



    // The first function that GiNaC must not see, because GiNaC has it under
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



    bool
    is_digit(const char c)
    {
      return std::isdigit(static_cast<unsigned char>(c)) != 0;
    }



    bool
    is_number(const GiNaC::ex &part)
    {
      if (!GiNaC::is_a<GiNaC::symbol>(part))
        return false;
      const std::string name = GiNaC::ex_to<GiNaC::symbol>(part).get_name();
      return is_digit(name[0]) || name[0] == '.';
    }



    // The value of @p part, if it is made of a few short numbers by +, - , *
    // and / alone: powers of numbers may be of any size.
    std::optional<GiNaC::ex>
    short_constant(const GiNaC::ex &part, unsigned int &n_left)
    {
      if (n_left == 0)
        return {};
      --n_left;
      if (GiNaC::is_a<GiNaC::numeric>(part))
        return part;
      if (is_number(part))
        {
          constexpr std::size_t most = 6;
          const std::string name = GiNaC::ex_to<GiNaC::symbol>(part).get_name();
          if (name.size() > most ||
              name.find_first_of("eE") != std::string::npos)
            return {};
          return GiNaC::numeric(name.c_str());
        }
      if (GiNaC::is_a<GiNaC::power>(part) && part.op(1).is_equal(-1))
        {
          const auto value = short_constant(part.op(0), n_left);
          if (!value || value->is_zero())
            return {};
          return 1 / *value;
        }
      const bool is_sum = GiNaC::is_a<GiNaC::add>(part);
      if (!is_sum && !GiNaC::is_a<GiNaC::mul>(part))
        return {};
      GiNaC::ex result = is_sum ? 0 : 1;
      for (std::size_t i = 0; i < part.nops(); ++i)
        if (const auto value = short_constant(part.op(i), n_left))
          result = is_sum ? result + *value : result * *value;
        else
          return {};
      return result;
    }



    // Replaces constant exponents by numbers: then the derivative of x^2 is 2*x
    // and not x^2*2/x, which does not exist at zero. GiNaC expands integer
    // powers to products with as many factors, so large exponents become
    // floating-point numbers.
    struct ExponentsAsNumbers : public GiNaC::map_function
    {
      GiNaC::ex
      operator()(const GiNaC::ex &formula) override
      {
        GiNaC::ex mapped = formula.map(*this);
        if (!GiNaC::is_a<GiNaC::power>(mapped))
          return mapped;
        unsigned int n_left   = 20;
        const auto   exponent = short_constant(mapped.op(1), n_left);
        if (!exponent)
          return mapped;
        constexpr int        most_factors = 100;
        const GiNaC::numeric number = GiNaC::ex_to<GiNaC::numeric>(*exponent);
        if (number.is_integer() && GiNaC::abs(number) > most_factors)
          return GiNaC::pow(mapped.op(0), GiNaC::numeric(number.to_double()));
        return GiNaC::pow(mapped.op(0), number);
      }
    };



    /**
     * A formula as GiNaC is to read it: numbers are symbols, which are named
     * by their text. GiNaC computes with numbers at once and exactly, so
     * 9^9^9^9 would fill any machine.
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
        GiNaC::parser      parser(table, true);
        ExponentsAsNumbers with_exponents;
        return with_exponents(parser(text));
      }

    private:
      static bool
      is_letter(const char c)
      {
        return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
      }

      // add_name() and add_number() return the position behind what they read.
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
        const std::size_t end      = begin + (result.ptr - first);
        const std::string number   = formula.substr(begin, end - begin);
        const std::string name     = fmt::format("number_{}", table.size());
        const auto [place, is_new] = numbers.emplace(number, name);
        if (is_new)
          table[name] = GiNaC::symbol(number);
        text += place->second;
        return end;
      }

      const std::string                 &formula;
      GiNaC::symtab                      table;
      std::map<std::string, std::string> numbers;
      std::string                        text;
    };



    // Throws if GiNaC must not read @p formula, because its recursive functions
    // would need too much of the stack.
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
        return canonical_text(result);
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
