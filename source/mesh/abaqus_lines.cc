// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "abaqus_lines.h"

#include <corotet/base/text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace corotet::abaqus
{
  void
  Place::refuse(const std::string &message) const
  {
    throw InputError("", fmt::format("{}:{}: {}", path, line, message));
  }



  std::string
  Keyword::value(const std::string &parameter) const
  {
    const auto found = parameters.find(parameter);
    return found == parameters.end() ? "" : found->second;
  }



  std::string
  Keyword::needed(const std::string &parameter) const
  {
    const std::string result = value(parameter);
    if (result.empty())
      place.refuse(fmt::format("*{} has no name: found no value of {}; needed "
                               "is '{}=...'",
                               name,
                               parameter,
                               parameter));
    return result;
  }



  std::string
  trimmed(const std::string_view text, const std::string_view blanks)
  {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos)
      return "";
    return std::string(
      text.substr(begin, text.find_last_not_of(blanks) - begin + 1));
  }



  std::vector<std::string>
  fields(const std::string &line)
  {
    std::vector<std::string> result;
    for (std::size_t begin = 0; begin <= line.size();)
      {
        // A quotation mark without a second one is an ordinary character.
        std::size_t end = begin;
        while (end < line.size() && line[end] != ',')
          {
            const std::size_t quote =
              line[end] == '"' ? line.find('"', end + 1) : std::string::npos;
            end = (quote == std::string::npos ? end : quote) + 1;
          }
        result.push_back(
          trimmed(std::string_view(line).substr(begin, end - begin)));
        begin = end + 1;
      }
    if (result.back().empty())
      result.pop_back();
    return result;
  }



  Keyword
  parse_keyword(const std::string &line, const Place &place)
  {
    Keyword                        keyword{place, "", {}};
    const std::vector<std::string> parts = fields(line.substr(1));
    for (std::size_t i = 0; i < parts.size(); ++i)
      {
        if (i == 0)
          {
            // Several blanks count as one, and none is needed after the
            // asterisk: "* NODE" and "*END  PART" are accepted.
            bool blank = false;
            for (const char c : upper_case(parts[0]))
              {
                const bool space =
                  std::isspace(static_cast<unsigned char>(c)) != 0;
                if (!space && blank && !keyword.name.empty())
                  keyword.name += ' ';
                if (!space)
                  keyword.name += c;
                blank = space;
              }
            continue;
          }
        const std::size_t equals = parts[i].find('=');
        const std::string name =
          upper_case(trimmed(std::string_view(parts[i]).substr(
            0, std::min(equals, parts[i].size()))));
        keyword.parameters[name] = equals == std::string::npos ?
                                     "" :
                                     trimmed(parts[i].substr(equals + 1));
      }
    if (keyword.name.empty())
      place.refuse("found an asterisk without a keyword");
    return keyword;
  }



  std::optional<std::int64_t>
  whole_number(const std::string &text)
  {
    std::int64_t result = 0;
    const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), result);
    if (text.empty() || error != std::errc() ||
        end != text.data() + text.size())
      return {};
    return result;
  }



  std::int64_t
  tag(const std::string &text, const Place &place)
  {
    const auto result = whole_number(text);
    if (!result || *result < 1)
      place.refuse(fmt::format("found '{}'; allowed is a positive whole number",
                               shortened(text)));
    return *result;
  }



  double
  number(const std::string &text, const Place &place)
  {
    const auto result = parse_number(text);
    if (!result)
      place.refuse(
        fmt::format("found '{}'; allowed is a finite number", shortened(text)));
    return *result;
  }
} // namespace corotet::abaqus
