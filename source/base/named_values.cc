// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

namespace corotet
{
  std::vector<std::pair<std::string, std::optional<std::string>>>
  names_and_values(const std::string &text)
  {
    using dealii::Utilities::trim;
    std::vector<std::pair<std::string, std::optional<std::string>>> items;
    if (trim(text).empty())
      return items;
    for (const std::string &item : split_outside_brackets(text, ','))
      {
        const std::size_t colon = item.find(':');
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
          throw InputError(entry,
                           fmt::format("found '{}'; allowed: {}",
                                       shortened(name),
                                       allowed));
        pairs.emplace_back(name, *value);
      }
    return pairs;
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
        const char *end          = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data(), end, point[n]);
        if (error != std::errc() || stop != end || !std::isfinite(point[n]))
          return {};
      }
    if (n != 3)
      return {};
    return point;
  }
} // namespace corotet
