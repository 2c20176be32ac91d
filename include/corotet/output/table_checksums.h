// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_table_checksums_h
#define corotet_output_table_checksums_h

#include <corotet/base/table_functions.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace corotet
{
  /// The data to recognize changed tables: for each name, the number of rows
  /// and their checksum.
  nlohmann::ordered_json
  table_checksums(const TableFunctions &tables);

  /// The names of those @p tables whose rows have changed since
  /// table_checksums() was @p before; rows may have been added at the end.
  /// Throws nlohmann::json::exception if @p before has another form.
  std::vector<std::string>
  changed_tables(const nlohmann::ordered_json &before,
                 const TableFunctions         &tables);
} // namespace corotet

#endif
