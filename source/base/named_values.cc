// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

namespace corotet
{
  namespace
  {
    // The first colon outside of quotes. An item may have several quoted names,
    // joined by &.
    std::size_t
    colon_behind_names(const std::string &item)
    {
      for (std::size_t i = 0; i < item.size(); ++i)
        if (item[i] == ':')
          return i;
        else if (const std::size_t end = end_of_quotes(item, i);
                 end != std::string::npos)
          i = end;
      return std::string::npos;
    }
  } // namespace

  std::size_t
  end_of_quotes(const std::string &text, const std::size_t i)
  {
    // Quotation marks inside of a name are part of it: 5" pipe.
    const bool is_begin =
      text[i] == '"' &&
      (i == 0 || std::string_view(" \t\n,;:&([").find(text[i - 1]) !=
                   std::string_view::npos);
    return is_begin ? text.find('"', i + 1) : std::string::npos;
  }

  std::string
  list_of_names(std::vector<std::string> names)
  {
    const auto are_pairs =
      [](const std::string &name, const char a, const char b) {
        return std::count(name.begin(), name.end(), a) ==
               std::count(name.begin(), name.end(), b);
      };
    for (std::string &name : names)
      if ((name.find_first_of(",:;&") != std::string::npos ||
           !are_pairs(name, '(', ')') || !are_pairs(name, '[', ']')) &&
          name.find('"') == std::string::npos)
        name = '"' + name + '"';
    return join(names);
  }

  std::string
  without_quotes(const std::string &name)
  {
    const bool has_quotes = name.size() > 2 && name.front() == '"' &&
                            name.find('"', 1) == name.size() - 1;
    return has_quotes ? name.substr(1, name.size() - 2) : name;
  }

  std::vector<std::pair<std::string, std::optional<std::string>>>
  names_and_values(const std::string &text)
  {
    using dealii::Utilities::trim;
    std::vector<std::pair<std::string, std::optional<std::string>>> items;
    if (trim(text).empty())
      return items;
    for (const std::string &item : split_outside_brackets(text, ','))
      {
        const std::size_t colon = colon_behind_names(item);
        items.emplace_back(trim(item.substr(0, colon)), std::nullopt);
        if (colon != std::string::npos)
          items.back().second = trim(item.substr(colon + 1));
      }
    return items;
  }

  std::vector<std::pair<std::string, std::string>>
  named_values(const std::string &text,
               const std::string &entry,
               const std::string &allowed)
  {
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const auto &[name, value] : names_and_values(text))
      {
        if (!value)
          throw InputError(
            entry,
            fmt::format("found '{}'; allowed: {}{}",
                        shortened(name),
                        allowed,
                        !pairs.empty() && allowed.starts_with("'boundary") &&
                            (name == "free" || parse_number(name)) ?
                          "; components of a value are "
                          "separated by ';'" :
                          ""));
        pairs.emplace_back(name, *value);
      }
    return pairs;
  }

  void
  check_column_name(const std::string &entry,
                    const std::string &name,
                    const std::string &what)
  {
    const auto allowed = [](const unsigned char c) {
      return std::isalnum(c) != 0 || c == '_';
    };
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) ||
        !std::all_of(name.begin(), name.end(), allowed))
      throw InputError(entry,
                       fmt::format("'{}' cannot be {}'s name; letters, "
                                   "digits and _ are allowed, no digit first",
                                   shortened(name),
                                   what));
  }

  void
  refuse_second_boundary(const std::string &entry, const std::string &name)
  {
    throw InputError(entry,
                     fmt::format("found boundary '{}' twice; allowed: each "
                                 "boundary once",
                                 name));
  }

  std::optional<dealii::Point<3>>
  point_of(const std::string &text)
  {
    std::istringstream stream(text);
    dealii::Point<3>   point;
    unsigned int       n = 0;
    for (std::string word; stream >> word; ++n)
      {
        if (n == 3)
          return {};
        const auto number = parse_number(word);
        if (!number)
          return {};
        point[n] = *number;
      }
    if (n != 3)
      return {};
    return point;
  }
} // namespace corotet
