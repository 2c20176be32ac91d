// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

namespace corotet
{
  std::vector<std::pair<std::string, std::string>>
  named_values(const std::string &text, const std::string &entry)
  {
    std::vector<std::pair<std::string, std::string>> pairs;
    if (dealii::Utilities::trim(text).empty())
      return pairs;
    for (const std::string &item : split_outside_brackets(text, ','))
      {
        const std::size_t colon = item.find(':');
        if (colon == std::string::npos)
          throw InputError(entry,
                           fmt::format("found '{}'; allowed: 'boundary: "
                                       "value, boundary: value'",
                                       item));
        pairs.emplace_back(dealii::Utilities::trim(item.substr(0, colon)),
                           dealii::Utilities::trim(item.substr(colon + 1)));
      }
    return pairs;
  }
} // namespace corotet
