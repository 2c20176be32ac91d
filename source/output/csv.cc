// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/output/csv.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace corotet
{
  std::string
  csv_line(const nlohmann::ordered_json &row, const bool names)
  {
    std::string line;
    for (const auto &[name, value] : row.items())
      {
        line += line.empty() ? "" : ",";
        if (names)
          line += name;
        else if (value.is_number_float())
          line += fmt::format("{}", value.get<double>());
        else
          line += value.dump();
      }
    return line + "\n";
  }

  std::vector<std::string>
  column_names(const nlohmann::ordered_json &row)
  {
    std::vector<std::string> names;
    for (const auto &[name, value] : row.items())
      names.push_back(name);
    return names;
  }
} // namespace corotet
