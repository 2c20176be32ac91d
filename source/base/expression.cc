// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/expression.h>
#include <corotet/base/formula_functions.h>
#include <corotet/base/jet_formula.h>
#include <corotet/base/not_finite.h>
#include <corotet/base/text.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

namespace corotet
{
  namespace
  {
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

    // The message about a name that @p parser does not know.
    std::string
    unknown_name(const std::string    &name,
                 const mu::Parser     &parser,
                 const TableFunctions &tables)
    {
      std::vector<std::string> functions;
      for (const auto &[function, callback] : parser.GetFunDef())
        functions.push_back(function);
      const std::string        suggestion = nearest(name, functions);
      std::vector<std::string> known      = formula_variables;
      known.emplace_back("pi");
      known.insert(known.end(),
                   functions_of_time.begin(),
                   functions_of_time.end());
      for (const auto &[table, function] : tables)
        known.push_back(table);
      return fmt::format("it has the unknown name \"{}\"{}; known are {} and "
                         "muParser's functions",
                         shortened(name),
                         suggestion.empty() ?
                           "" :
                           " (did you mean \"" + suggestion + "\"?)",
                         join(known));
    }

    // The reason to refuse a formula that muParser would accept, or whose error
    // it would report without any help; otherwise an empty string.
    std::string
    reason_to_refuse(const std::string    &formula,
                     const mu::Parser     &parser,
                     const TableFunctions &tables)
    {
      if (formula.empty())
        return "it is empty; a formula is needed, for example 0";
      if (const int depth = depth_of_parentheses(formula);
          depth > max_parentheses)
        return fmt::format("found parentheses {} deep in each other; allowed "
                           "are {}",
                           depth,
                           max_parentheses);
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
      const std::vector<std::string> names = identifiers(formula);
      for (const std::string &name : names)
        if (std::find(random_functions.begin(), random_functions.end(), name) !=
            random_functions.end())
          return fmt::format(
            "it has the function \"{}\", whose values would "
            "depend on how often and on which rank they are "
            "asked for; allowed is what depends on x, y, z and "
            "t alone, such as a table of random numbers, or "
            "acos(cos(1e4*sin(13*x + 78*y + 38*z)))/pi",
            name);
      for (const std::string &name : names)
        if (!parser.GetVar().contains(name) &&
            !parser.GetConst().contains(name) &&
            !parser.GetFunDef().contains(name))
          return unknown_name(name, parser, tables);
      return "";
    }

    double
    table_value(void *const table, const double argument)
    {
      return static_cast<const TableFunction *>(table)->value(argument);
    }
  } // namespace

  namespace
  {
    // The first value that was not finite, of any expression on this rank.
    std::optional<NotFinite> first_not_finite;
  } // namespace

  std::optional<NotFinite>
  take_not_finite(const MPI_Comm comm)
  {
    using namespace dealii::Utilities::MPI;
    const std::optional<NotFinite> own   = std::exchange(first_not_finite, {});
    const unsigned int             none  = n_mpi_processes(comm);
    const unsigned int             rank  = this_mpi_process(comm);
    const unsigned int             first = min(own ? rank : none, comm);
    if (first == none)
      return {};
    const auto texts =
      broadcast(comm,
                own ? std::make_pair(own->entry, own->message) :
                      std::pair<std::string, std::string>(),
                first);
    return NotFinite{texts.first, texts.second};
  }

  // The compiled components and the variables that they read.
  struct Expression::Formulas
  {
    Formulas(const unsigned int    n_components,
             const std::string    &entry,
             const TableFunctions &tables)
      : parsers(n_components)
      , entry(entry)
      , tables(tables)
    {
      for (mu::Parser &parser : parsers)
        {
          for (unsigned int i = 0; i < variables.size(); ++i)
            parser.DefineVar(formula_variables[i], &variables[i]);
          define_functions(parser);
          // muParser knows data of functions as void * only.
          for (const auto &[name, table] : tables)
            parser.DefineFunUserData(name,
                                     table_value,
                                     const_cast<TableFunction *>(table.get()));
        }
    }

    Formulas(const Formulas &) = delete;
    Formulas &
    operator=(const Formulas &) = delete;
    ~Formulas()                 = default;

    // Compiles a component. Throws InputError.
    void
    compile(const unsigned int component, const std::string &formula)
    {
      std::string reason =
        reason_to_refuse(formula, parsers[component], tables);
      if (reason.empty())
        try
          {
            parsers[component].SetExpr(with_blanks_as_wanted(formula));
            // muParser finds most mistakes only when it evaluates for the first
            // time.
            variables = {{0.25, 0.5, 0.75, 0}};
            parsers[component].Eval();
            return;
          }
        catch (const mu::Parser::exception_type &error)
          {
            reason = error.GetMsg();
            while (!reason.empty() && reason.back() == '.')
              reason.pop_back();
          }
      throw InputError(entry,
                       fmt::format("the expression \"{}\" is no formula: {}",
                                   shortened(formula),
                                   shortened(reason, 500)));
    }

