// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/table_function.h>
#include <corotet/output/checkpoint_checksum.h>
#include <corotet/output/table_checksums.h>

#include <cstring>

namespace corotet
{
  namespace
  {
    // The checksum of the first rows.
    std::string
    checksum_of_rows(const TableFunction &table, const std::size_t n)
    {
      std::string bytes;
      for (const std::vector<double> *column :
           {&table.rows(), &table.row_values()})
        for (std::size_t i = 0; i < n; ++i)
          {
            char word[sizeof(double)];
            std::memcpy(word, &(*column)[i], sizeof(double));
            bytes.append(word, sizeof(double));
          }
      return checkpoint_checksum::of_text(bytes);
    }
  } // namespace

  nlohmann::ordered_json
  table_checksums(const TableFunctions &tables)
  {
    auto result = nlohmann::ordered_json::object();
    for (const auto &[name, table] : tables)
      {
        const std::size_t n = table->rows().size();
        result[name]        = {{"rows", n},
                               {"is_cubic", table->is_cubic()},
                               {"checksum", checksum_of_rows(*table, n)}};
      }
    return result;
  }

  std::vector<std::string>
  changed_tables(const nlohmann::ordered_json &before,
                 const TableFunctions         &tables)
  {
    std::vector<std::string> result;
    for (const auto &[name, table] : tables)
      if (before.contains(name))
        {
          const std::size_t n = before.at(name).at("rows").get<std::size_t>();
          if (n > table->rows().size() ||
              // Checkpoints of older versions do not contain it.
              before.at(name).value("is_cubic", table->is_cubic()) !=
                table->is_cubic() ||
              before.at(name).at("checksum").get<std::string>() !=
                checksum_of_rows(*table, n))
            result.push_back(name);
        }
    return result;
  }
} // namespace corotet
