// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/expression.h>
#include <corotet/base/formula_functions.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>
#include <corotet/studies/check.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace corotet
{
  namespace
  {
    const std::string              entry = "Verification/Checks";
    const std::vector<std::string> statistics =
      {"first", "last", "min", "max", "mean", "range"};
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

    // The first word of a text, and what follows it.
    std::pair<std::string, std::string>
    first_word(const std::string &text)
    {
      const std::size_t end = text.find_first_of(" \t");
      if (end == std::string::npos)
        return {text, ""};
      return {text.substr(0, end), dealii::Utilities::trim(text.substr(end))};
    }

    // The position of the last =, < or > that is not a part of ==, <=, >= or
    // !=.
    std::size_t
    last_relation(const std::string &text)
    {
      for (std::size_t i = text.size(); i-- > 0;)
        {
          const bool is_part =
            (i + 1 < text.size() && text[i + 1] == '=') ||
            (i > 0 && text[i] == '=' &&
             std::string("=<>!").find(text[i - 1]) != std::string::npos);
          if (std::string("=<>").find(text[i]) != std::string::npos && !is_part)
            return i;
        }
      return std::string::npos;
    }

    // The value of a formula without variables.
    double
    constant(const std::string &text)
    {
      const Expression expression(text, 1, entry);
      if (expression.depends_on_space() || expression.depends_on_time())
        throw InputError(entry,
                         fmt::format("'{}' is not constant; allowed: numbers, "
                                     "pi and functions of them",
                                     shortened(text)));
      return expression.value({}, 0);
    }

    // The parts of a line between commas outside of quotation marks.
    std::vector<std::string>
    words_between_commas(const std::string &line)
    {
      std::vector<std::string> words(1);
      bool                     quoted = false;
      for (const char c : line)
        if (c == ',' && !quoted)
          words.emplace_back();
        else
          {
            quoted = quoted != (c == '"');
            words.back() += c;
          }
      return words;
    }

    std::vector<double>
    numbers_between_commas(const std::string &line)
    {
      std::vector<double> numbers;
      for (const std::string &word : words_between_commas(line))
        {
          if (word.starts_with('"'))
            {
              numbers.push_back(not_a_number);
              continue;
            }
          char *end = nullptr;
          numbers.push_back(std::strtod(word.c_str(), &end));
          if (end == word.c_str() || *end != '\0')
            throw MachineError("'" + word + "' is not a number");
        }
      return numbers;
    }
  } // namespace

  ResultTable
  read_result_table(const std::string &path)
  {
    ResultTable   table;
    std::ifstream file(path);
    std::string   line;
    if (!std::getline(file, line))
      throw MachineError(path + ": the table cannot be read");
    table.columns = words_between_commas(line);
    while (std::getline(file, line))
      {
        table.rows.push_back(numbers_between_commas(line));
        if (table.rows.back().size() != table.columns.size())
          throw MachineError(path + ": the table has an incomplete row");
      }
    check_read_to_end(file, path);
    return table;
  }

  // A formula in the columns of a table.
  class Check::RowFormula
  {
  public:
    RowFormula(const std::string &text, const std::vector<std::string> &columns)
      : values(columns.size())
    {
      try
        {
          define_functions(parser);
          parser.SetExpr(with_blanks_as_wanted(text));
          for (const auto &[name, place] : parser.GetUsedVar())
            if (std::find(columns.begin(), columns.end(), name) ==
                columns.end())
              refuse_name(name, columns);
          for (unsigned int c = 0; c < columns.size(); ++c)
            parser.DefineVar(columns[c], &values[c]);
          parser.Eval();
        }
      catch (const mu::Parser::exception_type &error)
        {
          throw InputError(entry,
                           fmt::format("'{}' is no formula: {}",
                                       shortened(text),
                                       shortened(error.GetMsg(), 200)));
        }
    }

    RowFormula(const RowFormula &) = delete;
    RowFormula &
    operator=(const RowFormula &) = delete;
    ~RowFormula()                 = default;

    double
    value(const std::vector<double> &row)
    {
      if (row.size() != values.size())
        throw std::logic_error(
          fmt::format("a check of a table with {} columns got one with {}",
                      values.size(),
                      row.size()));
      std::copy(row.begin(), row.end(), values.begin());
      return parser.Eval();
    }

  private:
    [[noreturn]] static void
    refuse_name(const std::string              &name,
                const std::vector<std::string> &columns)
    {
      const std::string suggestion = nearest(name, columns);
      throw InputError(entry,
                       fmt::format("the results have no column \"{}\"; {}",
                                   shortened(name),
                                   suggestion.empty() ?
                                     "they have " + join(columns) :
                                     "did you mean \"" + suggestion + "\"?"));
    }

    mu::Parser parser;
    // The variables that the parser reads.
    std::vector<double> values;
  };

  Check::~Check()                 = default;
  Check::Check(Check &&) noexcept = default;

  Check::Check(const std::string &text, const std::vector<std::string> &columns)
  {
    const std::size_t colon    = text.find(':');
    const std::size_t relation = last_relation(text);
    if (colon == std::string::npos || relation == std::string::npos ||
        relation < colon)
      throw InputError(entry,
                       fmt::format("found '{}'; allowed: 'NAME: STATISTIC "
                                   "FORMULA where CONDITION = REFERENCE +- "
                                   "TOLERANCE', or < or > REFERENCE",
                                   shortened(text)));
    label = dealii::Utilities::trim(text.substr(0, colon));
    // The name has to fit into a cell of a table in a .csv file.
    if (label.empty() || label.find_first_of(",\"|") != std::string::npos)
      throw InputError(entry,
                       fmt::format("'{}' cannot be a check's name; allowed: "
                                   "text without commas, quotes and bars",
                                   shortened(label)));
    parse_quantity(dealii::Utilities::trim(
                     text.substr(colon + 1, relation - colon - 1)),
                   columns);
    this->relation = text[relation];
    parse_expectation(dealii::Utilities::trim(text.substr(relation + 1)));
  }

  void
  Check::parse_quantity(const std::string              &quantity,
                        const std::vector<std::string> &columns)
  {
    const auto [word, rest] = first_word(quantity);
    if (std::find(statistics.begin(), statistics.end(), word) ==
        statistics.end())
      throw InputError(entry,
                       fmt::format("found '{}' as the statistic of check "
                                   "'{}'; allowed: {}",
                                   shortened(word),
                                   shortened(label),
                                   join(statistics)));
    statistic               = word;
    const std::string where = " where ";
    const std::size_t place = rest.find(where);
    const std::string what  = rest.substr(0, place);
    formula                 = std::make_unique<RowFormula>(what, columns);
    if (place != std::string::npos)
      condition =
        std::make_unique<RowFormula>(rest.substr(place + where.size()),
                                     columns);
  }

  void
  Check::parse_expectation(const std::string &expectation)
  {
    const std::size_t sign = expectation.rfind("+-");
    reference = constant(dealii::Utilities::trim(expectation.substr(0, sign)));
    if ((relation == '=') != (sign != std::string::npos))
      throw InputError(entry,
                       fmt::format("found '{} {}' in check '{}'; allowed: '= "
                                   "REFERENCE +- TOLERANCE', or a bound "
                                   "without tolerance",
                                   relation,
                                   shortened(expectation),
                                   shortened(label)));
    if (relation != '=')
      return;
    tolerance_text   = dealii::Utilities::trim(expectation.substr(sign + 2));
    relative         = tolerance_text.ends_with('%');
    std::string text = tolerance_text;
    if (relative)
      text.pop_back();
    tolerance = constant(dealii::Utilities::trim(text));
    if (!(tolerance > 0) || (relative && reference == 0))
      throw InputError(entry,
                       fmt::format("found the tolerance '{}' for {} in check "
                                   "'{}'; allowed: a positive one, in % of "
                                   "what is not zero",
                                   shortened(tolerance_text),
                                   reference,
                                   shortened(label)));
  }

  double
  Check::statistic_of(const std::vector<double> &values) const
  {
    const auto is_nan = [](const double value) { return std::isnan(value); };
    if (values.empty())
      return not_a_number;
    if (statistic == "first")
      return values.front();
    if (statistic == "last")
      return values.back();
    if (std::any_of(values.begin(), values.end(), is_nan))
      return not_a_number;
    if (statistic == "mean")
      return std::accumulate(values.begin(), values.end(), 0.) / values.size();
    const auto [min, max] = std::minmax_element(values.begin(), values.end());
    if (statistic == "min")
      return *min;
    return statistic == "max" ? *max : *max - *min;
  }

  CheckResult
  Check::evaluate(const ResultTable &table) const
  {
    std::vector<double> values;
    for (const std::vector<double> &row : table.rows)
      if (!condition || condition->value(row) != 0)
        values.push_back(formula->value(row));
    CheckResult result{label, statistic_of(values), reference, 0, "", relative};
    result.error = result.computed - reference;
    if (relative)
      result.error *= 100 / std::abs(reference);
    // Comparisons with a value that is not a number are false.
    result.tolerance = tolerance_text;
    result.passed    = std::abs(result.error) <= tolerance;
    if (relation == '<')
      {
        result.tolerance = "below";
        result.passed    = result.computed < reference;
      }
    else if (relation == '>')
      {
        result.tolerance = "above";
        result.passed    = result.computed > reference;
      }
    return result;
  }
} // namespace corotet
