// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_csv_h
#define corotet_output_csv_h

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace corotet
{
  /**
   * The names of a row, or its values, as a line of a .csv file. Numbers have
   * enough digits to read the same double back; a value that is not a number is
   * written as nan.
   */
  std::string
  csv_line(const nlohmann::ordered_json &row, const bool names);

  /**
   * The names of a row, in their order.
   */
  std::vector<std::string>
  column_names(const nlohmann::ordered_json &row);
} // namespace corotet

#endif