    // The component with its derivatives in time, compiled when it is first
    // needed, as few formulas need it.
    const JetFormula &
    jets(const unsigned int component)
    {
      jet_formulas.resize(parsers.size());
      std::optional<JetFormula> &formula = jet_formulas[component];
      if (!formula)
        formula.emplace(parsers[component].GetExpr(), tables);
      return *formula;
    }

    double
    value(const dealii::Point<3> &p,
          const double            t,
          const unsigned int      component)
    {
      AssertIndexRange(component, parsers.size());
      variables = {{p[0], p[1], p[2], t}};
      return parsers[component].Eval();
    }

    std::vector<mu::Parser> parsers;
    // The path of the parameter that has these formulas.
    const std::string entry;

  private:
    // The parsers hold pointers to these members.
    std::array<double, 4>                  variables = {};
    const TableFunctions                   tables;
    std::vector<std::optional<JetFormula>> jet_formulas;
  };

  Expression::Expression(const std::string    &text,
                         const unsigned int    n_components,
                         const std::string    &entry,
                         const TableFunctions &tables)
    : formulas(std::make_shared<Formulas>(n_components, entry, tables))
  {
    const std::vector<std::string> components =
      split_outside_brackets(text, ';');
    if (components.size() != n_components)
      throw InputError(
        entry,
        fmt::format("the expression \"{}\" has {} component{}; {} needed, "
                    "separated by semicolons",
                    shortened(text),
                    components.size(),
                    components.size() == 1 ? "" : "s",
                    n_components == 1 ? "1 is" :
                                        fmt::format("{} are", n_components)));

    for (unsigned int c = 0; c < n_components; ++c)
      {
        formulas->compile(c, components[c]);
        for (const std::string &name : identifiers(components[c]))
          {
            time_dependent |= name == "t";
            space_dependent |= name == "x" || name == "y" || name == "z";
          }
      }

    zero = !space_dependent && !time_dependent;
    for (unsigned int c = 0; zero && c < n_components; ++c)
      zero = formulas->value(dealii::Point<3>(), 0, c) == 0;
  }

  unsigned int
  Expression::n_components() const
  {
    return formulas->parsers.size();
  }

  double
  Expression::value(const dealii::Point<3> &p,
                    const double            t,
                    const unsigned int      component) const
  {
    const double result = formulas->value(p, t, component);
    if (!std::isfinite(result) && !first_not_finite)
      {
        const char *found = result > 0 ? "infinity" : "minus infinity";
        if (std::isnan(result))
          found = "not a number";
        first_not_finite = {
          formulas->entry,
          fmt::format(
            "the expression \"{}\" is not finite: found {} at ({:.6g}, "
            "{:.6g}, {:.6g}) at t = {:g}; allowed are finite values",
            shortened(
              dealii::Utilities::trim(formulas->parsers[component].GetExpr())),
            found,
            p[0],
            p[1],
            p[2],
            t)};
      }
    return result;
  }

  std::array<double, 2>
  Expression::time_derivatives(const dealii::Point<3> &p,
                               const double            t,
                               const double            width,
                               const unsigned int      component) const
  {
    AssertIndexRange(component, n_components());
    if (!time_dependent)
      return {};
    const Jet jet = formulas->jets(component).value({{p[0], p[1], p[2], t}});
    std::array<double, 2> result{{jet.first, jet.second}};
    // If the formula has something without a rule of differentiation, its value
    // is not a number, but the derivatives are those of a constant.
    if (std::isnan(jet.value))
      result.fill(jet.value);
    // Differences forwards, and where the formula is not finite there,
    // backwards.
    for (const double h : {width, -width})
      {
        if (std::isfinite(result[0]) && std::isfinite(result[1]))
          break;
        std::array<double, 4> u;
        for (unsigned int i = 0; i < 4; ++i)
          u[i] = formulas->value(p, t + i * h, component);
        result = {{(-11 * u[0] + 18 * u[1] - 9 * u[2] + 2 * u[3]) / (6 * h),
                   (2 * u[0] - 5 * u[1] + 4 * u[2] - u[3]) / (h * h)}};
      }
    return result;
  }

  dealii::Tensor<1, 3>
  Expression::vector_value(const dealii::Point<3> &p, const double t) const
  {
    AssertDimension(n_components(), 3);
    dealii::Tensor<1, 3> result;
    for (unsigned int c = 0; c < 3; ++c)
      result[c] = value(p, t, c);
    return result;
  }

  bool
  is_zero_expression(const std::string &text, const unsigned int n_components)
  {
    try
      {
        return Expression(text, n_components, "").is_zero();
      }
    catch (const InputError &)
      {
        return false;
      }
  }
} // namespace corotet
