// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/differentiation.h>
#include <corotet/base/exceptions.h>
#include <corotet/base/formula_functions.h>
#include <corotet/base/text.h>

#include <fmt/format.h>
#include <ginac/ginac.h>

#include <algorithm>
#include <sstream>

namespace corotet
{
  namespace
  {
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

    int
    depth_of_brackets(const std::string &formula)
    {
      int depth = 0, deepest = 0;
      for (const char c : formula)
        {
          depth += (c == '(') - (c == ')');
          deepest = std::max(deepest, depth);
        }
      return deepest;
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
    // Derivatives of what is longer or deeper fill the memory.
    constexpr std::size_t most   = 1000;
    constexpr int         levels = 20;
    if (formula.size() > most)
      refuse(fmt::format("it has more than {} characters", most));
    if (depth_of_brackets(formula) > levels)
      refuse(fmt::format("it has brackets more than {} deep", levels));
    try
      {
        const GiNaC::symtab table = symbols();
        GiNaC::parser       read(table, true);
        GiNaC::ex           result  = read(formula);
        const std::string   foreign = foreign_function(result);
        if (!foreign.empty())
          refuse("it has the function '" + foreign + "'");
        for (const std::string &variable : variables)
          result = result.diff(
            GiNaC::ex_to<GiNaC::symbol>(table.find(variable)->second));
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
