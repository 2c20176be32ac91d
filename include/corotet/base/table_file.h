// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_table_file_h
#define corotet_base_table_file_h

#include <string>
#include <vector>

namespace corotet
{
  /// The two columns of a table.
  struct TableRows
  {
    std::vector<double> arguments;
    std::vector<double> values;
  };

  /**
   * Reads a text file with two numbers in each line, separated by a comma, a
   * semicolon or blanks. Empty lines and what follows a # are skipped; the
   * first line may be a header, which has no number.
   *
   * Throws InputError that names file and line if there is anything else, if
   * arguments do not increase, or if there are fewer than two rows;
   * MachineError if the file, which exists, cannot be read.
   */
  TableRows
  read_table_file(const std::string &path);
} // namespace corotet

#endif
