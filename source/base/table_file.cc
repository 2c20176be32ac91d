// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/table_file.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

namespace corotet
{
  namespace
  {
    std::vector<std::string>
    fields(const std::string &line)
    {
      for (const char separator : {';', ','})
        if (line.find(separator) != std::string::npos)
          return split_outside_brackets(line, separator);
      std::string with_blanks = line;
      std::replace(with_blanks.begin(), with_blanks.end(), '\t', ' ');
      std::vector<std::string> words =
        dealii::Utilities::split_string_list(with_blanks, ' ');
      std::erase(words, "");
      return words;
    }

    double
    checked_number(const std::string &text, const std::string &place)
    {
      const std::optional<double> value = parse_number(text);
      if (!value)
        throw InputError("",
                         fmt::format("{}: a table consists of finite numbers, "
                                     "with a point for decimals: found '{}'",
                                     place,
                                     shortened(text)));
      return *value;
    }

    // Throws if a difference or slope of two rows is not finite; otherwise the
    // values between the rows are finite, too.
    void
    check_slope(const TableRows &rows, const std::string &place)
    {
      constexpr double  largest = 1e100;
      const std::size_t last    = rows.values.size() - 1;
      if (!(std::abs(rows.values[last]) <= largest) ||
          !(std::abs(rows.arguments[last]) <= largest))
        throw InputError("",
                         fmt::format("{}: the numbers of a table are between "
                                     "{} and {}: found {} and {}",
                                     place,
                                     -largest,
                                     largest,
                                     rows.arguments[last],
                                     rows.values[last]));
      if (last == 0)
        return;
      const double slope = (rows.values[last] - rows.values[last - 1]) /
                           (rows.arguments[last] - rows.arguments[last - 1]);
      if (!(std::abs(slope) <= largest))
        throw InputError("",
                         fmt::format("{}: the slope of a table is between {} "
                                     "and {}: found {}",
                                     place,
                                     -largest,
                                     largest,
                                     slope));
    }
  } // namespace

  TableRows
  read_table_file(const std::string &path)
  {
    std::ifstream file(path);
    if (!file)
      throw MachineError(path + ": cannot be read (permission?)");
    skip_byte_order_mark(file);

    TableRows    rows;
    bool         may_be_header = true;
    unsigned int line_number   = 0;
    for (std::string line; std::getline(file, line);)
      {
        ++line_number;
        line = dealii::Utilities::trim(line.substr(0, line.find('#')));
        if (line.empty())
          continue;

        const std::vector<std::string> texts = fields(line);
        const bool                     is_header =
          may_be_header &&
          std::none_of(texts.begin(), texts.end(), [](const std::string &text) {
            return parse_number(text).has_value();
          });
        may_be_header = false;
        if (is_header)
          continue;

        const std::string place = fmt::format("{}:{}", path, line_number);
        if (texts.size() != 2)
          throw InputError("",
                           fmt::format("{}: a row of a table has two numbers, "
                                       "separated by a comma, a semicolon or "
                                       "blanks: found {} columns, '{}'",
                                       place,
                                       texts.size(),
                                       shortened(line)));
        const double argument = checked_number(texts[0], place);
        if (!rows.arguments.empty() && argument <= rows.arguments.back())
          throw InputError("",
                           fmt::format("{}: the first column of a table must "
                                       "increase: found {} after {}",
                                       place,
                                       argument,
                                       rows.arguments.back()));
        rows.arguments.push_back(argument);
        rows.values.push_back(checked_number(texts[1], place));
        check_slope(rows, place);
      }
    check_read_to_end(file, path);
    if (rows.arguments.size() < 2)
      throw InputError("",
                       fmt::format("{}: a table has at least 2 rows: found {}",
                                   path,
                                   rows.arguments.size()));
    return rows;
  }
} // namespace corotet
