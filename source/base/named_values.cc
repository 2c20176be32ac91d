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
  std::vector<std::pair<std::string, std::string>>
  named_values(const std::string &text,
               const std::string &entry,
               const std::string &allowed)
  {
    std::vector<std::pair<std::string, std::string>> pairs;
    if (dealii::Utilities::trim(text).empty())
      return pairs;
    for (const std::string &item : split_outside_brackets(text, ','))
      {
        const std::size_t colon = item.find(':');
        if (colon == std::string::npos)
          throw InputError(
            entry, fmt::format("found '{}'; allowed: {}", item, allowed));
        pairs.emplace_back(dealii::Utilities::trim(item.substr(0, colon)),
                           dealii::Utilities::trim(item.substr(colon + 1)));
      }
    return pairs;
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
