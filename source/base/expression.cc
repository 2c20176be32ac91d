// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/expression.h>
#include <corotet/base/text.h>

#include <deal.II/base/numbers.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iostream>
#include <sstream>

namespace corotet
{
  namespace
  {
    const std::vector<std::string> variables = {"x", "y", "z", "t"};
    const std::vector<std::string> constants = {"pi", "_pi", "_e"};

    // Those of muParser and those that deal.II adds.
    const std::vector<std::string> functions = {
      "abs", "acos",  "acosh", "asin", "asinh",     "atan", "atan2", "atanh",
      "avg", "ceil",  "cos",   "cosh", "cot",       "csc",  "erf",   "erfc",
      "exp", "floor", "if",    "int",  "ln",        "log",  "log10", "log2",
      "max", "min",   "pow",   "rand", "rand_seed", "rint", "sec",   "sign",
      "sin", "sinh",  "sqrt",  "sum",  "tan",       "tanh"};

    bool
    contains(const std::vector<std::string> &list, const std::string &word)
    {
      return std::find(list.begin(), list.end(), word) != list.end();
    }

    // All names in a formula. Numbers are skipped as a whole: the e of 1e5 is
    // no name.
    std::vector<std::string>
    identifiers(const std::string &formula)
    {
      const auto is_letter = [](const char c) {
        return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
      };
      const auto is_digit = [](const char c) {
        return std::isdigit(static_cast<unsigned char>(c)) != 0;
      };

      std::vector<std::string> names;
      for (std::size_t i = 0; i < formula.size();)
        if (is_letter(formula[i]))
          {
            const std::size_t begin = i;
            while (i < formula.size() &&
                   (is_letter(formula[i]) || is_digit(formula[i])))
              ++i;
            names.push_back(formula.substr(begin, i - begin));
          }
        else if (is_digit(formula[i]) || formula[i] == '.')
          {
            char *end = nullptr;
            std::strtod(formula.c_str() + i, &end);
            i = std::max<std::size_t>(i + 1, end - formula.c_str());
          }
        else
          ++i;
      return names;
    }

    // Things that muParser would accept or report in a way that helps nobody:
    // the reason, or an empty string.
    std::string
    reason_to_refuse(const std::string &formula)
    {
      if (formula.empty())
        return "it is empty; a formula is needed, for example 0";
      if (split_outside_brackets(formula, ',').size() > 1)
        return "it has a comma outside of parentheses; components are "
               "separated by semicolons";
      for (std::size_t i = 0; i < formula.size(); ++i)
        if (formula[i] == '=')
          {
            if (i + 1 < formula.size() && formula[i + 1] == '=')
              ++i;
            else if (i == 0 || std::string("<>!").find(formula[i - 1]) ==
                                 std::string::npos)
              return "it assigns by =; comparisons are ==, !=, <, <=, > and >=";
          }
      for (const std::string &name : identifiers(formula))
        if (!contains(variables, name) && !contains(constants, name) &&
            !contains(functions, name))
          {
            const std::string suggestion = nearest(name, functions);
            return fmt::format("it has the unknown name \"{}\"{}; known are x, "
                               "y, z, t, pi and muParser's functions",
                               name,
                               suggestion.empty() ?
                                 "" :
                                 " (did you mean \"" + suggestion + "\"?)");
          }
      return "";
    }

    // deal.II prints what muParser says on the error stream before it throws;
    // here that stream is caught.
    class CaughtErrorStream
    {
    public:
      CaughtErrorStream()
        : original(std::cerr.rdbuf(buffer.rdbuf()))
      {}

      ~CaughtErrorStream()
      {
        std::cerr.rdbuf(original);
      }

      CaughtErrorStream(const CaughtErrorStream &) = delete;
      CaughtErrorStream &
      operator=(const CaughtErrorStream &) = delete;

      // The text of "Message:  <text>", without a full stop.
      std::string
      message() const
      {
        const std::string text  = buffer.str();
        const std::size_t begin = text.find('<');
        const std::size_t end   = text.find(">\n", begin);
        if (begin == std::string::npos || end == std::string::npos)
          return "it cannot be parsed";
        std::string message = text.substr(begin + 1, end - begin - 1);
        while (!message.empty() && message.back() == '.')
          message.pop_back();
        return message;
      }

    private:
      std::ostringstream buffer;
      std::streambuf    *original;
    };
  } // namespace

  Expression::Expression(const std::string &text,
                         const unsigned int n_components,
                         const std::string &entry)
    : function(std::make_shared<dealii::FunctionParser<3>>(n_components))
  {
    const std::vector<std::string> components =
      split_outside_brackets(text, ';');
    if (components.size() != n_components)
      throw InputError(
        entry,
        fmt::format("the expression \"{}\" has {} component{}; {} needed, "
                    "separated by semicolons",
                    text,
                    components.size(),
                    components.size() == 1 ? "" : "s",
                    n_components == 1 ? "1 is" :
                                        fmt::format("{} are", n_components)));

    for (const std::string &component : components)
      {
        const std::string reason = reason_to_refuse(component);
        if (!reason.empty())
          throw InputError(entry,
                           fmt::format("the expression \"{}\" is no formula: "
                                       "{}",
                                       component,
                                       reason));
        for (const std::string &name : identifiers(component))
          {
            const bool random = name == "rand" || name == "rand_seed";
            time_dependent |= name == "t" || random;
            space_dependent |=
              name == "x" || name == "y" || name == "z" || random;
          }
      }

    compile(components, entry);

    zero = !space_dependent && !time_dependent;
    for (unsigned int c = 0; zero && c < n_components; ++c)
      zero = value(dealii::Point<3>(), 0, c) == 0;
  }

  void
  Expression::compile(const std::vector<std::string> &components,
                      const std::string              &entry)
  {
    // One by one, to know which one is wrong. muParser finds most mistakes only
    // when it evaluates for the first time.
    for (const std::string &component : components)
      {
        const CaughtErrorStream caught;
        try
          {
            dealii::FunctionParser<3> trial(1);
            trial.initialize("x,y,z,t",
                             component,
                             {{"pi", dealii::numbers::PI}},
                             true);
            trial.value(dealii::Point<3>(0.25, 0.5, 0.75));
          }
        catch (const dealii::ExceptionBase &)
          {
            throw InputError(entry,
                             fmt::format("the expression \"{}\" is no formula: "
                                         "{}",
                                         component,
                                         caught.message()));
          }
      }
    function->initialize("x,y,z,t",
                         components,
                         {{"pi", dealii::numbers::PI}},
                         true);
  }

  double
  Expression::value(const dealii::Point<3> &p,
                    const double            t,
                    const unsigned int      component) const
  {
    AssertIndexRange(component, n_components());
    function->set_time(t);
    return function->value(p, component);
  }

  dealii::Tensor<1, 3>
  Expression::vector_value(const dealii::Point<3> &p, const double t) const
  {
    AssertDimension(n_components(), 3);
    function->set_time(t);
    dealii::Tensor<1, 3> result;
    for (unsigned int c = 0; c < 3; ++c)
      result[c] = function->value(p, c);
    return result;
  }
} // namespace corotet
